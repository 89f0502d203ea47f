#include "simulate/interrupt.h"

#include <unistd.h>

#include <csignal>
#include <initializer_list>

namespace sunfleck {
namespace {

// The only object that a signal handler may write to.
volatile std::sig_atomic_t signal_came = 0;

extern "C" void note_signal(int) {
  signal_came = 1;
}

extern "C" void exit_now(int) {
  constexpr int exit_interrupted = 130;
  constexpr char message[] = "sunfleck: interrupted (before anything was written)\n";
  static_cast<void>(!::write(STDERR_FILENO, message, sizeof message - 1));
  ::_exit(exit_interrupted);
}

void answer_with(void (*handler)(int), int flags) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
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
  return signal_came != 0;
}

}  // namespace sunfleck
