#include "physics/transport/indirect/pass_arrays.h"

#include <utility>

namespace sunfleck {

std::unique_ptr<PassArrays> SparePassArrays::take() {
  const std::lock_guard lock(mutex_);
  std::unique_ptr<PassArrays> arrays;
  if (spare_.empty()) {
    arrays = std::make_unique<PassArrays>();
  } else {
    arrays = std::move(spare_.back());
    spare_.pop_back();
  }
  arrays->memory = {blocks_, &sums_};
  return arrays;
}

void SparePassArrays::give_back(std::unique_ptr<PassArrays> arrays) {
  const std::lock_guard lock(mutex_);
  spare_.push_back(std::move(arrays));
}

void SparePassArrays::free() {
  const std::lock_guard lock(mutex_);
  spare_.clear();
  sums_.free();
  blocks_->close();
  blocks_ = std::make_shared<SpareBlocks>();
}

}  // namespace sunfleck
