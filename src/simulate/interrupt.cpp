#include "simulate/interrupt.h"

#include <unistd.h>

#include <atomic>
#include <csignal>

namespace sunfleck {
namespace {

// Lock-free, so that a signal handler may write to it and any thread may read it.
std::atomic<bool> signal_came = false;
static_assert(std::atomic<bool>::is_always_lock_free);

extern "C" void note_signal(int) {
  signal_came = true;
}

extern "C" void exit_now(int) {
  constexpr char message[] = "sunfleck: interrupted (before anything was written)\n";
  static_cast<void>(!::write(STDERR_FILENO, message, sizeof message - 1));
  ::_exit(exit_interrupted);
}

void answer_with(void (*handler)(int), int flags) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGUSR1, SIGXCPU}) {
    struct sigaction action {};
    if (::sigaction(signal, nullptr, &action) != 0 || action.sa_handler == SIG_IGN) continue;
    action = {};
    action.sa_handler = handler;
    action.sa_flags = flags;
    ::sigaction(signal, &action, nullptr);
  }
}

}  // namespace

void exit_on_interrupts() {
  answer_with(exit_now, 0);
}

void watch_for_interrupts() {
  answer_with(note_signal, SA_RESTART | static_cast<int>(SA_RESETHAND));
}

bool interrupted() {
  return signal_came;
}

}  // namespace sunfleck
