#pragma once
// Handles Ctrl-C, SIGTERM, the closing of the terminal, and what batch systems send before a time limit (SIGUSR1, SIGXCPU). Signals
// that are already ignored (nohup) stay ignored.

namespace sunfleck {

inline constexpr int exit_interrupted = 130;  // the exit status of an interrupted run

// Makes signals end the program at once, with one line and the exit status of an interrupted run. For use while nothing has
// been written yet.
void exit_on_interrupts();

// Makes signals end the work cleanly from now on; a second signal of the same kind ends the program at once.
void watch_for_interrupts();
[[nodiscard]] bool interrupted();

}  // namespace sunfleck
