#pragma once
// Runs the program with the library of tests/faults/system_faults.cpp preloaded: what happens to it depends only on its
// actions, never on the speed of the machine.

#include "regression/program.h"

#include <map>

namespace sunfleck::regression {

// Returns an entry of SUNFLECK_FAULT_SIGNALS: the signal is sent at the `count`-th event of this kind.
inline std::string signal_at(int signal, const std::string& event, int count = 1) {
  std::string list;
  for (int k = 1; k < count; ++k) list += "0@" + event + ",";
  return list + std::to_string(signal) + "@" + event;
}

class PreloadTest : public ProgramTest {
 protected:
  using Variables = std::map<std::string, std::string>;

  void preload(const Variables& variables) {
    before_program_ = [variables] {
      ::setenv("LD_PRELOAD", SUNFLECK_SYSTEM_FAULTS, 1);
      for (const auto& [name, value] : variables) ::setenv(name.c_str(), value.c_str(), 1);
    };
  }

  // Removes the library until preload is called again.
  void preload_nothing() { before_program_ = {}; }

  // Sends signals at events in the folder `out`.
  void preload_signals(const std::string& signals, Variables more = {}) {
    more["SUNFLECK_FAULT_FOLDER"] = (folder_ / "out").string();
    more["SUNFLECK_FAULT_SIGNALS"] = signals;
    preload(more);
  }
};

}  // namespace sunfleck::regression
