#include "transport/solve_state.h"

#include "light/beam_grid.h"
#include "transport/planes.h"
#include "transport/surfaces.h"
#include "transport/tally.h"

#include <optional>

namespace sunfleck {

std::size_t SolveState::replicates() const {
  return sums.integers.empty() ? 0 : static_cast<std::size_t>(sums.integers.front());
}

SolveState blank_state(const RadiationModel& model, const CounterLayout& layout, ElementErrors element_errors) {
  const Surfaces surfaces(model);
  std::optional<PlaneReceivers> receivers;
  if (!model.planes.empty()) receivers.emplace(model, layout, surfaces);
  SolveState blank;
  blank.work = {model.has_beam() ? 1.0 : 0.0, 0.0};
  blank.sums = Tally(model, layout, surfaces, receivers ? &*receivers : nullptr, {}, element_errors).sums();
  return blank;
}

bool is_state_of(const SolveState& state, const SolveState& blank) {
  const auto is_in = [](auto value, auto least, auto most) { return value >= least && value <= most; };
  return state.sums.integers.size() == blank.sums.integers.size() && state.sums.reals.size() == blank.sums.reals.size() &&
         is_in(state.replicates(), std::size_t{2}, most_replicates) &&
         is_in(state.work.rays, blank.work.rays, static_cast<double>(max_grid_rays)) &&
         is_in(state.work.packets, 0.0, most_first_packets) && is_in(state.next_check, first_check, most_replicates) &&
         state.good_checks < 2;
}

}  // namespace sunfleck
