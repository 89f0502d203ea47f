#pragma once
// Ctrl-C and SIGTERM end the work cleanly; a second signal ends the program at once.

namespace sunfleck {

void watch_for_interrupts();
[[nodiscard]] bool interrupted();

}  // namespace sunfleck
