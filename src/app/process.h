#pragma once
// The program as a process: what the system may do to it, and its last words.

namespace sunfleck {

// At the very start. A pipe whose reader has gone and a limit of file sizes become errors of the calls that meet them, not
// the end of the program; no file is opened in the place of a standard stream that was closed.
// Memory that is freed goes back to the system.
void prepare_process();

// At the very end: what was printed has to arrive, or the run failed. A reader that wanted no more is no failure.
[[nodiscard]] int finish_output(int status);

// From a catch block: says in one line what is being thrown, unless rank 0 of an MPI job will say it. Returns the exit status.
[[nodiscard]] int report_exception();

}  // namespace sunfleck
