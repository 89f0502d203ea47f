#include "app/interrupt.h"

#include <csignal>

namespace sunfleck {
namespace {

// The one thing a signal handler may write to.
volatile std::sig_atomic_t signal_came = 0;

extern "C" void note_signal(int signal) {
  signal_came = 1;
  std::signal(signal, SIG_DFL);
}

}  // namespace

void watch_for_interrupts() {
  std::signal(SIGINT, note_signal);
  std::signal(SIGTERM, note_signal);
}

bool interrupted() {
  return signal_came != 0;
}

}  // namespace sunfleck
