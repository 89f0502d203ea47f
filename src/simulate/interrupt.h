#pragma once
// Ctrl-C, SIGTERM and a terminal that is closed. What is ignored from outside (nohup) stays ignored.

namespace sunfleck {

// While nothing is written yet: they end the program at once, with one line and the exit status of an interrupted run.
void exit_on_interrupts();

// From now on they end the work cleanly; a second signal of the same kind ends the program at once.
void watch_for_interrupts();
[[nodiscard]] bool interrupted();

}  // namespace sunfleck
