#pragma once
// Large arrays in huge pages. A replicate allocates hundreds of megabytes and frees them again; fetching them in pages of 4 KiB took a
// fifth of the processor time of a day in blocks of 28 steps.

namespace sunfleck {

// Has no effect of its own: a program that calls it links the operators new and delete of large_arrays.cpp, which ask the system for
// huge pages (transparent huge pages, madvise) behind arrays of 4 MiB and more.
void use_huge_pages();

}  // namespace sunfleck
