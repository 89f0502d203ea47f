#pragma once
// Handles the program as a process: signals and limits of the system at the start, output and errors at the end.

namespace sunfleck {

struct TracerDevice;

// Call at the very start. Turns a pipe whose reader has gone and a file size limit into errors of the calls concerned, instead
// of the end of the program; keeps files from being opened in place of a closed standard stream; makes freed memory return to
// the system.
void prepare_process();

// Keeps freed memory for later use, up to a quarter of a gigabyte, where the same large arrays come back again and again.
void keep_freed_memory();
// Does the same with arrays of up to 32 MiB if the device is a GPU, which would wait for their pages.
void keep_freed_memory_for(const TracerDevice& device);

// Call at the very end. Flushes standard output; if that fails the run failed, unless the reader merely stopped reading.
// Returns the exit status.
[[nodiscard]] int finish_output(int status);

// Call from a catch block. Reports the current exception in one line, unless rank 0 of an MPI job reports it. Returns the exit
// status.
[[nodiscard]] int report_exception();

}  // namespace sunfleck
