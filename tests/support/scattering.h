#pragma once
// Scenes that scatter or emit light, checks that hold for every result, and estimates of values for which a result has no
// error.

#include "support/comparison.h"
#include "support/models.h"

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace sunfleck::test {

// Sets both faces to the same optics.
inline void set_faces(RadiationModel& model, std::size_t optics, const std::vector<FaceOptics>& faces) {
  model.optics.at(optics).upper = model.optics.at(optics).lower = faces;
}

// Returns settings with this many beam rays and first packets in each replicate; the unshot flux, below 1e-9 of the incident,
// does not matter.
inline SolveSettings fixed_packets(const RadiationModel& model, double packets, int replicates = usual_replicates,
                                   std::uint64_t seed = 1) {
  SolveSettings settings = fixed_work(model, packets * replicates, replicates, seed);
  settings.packets = packets;
  settings.accuracy.indirect = 1e-6;
  return settings;
}

// Checks what holds in every scene. Without a beam the incident flux is the flux that the lamps emit.
inline void expect_sound(const RadiationModel& model, const RadiationResult& result) {
  EXPECT_EQ(result.lost_rays, 0U);
  for (std::size_t b = 0; b < result.bands.size(); ++b) {
    EXPECT_EQ(result.bands[b].ledger.residual(), 0) << result.bands[b].name;
    if (model.has_beam()) continue;
    double emitted_w = 0.0;
    for (std::size_t e = 0; e < model.canopy.size(); ++e) {
      const SurfaceOptics& optics = model.optics[model.canopy.optics_of[e]];
      if (!optics.emission_w_m2.empty()) emitted_w += optics.emission_w_m2[b] * area_m2(model.canopy.corners[e]);
    }
    EXPECT_NEAR(result.bands[b].incident.value * model.plot.area_m2(), emitted_w, 1e-9 * emitted_w) << result.bands[b].name;
    EXPECT_EQ(result.bands[b].incident.half_width, 0.0) << result.bands[b].name;
  }
}

inline RadiationResult simulate_soundly(const RadiationModel& model, const SolveSettings& settings) {
  RadiationResult result = simulate(model, settings);
  expect_sound(model, result);
  return result;
}

// Estimates all light on the two sides of groups of elements and on the soil plane, with errors from independent runs of one
// replicate.
class SideIrradiance {
 public:
  // `group_of`, [element], numbers the groups from 0 without gaps.
  SideIrradiance(const RadiationModel& model, std::vector<std::uint32_t> group_of, double packets, int runs,
                 std::uint64_t first_seed)
      : model_(model), group_of_(std::move(group_of)), bands_(model.bands.size()), soil_(bands_) {
    for (std::size_t e = 0; e < group_of_.size(); ++e) {
      area_m2_.resize(std::max<std::size_t>(area_m2_.size(), group_of_[e] + 1));
      area_m2_[group_of_[e]] += area_m2(model.canopy.corners[e]);
    }
    sides_.resize(area_m2_.size() * 2 * bands_);
    const Prepared prepared(model);
    for (int run = 0; run < runs; ++run) {
      const auto seed = first_seed + static_cast<std::uint64_t>(run);
      const RadiationResult result = simulate(model, prepared, fixed_packets(model, packets, 1, seed));
      expect_sound(model, result);
      add(result);
    }
  }

  // Returns W m-2 of the group's one-sided area; side 0 is the upper one.
  [[nodiscard]] Estimate of(std::size_t group, std::size_t side, std::size_t band) const {
    return estimate_of(sides_.at((group * 2 + side) * bands_ + band));
  }
  // Returns W m-2 of ground.
  [[nodiscard]] Estimate of_soil(std::size_t band) const { return estimate_of(soil_.at(band)); }

 private:
  void add(const RadiationResult& result) {
    for (std::size_t b = 0; b < bands_; ++b) {
      const double beam_w_m2 = model_.has_beam() ? model_.bands[b].direct_w_m2 : 0.0;
      std::vector<double> sums(area_m2_.size() * 2);
      for (std::size_t e = 0; e < group_of_.size(); ++e) {
        const std::uint64_t landings[2] = {result.elements[e].upper, result.elements[e].lower};
        for (std::size_t side = 0; side < 2; ++side) {
          sums[group_of_[e] * 2 + side] += result.irradiance_w_m2(landings[side], area_m2_[group_of_[e]], beam_w_m2) +
                                           result.side_indirect_w_m2(2 * e + side, area_m2_[group_of_[e]], b);
        }
      }
      for (std::size_t side = 0; side < sums.size(); ++side) sides_[side * bands_ + b].add(sums[side]);
      double soil = 0.0;
      for (std::size_t cell = 0; cell < result.soil_cells.size(); ++cell) {
        soil += result.irradiance_w_m2(result.soil_cells[cell], model_.plot.area_m2(), beam_w_m2) +
                result.cell_indirect_w_m2(cell, model_.plot.area_m2(), b);
      }
      soil_[b].add(soil);
    }
  }

  const RadiationModel& model_;
  std::vector<std::uint32_t> group_of_;
  std::size_t bands_;
  std::vector<double> area_m2_;       // [group]
  std::vector<ReplicateMean> sides_;  // [(group * 2 + side) * bands + band]
  std::vector<ReplicateMean> soil_;   // [band]
};

}  // namespace sunfleck::test
