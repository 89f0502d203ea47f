#include "files/results/tables/day_course.h"

#include "base/check.h"
#include "physics/transport/model/plant_areas.h"
#include "physics/transport/model/surfaces.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <numeric>
#include <optional>

namespace sunfleck {
namespace {

constexpr Estimate zero{0.0, 0.0};

constexpr Estimate StepBand::*terms[] = {&StepBand::incident,           &StepBand::absorbed_vegetation,
                                         &StepBand::absorbed_structure, &StepBand::absorbed_soil,
                                         &StepBand::reflected,          &StepBand::transmitted};

// A sum of fluxes; the half-width of `random` holds only the random errors.
struct Sum {
  Estimate random{0.0, 0.0};
  double unshot = 0.0;

  void add(const Estimate& flux, double unshot_part, double length_s, std::optional<double> shared_half_width) {
    random.value += flux.value * length_s;
    random.half_width = std::hypot(random.half_width, shared_half_width.value_or((flux.half_width - unshot_part) * length_s));
    unshot += unshot_part * length_s;
  }
  [[nodiscard]] Estimate estimate() const { return {random.value, random.half_width + unshot}; }
};

struct Sums {
  std::size_t steps = 0;
  std::vector<std::array<Sum, std::size(terms)>> bands;
  std::vector<Sum> organs;  // [organ * bands + band]
  std::vector<Sum> plants;  // [plant * bands + band]

  void add(const StepLight& light, double length_s) {
    EXPECT(light.bands.size(), ==, bands.size());
    EXPECT(light.organ_absorbed.size(), ==, organs.size());
    EXPECT(light.plant_absorbed_w.size(), ==, plants.size());
    ++steps;
    for (std::size_t b = 0; b < bands.size(); ++b) {
      const StepBand& band = light.bands[b];
      for (std::size_t t = 0; t < std::size(terms); ++t) {
        const Estimate& flux = band.*terms[t];
        bands[b][t].add(flux, std::min(flux.half_width, band.unshot), length_s, shared(light, shared_term(light, b, t)));
      }
      const double absorbed = band.absorbed_vegetation.value + band.absorbed_structure.value + band.absorbed_soil.value;
      const double unshot_share = absorbed > 0.0 ? band.unshot / absorbed : 0.0;
      const auto add_to = [&](std::vector<Sum>& sums, const std::vector<Estimate>& fluxes,
                              const std::vector<double>& of_shared) {
        for (std::size_t i = b; i < sums.size(); i += bands.size())
          sums[i].add(fluxes[i], std::min(fluxes[i].half_width, fluxes[i].value * unshot_share), length_s,
                      shared(light, of_shared[i]));
      };
      add_to(organs, light.organ_absorbed, light.of_shared.organs);
      add_to(plants, light.plant_absorbed_w, light.of_shared.plants);
    }
  }

  // Returns the half-width if the step shares its packets with others; nothing otherwise.
  static std::optional<double> shared(const StepLight& light, double half_width) {
    return light.shares_packets ? std::optional(half_width) : std::nullopt;
  }
  // Returns the error of a term of `terms`. That of the incident flux is bounded by the sum over its parts; in an endless canopy the
  // flux is exact.
  static double shared_term(const StepLight& light, std::size_t band, std::size_t term) {
    const JointErrors::Band& errors = light.of_shared.bands[band];
    const double parts[] = {errors.vegetation, errors.structure, errors.soil, errors.reflected, errors.transmitted};
    if (term > 0) return parts[term - 1];
    return light.bands[band].incident.half_width > 0.0 ? std::accumulate(std::begin(parts), std::end(parts), 0.0) : 0.0;
  }

  [[nodiscard]] DateSums sums() const {
    DateSums date;
    date.steps = steps;
    for (const auto& band : bands) {
      StepBand sums;
      for (std::size_t t = 0; t < std::size(terms); ++t) sums.*terms[t] = band[t].estimate();
      sums.unshot = band.back().unshot;
      date.bands.push_back(sums);
    }
    for (const Sum& organ : organs) date.organ_absorbed.push_back(organ.estimate());
    for (const Sum& plant : plants) date.plant_absorbed.push_back(plant.estimate());
    return date;
  }
};

}  // namespace

std::string local_time_text(const UtcTime& time, int offset_minutes) {
  const UtcTime local = plus_seconds(time, 60.0 * offset_minutes);
  const int off = std::abs(offset_minutes);
  return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}{}{:02}:{:02}", local.year, local.month, local.day, local.hour,
                     local.minute, static_cast<int>(local.second), offset_minutes < 0 ? '-' : '+', off / 60, off % 60);
}

StepLight step_light(const RadiationModel& model, const RadiationResult& result) {
  StepLight light;
  for (const BandResult& band : result.bands) {
    StepBand step{{band.incident, 0.0}, band.absorbed_vegetation, band.absorbed_structure,
                  band.absorbed_soil,   band.reflected,           band.transmitted,
                  band.unshot};
    if (!model.plot.periodic) {
      step.incident.half_width = band.absorbed_vegetation.half_width + band.absorbed_structure.half_width +
                                 band.absorbed_soil.half_width + band.reflected.half_width + band.transmitted.half_width;
    }
    light.bands.push_back(step);
  }
  for (const OrganResult& organ : result.organs) {
    light.organ_absorbed.insert(light.organ_absorbed.end(), organ.absorbed.begin(), organ.absorbed.end());
  }
  for (const PlantResult& plant : result.plants) {
    light.plant_absorbed_w.insert(light.plant_absorbed_w.end(), plant.absorbed_w.begin(), plant.absorbed_w.end());
  }
  light.sunlit_leaf_fraction = result.sunlit_leaf_fraction;
  light.leaf_classes = result.leaf_classes;
  light.of_shared = no_joint_errors(result.bands.size(), result.organs.size(), result.plants.size());
  return light;
}

StepLight night_light(const RadiationModel& model) {
  const std::size_t bands = model.bands.size();
  const std::vector<Estimate> dark(bands, zero);
  return {std::vector<StepBand>(bands, {zero, zero, zero, zero, zero, zero, 0.0}),
          std::vector<Estimate>(model.canopy.organs.size() * bands, zero),
          zero,
          {zero, {area_of_roles_m2(model)[static_cast<std::size_t>(Role::leaf)], 0.0}, dark, dark, dark, dark},
          std::vector<Estimate>(count_plants(model) * bands, zero),
          false,
          no_joint_errors(bands, model.canopy.organs.size(), count_plants(model))};
}

JointErrors no_joint_errors(std::size_t bands, std::size_t organs, std::size_t plants) {
  return {std::vector<JointErrors::Band>(bands), std::vector<double>(organs * bands), std::vector<double>(plants * bands)};
}

std::vector<DateSums> sum_dates(const RadiationModel& model, const DayCourse& course, std::span<const StepLight> lights) {
  const std::size_t bands = model.bands.size();
  Sums dark;
  dark.bands.resize(bands);
  dark.organs.resize(model.canopy.organs.size() * bands);
  dark.plants.resize(count_plants(model) * bands);
  std::vector<Sums> dates(course.dates.size(), dark);
  for (std::size_t i = 0; i < lights.size(); ++i) {
    const DayStep& step = course.steps[i];
    dates.at(step.date).add(lights[i], step.length_s);
  }
  std::vector<DateSums> sums;
  for (const Sums& date : dates) sums.push_back(date.sums());
  return sums;
}

}  // namespace sunfleck
