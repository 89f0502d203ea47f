#include "physics/transport/receivers/sensor_tally.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace sunfleck {

SensorTally::SensorTally(ExactLight exact, std::vector<double> sky_w_m2)
    : exact_(std::move(exact)), sky_w_m2_(std::move(sky_w_m2)), scattered_(sky_w_m2_.size()), total_(sky_w_m2_.size()) {}

void SensorTally::add(const SampledLight& light) {
  sky_.add(light.sky);
  for (std::size_t b = 0; b < total_.size(); ++b) {
    scattered_[b].add(light.scattered[b]);
    total_[b].add(exact_.direct_w_m2[b] + exact_.sky.value_or(light.sky) * sky_w_m2_[b] + light.scattered[b]);
  }
}

SampledLight SensorTally::unseen(SampledLight event) const {
  if (exact_.sky || sky_.squares() > 0.0) event.sky = 0.0;
  for (std::size_t b = 0; b < scattered_.size(); ++b)
    if (scattered_[b].squares() > 0.0) event.scattered[b] = 0.0;
  return event;
}

SensorResult SensorTally::result(const SampledLight& unseen, double confidence) const {
  const auto n = static_cast<double>(replicates());
  const double quantile = t_quantile(confidence, replicates());
  const auto estimate = [&](const ReplicateMean& mean, double event) -> Estimate {
    return {mean.mean(), std::hypot(quantile * mean.standard_error(), unseen_events(confidence) * event / n)};
  };
  const Estimate sky = exact_.sky ? Estimate{*exact_.sky, 0.0} : estimate(sky_, unseen.sky);
  SensorResult result;
  for (std::size_t b = 0; b < total_.size(); ++b) {
    result.direct.push_back({exact_.direct_w_m2[b], 0.0});
    result.sky.push_back(sky.scaled(sky_w_m2_[b]));
    result.scattered.push_back(estimate(scattered_[b], unseen.scattered[b]));
    result.total.push_back(estimate(total_[b], std::max(unseen.sky * sky_w_m2_[b], unseen.scattered[b])));
  }
  return result;
}

}  // namespace sunfleck
