#pragma once
// A long array that is read piece by piece, so that nobody needs to hold a copy of it.

#include <functional>
#include <span>

namespace sunfleck {

// Passes all numbers to `take`, in their order.
template <class T>
using NumberPieces = std::function<void(const std::function<void(std::span<const T>)>& take)>;

}  // namespace sunfleck
