#pragma once
// States of runs as tests hand them over and keep them.

#include "physics/transport/solve/solve_state.h"

#include <functional>
#include <span>
#include <vector>

namespace sunfleck::test {

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

// Returns a view of a state, which must outlive it.
inline SolveStateView view_of(const SolveState& state) {
  return {state.work, state.ray_shares, state.next_check, {one_piece(state.sums.integers), one_piece(state.sums.reals)}};
}

inline SolveState copy_of(const SolveStateView& view) {
  return {view.work, view.ray_shares, view.next_check, {all_of(view.sums.integers), all_of(view.sums.reals)}};
}

}  // namespace sunfleck::test
