#pragma once
// Handles the program as a process: signals and limits of the system at the start, output and errors at the end.

namespace sunfleck {

// Call at the very start. Turns a pipe whose reader has gone and a file size limit into errors of the calls concerned, instead
// of the end of the program, and keeps files from being opened in place of a closed standard stream.
void prepare_process();

// Keeps all freed memory for later use, for commands in which the same large arrays come back again and again for minutes:
// otherwise it goes back to the system within ten seconds. Does nothing without jemalloc (programs/allocator.cpp).
void keep_freed_memory();

// Returns to the system at once what has been freed, before something else needs as much. Does nothing without jemalloc.
void return_freed_memory();

// Call at the very end. Flushes standard output; if that fails the run failed, unless the reader merely stopped reading.
// Returns the exit status.
[[nodiscard]] int finish_output(int status);

// Call from a catch block. Reports the current exception in one line, unless rank 0 of an MPI job reports it. Returns the exit
// status.
[[nodiscard]] int report_exception();

}  // namespace sunfleck
