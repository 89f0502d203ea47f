#include "simulate/state_keeper.h"

#include "base/error.h"
#include "base/log.h"
#include "physics/transport/model/lights.h"
#include "physics/transport/model/surfaces.h"

#include <fmt/format.h>

#include <algorithm>

namespace sunfleck {
namespace {

constexpr int pauses_per_write = 50;  // limits writing the state to 1/50 of the time
constexpr std::chrono::milliseconds shortest_pause{500};

// Returns about how long writing a state takes, before any was written: nearly all of its numbers are sums by side of a triangle,
// if light lands there more than once.
std::chrono::duration<double> foretold(Lights lights) {
  constexpr double numbers_per_s = 1e8;
  const RadiationModel& model = lights.front();
  if (!scatters(model) && !any_sky(lights)) return std::chrono::duration<double>(0.0);
  return std::chrono::duration<double>(2.0 * static_cast<double>(model.canopy.size() * model.bands.size() * lights.size()) /
                                       numbers_per_s);
}

}  // namespace

StateKeeper::StateKeeper(const char* command) : command_(command), pause_(shortest_pause) {}

void StateKeeper::attend(Monitor& monitor, const RunStore& store, Lights lights) {
  if (!written_) {
    const auto pause = std::chrono::duration_cast<Clock::duration>(pauses_per_write * foretold(lights));
    pause_ = std::max<Clock::duration>(shortest_pause, pause);
  }
  begin_ = last_ = Clock::now();
  monitor.wants_state = [this] { return is_due(); };
  monitor.receive_state = [this, store](const SolveStateView& state) { keep(store, state); };
}

bool StateKeeper::is_due() {
  begin_ = Clock::now();
  return !failed_ && begin_ - last_ >= pause_;
}

void StateKeeper::keep(const RunStore& store, const SolveStateView& state) {
  if (failed_) return;
  try {
    store.write(state);
    written_ = true;
  } catch (const Error& error) {
    failed_ = true;
    warn(fmt::format("{}; the {} continues, but --resume will find no later state than this", error.what(), command_));
  }
  last_ = Clock::now();
  pause_ = std::max<Clock::duration>(shortest_pause, pauses_per_write * (last_ - begin_));
}

}  // namespace sunfleck
