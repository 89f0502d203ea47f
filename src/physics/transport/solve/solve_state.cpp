#include "physics/transport/solve/solve_state.h"

#include "base/each_number.h"
#include "physics/light/beam_grid.h"
#include "physics/transport/model/surfaces.h"
#include "physics/transport/receivers/planes.h"
#include "physics/transport/solve/run_sums.h"

#include <optional>
#include <span>
#include <type_traits>
#include <utility>

namespace sunfleck {
namespace {

// Returns the integers of the sums, or their other numbers.
template <class T>
NumberPieces<T> numbers_of(const RunSums& sums) {
  return [&sums](const std::function<void(std::span<const T>)>& take) {
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
    RunSums::visit(sums, collect);
    take(piece);
  };
}

template <class T>
NumberPieces<T> one_piece(const std::vector<T>& values) {
  return [&values](const std::function<void(std::span<const T>)>& take) { take(values); };
}

template <class T>
std::vector<T> all_of(const NumberPieces<T>& pieces) {
  std::vector<T> values;
  pieces([&](std::span<const T> piece) { values.insert(values.end(), piece.begin(), piece.end()); });
  return values;
}

PlainSums copied(const SumPieces& pieces) {
  return {all_of(pieces.integers), all_of(pieces.reals)};
}

}  // namespace

SumPieces pieces_of(const RunSums& sums) {
  return {numbers_of<std::int64_t>(sums), numbers_of<double>(sums)};
}

PlainSums plain_sums(const RunSums& sums) {
  return copied(pieces_of(sums));
}

SolveStateView::SolveStateView(Work of_work, std::size_t check, SumPieces pieces)
    : work(of_work), next_check(check), sums(std::move(pieces)) {}

SolveStateView::SolveStateView(const SolveState& state)
    : SolveStateView(state.work, state.next_check, {one_piece(state.sums.integers), one_piece(state.sums.reals)}) {}

SolveStateView::operator SolveState() const {
  return {work, next_check, copied(sums)};
}

bool restore(RunSums& sums, const PlainSums& plain) {
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
  RunSums::visit(sums, read);
  return integers == plain.integers.size() && reals == plain.reals.size();
}

std::size_t SolveState::replicates() const {
  return sums.integers.empty() ? 0 : static_cast<std::size_t>(sums.integers.front());
}

SolveState blank_state(const RadiationModel& model, const CounterLayout& layout, ElementErrors element_errors) {
  const Surfaces surfaces(model);
  std::optional<PlaneReceivers> receivers;
  if (!model.planes.empty()) receivers.emplace(model, layout, surfaces);
  SolveState blank;
  blank.work = {model.has_beam() ? 1.0 : 0.0, 0.0};
  const CanopyAreas areas(model, layout, surfaces);
  const Conversion conversion(model, layout, surfaces, areas, receivers ? &*receivers : nullptr, {});
  blank.sums = plain_sums(RunSums(conversion, element_errors));
  return blank;
}

bool is_state_of(const SolveState& state, const SolveState& blank) {
  const auto is_in = [](auto value, auto least, auto most) { return value >= least && value <= most; };
  return state.sums.integers.size() == blank.sums.integers.size() && state.sums.reals.size() == blank.sums.reals.size() &&
         is_in(state.replicates(), std::size_t{2}, most_replicates) &&
         is_in(state.work.rays, blank.work.rays, static_cast<double>(max_grid_rays)) &&
         is_in(state.work.packets, 0.0, most_first_packets) && is_in(state.next_check, first_check, most_replicates);
}

}  // namespace sunfleck
