#include "physics/transport/indirect/pass_arrays.h"

#include <utility>

namespace sunfleck {

std::unique_ptr<PassArrays> SparePassArrays::take() {
  const std::lock_guard lock(mutex_);
  if (spare_.empty()) return std::make_unique<PassArrays>();
  std::unique_ptr<PassArrays> arrays = std::move(spare_.back());
  spare_.pop_back();
  return arrays;
}

void SparePassArrays::give_back(std::unique_ptr<PassArrays> arrays) {
  const std::lock_guard lock(mutex_);
  spare_.push_back(std::move(arrays));
}

void SparePassArrays::free() {
  const std::lock_guard lock(mutex_);
  spare_.clear();
}

}  // namespace sunfleck
