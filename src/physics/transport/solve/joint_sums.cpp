#include "physics/transport/solve/joint_sums.h"

namespace sunfleck {
namespace {

// Calls take(mean) for every figure of a sum, always in the same order.
template <class Take>
void for_each_figure(const RunSums& sums, const Take& take) {
  for (const BandMeans& band : sums.bands) {
    for (const auto* mean : {&band.vegetation, &band.structure, &band.soil, &band.reflected, &band.transmitted}) take(*mean);
  }
  for (const OrganMeans& organ : sums.organs) {
    for (const ReplicateMean& mean : organ.absorbed) take(mean);
  }
  for (const PlantMeans& plant : sums.plants) {
    for (const ReplicateMean& mean : plant.absorbed) take(mean);
  }
}

}  // namespace

void JointSums::add(std::span<const std::unique_ptr<RunSums>> lights) {
  std::vector<double> values(figures_.size());
  for (const LightShare& share : sum_) {
    const RunSums& sums = *lights[share.light];
    bands_ = sums.bands.size();
    organs_ = sums.organs.size();
    std::size_t figure = 0;
    for_each_figure(sums, [&](const ReplicateMean& mean) {
      if (figure == values.size()) values.push_back(0.0);
      values[figure++] += share.weight * mean.last();
    });
  }
  figures_.resize(values.size());
  for (std::size_t k = 0; k < values.size(); ++k) figures_[k].add(values[k]);
}

JointErrors JointSums::errors(double t_quantile) const {
  JointErrors errors;
  auto figure = figures_.begin();
  const auto next = [&] { return t_quantile * (figure++)->standard_error(); };
  for (std::size_t b = 0; b < bands_; ++b) {
    JointErrors::Band& band = errors.bands.emplace_back();
    for (double* const term : {&band.vegetation, &band.structure, &band.soil, &band.reflected, &band.transmitted})
      *term = next();
  }
  for (std::size_t k = 0; k < organs_ * bands_; ++k) errors.organs.push_back(next());
  while (figure != figures_.end()) errors.plants.push_back(next());
  return errors;
}

}  // namespace sunfleck
