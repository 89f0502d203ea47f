#include "physics/transport/solve/solve_state.h"

#include "base/each_number.h"
#include "physics/light/beam_grid.h"
#include "physics/transport/model/surfaces.h"
#include "physics/transport/receivers/planes.h"
#include "physics/transport/solve/series.h"

#include <algorithm>
#include <optional>
#include <span>
#include <type_traits>

namespace sunfleck {
namespace {

// Returns the integers of all sums, or their other numbers.
template <class T>
NumberPieces<T> numbers_of(const Series& series) {
  return [&series](const std::function<void(std::span<const T>)>& take) {
    constexpr std::size_t most = 8192;
    std::vector<T> piece;
    piece.reserve(most);
    const EachNumber collect([&](auto number) {
      if constexpr (std::is_integral_v<decltype(number)> == std::is_integral_v<T>) {
        piece.push_back(static_cast<T>(number));
        if (piece.size() < most) return;
        take(piece);
        piece.clear();
      }
    });
    Series::visit(series, collect);
    take(piece);
  };
}

}  // namespace

SumPieces pieces_of(const Series& series) {
  return {numbers_of<std::int64_t>(series), numbers_of<double>(series)};
}

bool restore(Series& series, const PlainSums& plain) {
  std::size_t integers = 0;
  std::size_t reals = 0;
  const auto next = [](const auto& values, std::size_t& k) { return k++ < values.size() ? values[k - 1] : 0; };
  const EachNumber read([&]<class T>(T& number) {
    if constexpr (std::is_integral_v<T>) {
      number = static_cast<T>(next(plain.integers, integers));
    } else {
      number = next(plain.reals, reals);
    }
  });
  Series::visit(series, read);
  return integers == plain.integers.size() && reals == plain.reals.size();
}

std::size_t SolveState::replicates() const {
  return sums.integers.empty() ? 0 : static_cast<std::size_t>(sums.integers.front());
}

StateShape state_shape(Lights lights, const CounterLayout& layout, const SolveSettings& settings, const WantedSums& wanted) {
  const RadiationModel& model = lights.front();
  const Surfaces surfaces(model);
  std::optional<PlaneReceivers> receivers;
  if (!model.planes.empty()) receivers.emplace(model, layout, surfaces);
  StateShape shape{.lights = lights.size(), .least_rays = any_beam(lights) ? 1.0 : 0.0};
  const EachNumber count([&shape](auto number) { ++(std::is_integral_v<decltype(number)> ? shape.integers : shape.reals); });
  for (std::size_t k = 0; k < lights.size(); ++k) {
    const CanopyAreas areas(lights[k], layout, surfaces);
    const Conversion conversion(lights[k], layout, surfaces, areas, receivers ? &*receivers : nullptr, {});
    const RunSums sums(conversion, settings.element_errors, settings.shade_groups, lights);
    RunSums::visit(sums, count);
    if (k > 0) continue;
    for (const LightSum& sum : wanted.of_lights) {
      const JointSums joint(sum, wanted.group_of_organ, sums);
      count(joint);
    }
  }
  return shape;
}

bool is_state_of(const SolveState& state, const StateShape& shape) {
  const auto is_in = [](auto value, auto least, auto most) { return value >= least && value <= most; };
  const std::size_t shares = state.ray_shares.size();
  return state.sums.integers.size() == shape.integers && state.sums.reals.size() == shape.reals &&
         is_in(state.replicates(), std::size_t{2}, most_replicates) && (shares == 0 || shares == shape.lights) &&
         std::all_of(state.ray_shares.begin(), state.ray_shares.end(), [&](double s) { return is_in(s, 0.0, 1.0); }) &&
         is_in(state.work.rays, shape.least_rays, static_cast<double>(max_grid_rays)) &&
         is_in(state.work.packets, 0.0, most_first_packets) && is_in(state.next_check, first_check, most_replicates);
}

}  // namespace sunfleck
