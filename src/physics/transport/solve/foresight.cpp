#include "physics/transport/solve/foresight.h"

#include "physics/transport/model/band_quanta.h"
#include "physics/transport/model/statistics.h"

#include <algorithm>
#include <cmath>

namespace sunfleck {

std::size_t replicates_needed(double error, double bound, double confidence, std::size_t done, std::size_t most) {
  const double per_quantile = error / bound / t_quantile(confidence, done);
  double needed = static_cast<double>(done);
  // The quantile changes little except at very few replicates, so a few iterations are enough.
  for (int turn = 0; turn < 4; ++turn) {
    const double ratio = per_quantile * t_quantile(confidence, static_cast<std::size_t>(needed));
    needed =
        std::clamp(std::ceil(static_cast<double>(done) * ratio * ratio), static_cast<double>(done), static_cast<double>(most));
  }
  return static_cast<std::size_t>(needed);
}

std::size_t check_after(std::size_t done, std::size_t needed, ErrorTarget of) {
  const std::size_t least = of == ErrorTarget::triangle ? std::max<std::size_t>(4, done / 8) : 2;
  const std::size_t half_way = needed > done ? (needed - done) / 2 : 0;
  return std::min(most_replicates, done + std::max(least, half_way));
}

double Completion::update(double done, double expected) {
  const double before = expected - done_;
  const double after = expected - done;
  if (done > done_ && before > 0.0) left_ *= std::clamp(after / before, 0.0, 1.0);
  done_ = std::max(done_, done);
  return 1.0 - left_;
}

}  // namespace sunfleck
