#include "physics/transport/solve/replicate_queue.h"

#include "base/check.h"
#include "base/pause.h"

#include <algorithm>
#include <chrono>
#include <utility>

namespace sunfleck {
namespace {

bool is_ready(const std::future<std::optional<ReplicateSet>>& future) {
  return future.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

}  // namespace

ReplicateQueue::ReplicateQueue(ReplicateMaker& maker, ReplicateHelpers* helpers, StopQuestion stop)
    : maker_(maker), helpers_(helpers), stop_(std::move(stop)) {}

ReplicateQueue::~ReplicateQueue() {
  dropped_ = true;
}

void ReplicateQueue::begin(const ReplicateOrder& first, std::span<const Conversion> conversions, std::size_t at_once) {
  end();
  at_once_ = std::max<std::size_t>(1, at_once);
  order_ = first;
  conversions_ = conversions;
  taken_ = 0;
  if (helpers_ == nullptr) return;
  helpers_->limit_slots(at_once_);
  blank_ = maker_.blank(first);
}

std::optional<ReplicateSet> ReplicateQueue::next(std::size_t certain, std::size_t possible) {
  Pause pause;
  while (true) {
    fill(std::max(certain, taken_ + 1), possible);
    if (helpers_ != nullptr) collect();
    Making& first = ahead_.front();
    std::optional<ReplicateSet> made;
    if (first.here.valid() && (helpers_ == nullptr || is_ready(first.here))) {
      made = first.here.get();
    } else if (first.elsewhere) {
      made = std::move(first.elsewhere);
    } else if (!stop_()) {
      pause.take();
      continue;
    }
    if (!made) {
      end();
      return std::nullopt;
    }
    ahead_.pop_front();
    ++taken_;
    return made;
  }
}

// Starts replicates; workers get the later ones. Finished replicates wait here for their turn, so the work ahead is limited.
void ReplicateQueue::fill(std::size_t certain, std::size_t possible) {
  const std::size_t all_at_once = at_once_ + (helpers_ != nullptr ? helpers_->slots() : 0);
  const std::size_t most_ahead = helpers_ != nullptr ? 2 * all_at_once : at_once_;
  const auto begun = [this] { return taken_ + ahead_.size(); };
  bool found_hands = true;
  while (found_hands && ahead_.size() < most_ahead) {
    found_hands = false;
    if (begun() < certain && busy_here() < at_once_) {
      begin_here();
      found_hands = true;
    }
    if (helpers_ == nullptr || ahead_.size() >= most_ahead || begun() >= std::max(certain, possible)) continue;
    if (helpers_->free_slots() == 0) continue;
    ReplicateOrder order = order_;
    order.number += begun();
    helpers_->begin(order);
    ahead_.emplace_back();
    found_hands = true;
  }
}

void ReplicateQueue::begin_here() {
  ReplicateOrder order = order_;
  order.number += taken_ + ahead_.size();
  const auto make = [this, order] { return maker_.make(order, conversions_, [this] { return dropped_ || stop_(); }); };
  const bool beside = at_once_ > 1 || helpers_ != nullptr;
  ahead_.emplace_back().here = std::async(beside ? std::launch::async : std::launch::deferred, make);
}

void ReplicateQueue::collect() {
  while (std::optional<MadeReplicate> made = helpers_->take(blank_)) {
    const std::uint64_t place = made->number - order_.number - taken_;
    EXPECT(place, <, ahead_.size());
    for (std::size_t k = 0; k < made->replicates.size(); ++k) {
      made->replicates[k].direct = conversions_[k].sum(made->replicates[k].counters);
    }
    ahead_[place].elsewhere = std::move(made->replicates);
  }
}

void ReplicateQueue::end() {
  if (helpers_ != nullptr) helpers_->drop();
  dropped_ = true;
  ahead_.clear();
  dropped_ = false;
}

std::size_t ReplicateQueue::busy_here() const {
  return static_cast<std::size_t>(std::count_if(ahead_.begin(), ahead_.end(), [this](const Making& making) {
    return making.here.valid() && (helpers_ == nullptr || !is_ready(making.here));
  }));
}

}  // namespace sunfleck
