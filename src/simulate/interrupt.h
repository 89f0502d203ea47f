#pragma once
// Handles Ctrl-C, SIGTERM and the closing of the terminal. Signals that are already ignored (nohup) stay ignored.

namespace sunfleck {

// Use while nothing has been written yet: signals end the program at once, with one line and the exit status of an interrupted
// run.
void exit_on_interrupts();

// From now on signals end the work cleanly; a second signal of the same kind ends the program at once.
void watch_for_interrupts();
[[nodiscard]] bool interrupted();

}  // namespace sunfleck
