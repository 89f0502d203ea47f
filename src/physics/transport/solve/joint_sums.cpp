#include "physics/transport/solve/joint_sums.h"

#include <algorithm>
#include <utility>

namespace sunfleck {
namespace {

constexpr std::size_t terms = 6;

// Adds weighted values to sums, one after the other.
class Adder {
 public:
  Adder(std::vector<double>& sums, double weight) : sums_(sums), weight_(weight) {}

  void add(double value) {
    sums_.resize(std::max(sums_.size(), place_ + 1));
    sums_[place_++] += weight_ * value;
  }

 private:
  std::vector<double>& sums_;
  double weight_;
  std::size_t place_ = 0;
};

struct Adders {
  Adder bands, organs, plants, planes;
};

}  // namespace

JointSums::JointSums(LightSum sum, std::span<const std::size_t> group_of_organ, const RunSums& like)
    : sum_(std::move(sum)),
      group_of_organ_(group_of_organ.begin(), group_of_organ.end()),
      bands_(like.conversion.quanta.size()) {
  for (const std::size_t group : group_of_organ_) groups_ = std::max(groups_, group + 1);
  const Conversion& conversion = like.conversion;
  for (const double area_m2 : conversion.areas.organ_m2) organ_area_index_.push_back(area_m2 / conversion.model.plot.area_m2());
  means_.bands.resize(terms * bands_);
  means_.organs.resize(like.organs.size() * bands_);
  means_.plants.resize(like.plants.size() * bands_);
  means_.groups.resize(groups_ * bands_);
  means_.planes.resize(like.planes ? like.planes->planes() * bands_ : 0);
}

void JointSums::add(std::span<const std::unique_ptr<RunSums>> lights) {
  const auto add_to = [](std::vector<ReplicateMean>& means, const std::vector<double>& values) {
    for (std::size_t k = 0; k < values.size(); ++k) means[k].add(values[k]);
  };
  const Figures<double> last = last_values(lights);
  add_to(means_.bands, last.bands);
  add_to(means_.organs, last.organs);
  add_to(means_.plants, last.plants);
  add_to(means_.groups, last.groups);
  add_to(means_.planes, last.planes);
}

// Sums over the lights what add_light(light, adders) adds for each.
template <class AddLight>
JointSums::Figures<double> JointSums::weighted(const AddLight& add_light) const {
  Figures<double> figures;
  for (const LightShare& share : sum_) {
    Adders adders{Adder(figures.bands, share.weight), Adder(figures.organs, share.weight), Adder(figures.plants, share.weight),
                  Adder(figures.planes, share.weight)};
    add_light(share.light, adders);
  }
  figures.groups = grouped(figures.organs);
  return figures;
}

JointSums::Figures<double> JointSums::last_values(std::span<const std::unique_ptr<RunSums>> lights) const {
  return weighted([&](std::size_t light, Adders& to) {
    const RunSums& sums = *lights[light];
    for (const BandMeans& band : sums.bands) {
      for (const auto* mean :
           {&band.incident, &band.vegetation, &band.structure, &band.soil, &band.reflected, &band.transmitted})
        to.bands.add(mean->last());
    }
    for (const OrganMeans& organ : sums.organs) {
      for (const ReplicateMean& mean : organ.absorbed) to.organs.add(mean.last());
    }
    for (const PlantMeans& plant : sums.plants) {
      for (const ReplicateMean& mean : plant.absorbed) to.plants.add(mean.last());
    }
    for (std::size_t p = 0; sums.planes && p < sums.planes->planes(); ++p) {
      for (std::size_t b = 0; b < bands_; ++b) to.planes.add(sums.planes->down(p, b).last());
    }
  });
}

JointSums::Figures<double> JointSums::half_widths(std::span<const RadiationResult> lights) const {
  return weighted([&](std::size_t light, Adders& to) {
    const RadiationResult& result = lights[light];
    for (const BandResult& band : result.bands) {
      for (const auto* flux : {&band.incident, &band.absorbed_vegetation, &band.absorbed_structure, &band.absorbed_soil,
                               &band.reflected, &band.transmitted})
        to.bands.add(flux->half_width);
    }
    for (const OrganResult& organ : result.organs) {
      for (const Estimate& flux : organ.absorbed) to.organs.add(flux.half_width);
    }
    for (const PlantResult& plant : result.plants) {
      for (const Estimate& flux : plant.absorbed_w) to.plants.add(flux.half_width);
    }
    for (const PlaneResult& plane : result.planes) {
      for (const Estimate& flux : plane.total_down) to.planes.add(flux.half_width);
    }
  });
}

std::vector<double> JointSums::grouped(const std::vector<double>& organs) const {
  std::vector<double> groups(groups_ * bands_);
  for (std::size_t o = 0; o < group_of_organ_.size(); ++o) {
    for (std::size_t b = 0; b < bands_; ++b)
      groups[group_of_organ_[o] * bands_ + b] += organ_area_index_[o] * organs[o * bands_ + b];
  }
  return groups;
}

JointErrors JointSums::errors(double t_quantile, std::span<const RadiationResult> lights) const {
  const Figures<double> bounds = half_widths(lights);
  const auto errors_of = [&](const std::vector<ReplicateMean>& means, const std::vector<double>& at_most) {
    std::vector<double> errors;
    for (std::size_t k = 0; k < means.size(); ++k) {
      const double error = t_quantile * means[k].standard_error();
      errors.push_back(error > 0.0 ? error : at_most[k]);
    }
    return errors;
  };
  const std::vector<double> bands = errors_of(means_.bands, bounds.bands);
  JointErrors errors{{},
                     errors_of(means_.organs, bounds.organs),
                     errors_of(means_.plants, bounds.plants),
                     errors_of(means_.groups, bounds.groups),
                     errors_of(means_.planes, bounds.planes)};
  for (std::size_t b = 0; b < bands_; ++b) {
    const double* const term = &bands[b * terms];
    errors.bands.push_back({term[0], term[1], term[2], term[3], term[4], term[5]});
  }
  return errors;
}

}  // namespace sunfleck
