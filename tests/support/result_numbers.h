#pragma once
// Returns every number of a result except clock times, bit by bit: two runs are identical if these numbers are.

#include "physics/transport/model/result.h"

#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

namespace sunfleck::test {

inline std::vector<std::uint64_t> all_numbers(const RadiationResult& result) {
  std::vector<std::uint64_t> words;
  const auto integer = [&](auto value) { words.push_back(static_cast<std::uint64_t>(value)); };
  const auto number = [&](double value) { words.push_back(std::bit_cast<std::uint64_t>(value)); };
  const auto estimates = [&](std::span<const Estimate> all) {
    for (const Estimate& estimate : all) number(estimate.value), number(estimate.half_width);
  };
  const auto classes = [&](const ShadeClassResult& of) {
    estimates(std::array{of.sunlit_m2, of.shaded_m2});
    for (const auto* all : {&of.absorbed_sunlit, &of.absorbed_shaded, &of.sunlit_sd, &of.shaded_sd}) estimates(*all);
  };
  for (const BandResult& band : result.bands) {
    const FluxLedger& ledger = band.ledger;
    for (const std::int64_t term : {ledger.incident, ledger.absorbed_vegetation, ledger.absorbed_structure,
                                    ledger.absorbed_soil, ledger.reflected, ledger.transmitted, ledger.unshot}) {
      integer(term);
    }
    number(band.incident.value);
    number(band.incident.half_width);
    number(band.unshot);
    estimates(
        std::array{band.absorbed_vegetation, band.absorbed_structure, band.absorbed_soil, band.reflected, band.transmitted});
  }
  for (const OrganResult& organ : result.organs) {
    number(organ.area_m2);
    estimates(std::array{organ.sunlit_fraction});
    for (const auto* all : {&organ.direct, &organ.indirect, &organ.absorbed}) estimates(*all);
    classes(organ.classes);
  }
  for (const PlantResult& plant : result.plants) {
    estimates(std::array{plant.sunlit_leaf_fraction});
    for (const auto* all : {&plant.incident_w, &plant.absorbed_w}) estimates(*all);
  }
  for (const LayerResult& layer : result.layers) {
    number(layer.height_m);
    number(layer.leaf_area_index);
    estimates(std::array{layer.sunfleck_ratio, layer.sunlit_leaf_fraction});
    for (const auto* all : {&layer.down, &layer.up, &layer.absorbed, &layer.absorbed_structure}) estimates(*all);
    classes(layer.leaf_classes);
  }
  for (const auto parts : result.side_direct) integer(parts);
  for (const double error : result.side_error) number(error);
  for (const double error : result.triangle_relative_error) number(error);
  for (const BeamLandings& element : result.elements) integer(element.upper), integer(element.lower);
  for (const double error : result.element_error) number(error);
  for (const auto landings : result.soil_cells) integer(landings);
  for (const auto quanta : result.side_indirect) integer(quanta);
  for (const auto quanta : result.cell_indirect) integer(quanta);
  for (const auto quanta : result.side_sky) integer(quanta);
  for (const auto quanta : result.cell_sky) integer(quanta);
  for (const PlaneResult& plane : result.planes) {
    for (const auto rays : plane.reached) integer(rays);
    for (const auto rays : plane.crossing) integer(rays);
    for (const auto quanta : plane.down) integer(quanta);
    estimates(std::array{plane.sunfleck_ratio});
    estimates(plane.total_down);
  }
  for (const double watts : result.w_per_quantum) number(watts);
  classes(result.leaf_classes);
  estimates(std::array{result.sunlit_leaf_fraction, result.ground_sunfleck_ratio});
  integer(result.lost_rays);
  integer(result.direct.rays);
  integer(result.direct.replicates);
  integer(result.indirect.sky_rays);
  integer(result.indirect.packets);
  integer(result.indirect.rounds);
  return words;
}

}  // namespace sunfleck::test
