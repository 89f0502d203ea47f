#include "files/results/tables/day_course.h"

#include "base/check.h"
#include "base/units.h"
#include "files/results/tables/flux_terms.h"
#include "physics/transport/model/plant_areas.h"
#include "physics/transport/model/surfaces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <optional>

namespace sunfleck {
namespace {

constexpr Estimate zero{0.0, 0.0}, no_figure{no_value, no_value};

constexpr Estimate SensorReading::*parts[] = {&SensorReading::direct, &SensorReading::sky, &SensorReading::scattered,
                                              &SensorReading::total};

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

// Sums of the fluxes of a band over steps or dates.
struct BandSum {
  std::array<Sum, flux_terms.size()> of_terms;
  double unshot = 0.0;

  // `shared_half_width(term)` returns the error of a flux that was simulated together with others; nothing for one by itself. What
  // arrived cannot be unshot.
  template <class SharedHalfWidth>
  void add(const BandFluxes& band, double length_s, const SharedHalfWidth& shared_half_width) {
    unshot += band.unshot * length_s;
    for (std::size_t t = 0; t < flux_terms.size(); ++t) {
      const Estimate& flux = band.*flux_terms[t].flux;
      of_terms[t].add(flux, t == 0 ? 0.0 : std::min(flux.half_width, band.unshot), length_s, shared_half_width(t));
    }
  }
  [[nodiscard]] BandFluxes estimate() const {
    BandFluxes sums;
    for (std::size_t t = 0; t < flux_terms.size(); ++t) sums.*flux_terms[t].flux = of_terms[t].estimate();
    sums.unshot = unshot;
    return sums;
  }
};

struct Sums {
  std::size_t steps = 0;
  std::vector<BandSum> bands;                              // [band]
  std::vector<Sum> organs;                                 // [organ * bands + band]
  std::vector<Sum> plants;                                 // [plant * bands + band]
  std::vector<Sum> kinds;                                  // [kind * bands + band]
  std::vector<std::array<Sum, std::size(parts)>> sensors;  // [sensor * bands + band]
  std::vector<Sum> planes;                                 // [plane * bands + band]

  void add(const StepLight& light, double length_s) {
    if (steps == 0) begin_like(light);
    EXPECT(light.bands.size(), ==, bands.size());
    EXPECT(light.organ_absorbed.size(), ==, organs.size());
    EXPECT(light.plant_absorbed_w.size(), ==, plants.size());
    EXPECT(light.kind_absorbed.size(), ==, kinds.size());
    EXPECT(light.sensors.size(), ==, sensors.size());
    EXPECT(light.plane_down.size(), ==, planes.size());
    ++steps;
    for (std::size_t i = 0; i < sensors.size(); ++i) {
      for (std::size_t p = 0; p < std::size(parts); ++p)
        sensors[i][p].add(light.sensors[i].*parts[p], 0.0, length_s, std::nullopt);
    }
    const auto shared = [&](const std::vector<double>& errors, std::size_t i) {
      return light.shares_packets ? std::optional(errors[i]) : std::nullopt;
    };
    for (std::size_t i = 0; i < kinds.size(); ++i) {
      const KindFlux& kind = light.kind_absorbed[i];
      kinds[i].add(kind.absorbed, kind.unshot, length_s, shared(light.of_shared.groups, i));
    }
    for (std::size_t i = 0; i < planes.size(); ++i) {
      planes[i].add(light.plane_down[i], 0.0, length_s, shared(light.of_shared.planes, i));
    }
    for (std::size_t b = 0; b < bands.size(); ++b) {
      const BandFluxes& band = light.bands[b];
      bands[b].add(band, length_s, [&](std::size_t term) { return shared_term(light, b, term); });
      const double absorbed = band.absorbed_vegetation.value + band.absorbed_structure.value + band.absorbed_soil.value;
      const double unshot_share = absorbed > 0.0 ? band.unshot / absorbed : 0.0;
      const auto add_to = [&](std::vector<Sum>& sums, const std::vector<Estimate>& fluxes,
                              const std::vector<double>& of_shared) {
        for (std::size_t i = b; i < sums.size(); i += bands.size())
          sums[i].add(fluxes[i], std::min(fluxes[i].half_width, fluxes[i].value * unshot_share), length_s,
                      shared(of_shared, i));
      };
      add_to(organs, light.organ_absorbed, light.of_shared.organs);
      add_to(plants, light.plant_absorbed_w, light.of_shared.plants);
    }
  }

  // Returns the error of a term of flux_terms for steps that share packets; nothing for others. In an endless canopy the incident
  // flux is exact.
  static std::optional<double> shared_term(const StepLight& light, std::size_t band, std::size_t term) {
    if (!light.shares_packets) return std::nullopt;
    const JointErrors::Band& errors = light.of_shared.bands[band];
    const double of_terms[] = {errors.incident, errors.vegetation, errors.structure,
                               errors.soil,     errors.reflected,  errors.transmitted};
    return term > 0 || light.bands[band].incident.half_width > 0.0 ? of_terms[term] : 0.0;
  }

  void begin_like(const StepLight& light) {
    bands.resize(light.bands.size());
    organs.resize(light.organ_absorbed.size());
    plants.resize(light.plant_absorbed_w.size());
    kinds.resize(light.kind_absorbed.size());
    sensors.resize(light.sensors.size());
    planes.resize(light.plane_down.size());
  }

  [[nodiscard]] DateSums sums() const {
    DateSums date;
    date.steps = steps;
    for (const BandSum& band : bands) date.bands.push_back(band.estimate());
    for (const Sum& organ : organs) date.organ_absorbed.push_back(organ.estimate());
    for (const Sum& plant : plants) date.plant_absorbed.push_back(plant.estimate());
    for (const Sum& kind : kinds) date.kind_absorbed.push_back(kind.estimate());
    for (const auto& sensor : sensors) {
      SensorReading& sums = date.sensors.emplace_back();
      for (std::size_t p = 0; p < std::size(parts); ++p) sums.*parts[p] = sensor[p].estimate();
    }
    for (const Sum& plane : planes) date.plane_down.push_back(plane.estimate());
    return date;
  }
};

// Adds the readings of a sensor, or of one of its points, in all bands.
void add_readings(std::vector<SensorReading>& readings, const SensorResult& of) {
  for (std::size_t b = 0; b < of.total.size(); ++b) readings.emplace_back(of, b);
}

}  // namespace

StepRange steps_of(const DayCourse& course, std::size_t date) {
  const auto before = [](const DayStep& step, std::size_t its) { return step.date < its; };
  const auto first = std::lower_bound(course.steps.begin(), course.steps.end(), date, before);
  const auto end = std::lower_bound(first, course.steps.end(), date + 1, before);
  return {static_cast<std::size_t>(first - course.steps.begin()), static_cast<std::size_t>(end - course.steps.begin())};
}

DayCourse course_of(const DayCourse& course, std::size_t date) {
  const StepRange range = steps_of(course, date);
  DayCourse single{course.offset_minutes, {}, {course.dates[date]}};
  for (std::size_t i = range.first; i < range.end; ++i) {
    single.steps.push_back(course.steps[i]);
    single.steps.back().date = 0;
  }
  return single;
}

std::size_t sensor_points(const RadiationModel& model) {
  std::size_t points = 0;
  for (const Sensor& sensor : model.sensors) points += sensor.points_m.size();
  return points;
}

StepLight step_light(const RadiationModel& model, const RadiationResult& result) {
  StepLight light;
  light.bands.assign(result.bands.begin(), result.bands.end());
  for (const OrganResult& organ : result.organs) {
    light.organ_absorbed.insert(light.organ_absorbed.end(), organ.absorbed.begin(), organ.absorbed.end());
  }
  for (const PlantResult& plant : result.plants) {
    light.plant_absorbed_w.insert(light.plant_absorbed_w.end(), plant.absorbed_w.begin(), plant.absorbed_w.end());
  }
  light.sunlit_leaf_fraction = result.sunlit_leaf_fraction;
  light.leaf_classes = result.leaf_classes;
  light.kind_absorbed = absorbed_by_kinds(model, result);
  for (const std::vector<SensorResult>& sensor : result.sensors) {
    for (const SensorResult& point : sensor) add_readings(light.points, point);
  }
  for (const SensorResult& mean : result.sensor_means) add_readings(light.sensors, mean);
  for (const PlaneResult& plane : result.planes) {
    light.plane_sunfleck.push_back(plane.sunfleck_ratio);
    light.plane_down.insert(light.plane_down.end(), plane.total_down.begin(), plane.total_down.end());
  }
  light.of_shared = no_joint_errors(light);
  return light;
}

StepLight no_light(const RadiationModel& model) {
  const std::size_t bands = model.bands.size();
  const std::vector<Estimate> dark(bands, zero), no_class(bands, no_figure);
  const double leaves_m2 = area_of_roles_m2(model)[static_cast<std::size_t>(Role::leaf)];
  const std::vector<Estimate>& shaded = leaves_m2 > 0.0 ? dark : no_class;
  SensorReading no_reading;
  for (const auto part : parts) no_reading.*part = zero;
  StepLight light{std::vector<BandFluxes>(bands, {zero, zero, zero, zero, zero, zero, 0.0}),
                  std::vector<Estimate>(model.canopy.organs.size() * bands, zero),
                  no_figure,
                  {zero, {leaves_m2, 0.0}, no_class, shaded, no_class, shaded},
                  std::vector<Estimate>(count_plants(model) * bands, zero),
                  std::vector<KindFlux>(OrganKinds(model).of.size() * bands, {zero, 0.0}),
                  std::vector<SensorReading>(sensor_points(model) * bands, no_reading),
                  std::vector<SensorReading>(model.sensors.size() * bands, no_reading),
                  std::vector<Estimate>(model.planes.size(), no_figure),
                  std::vector<Estimate>(model.planes.size() * bands, zero)};
  light.of_shared = no_joint_errors(light);
  return light;
}

JointErrors no_joint_errors(const StepLight& light) {
  const auto none = [](const auto& figures) { return std::vector<double>(figures.size()); };
  return {std::vector<JointErrors::Band>(light.bands.size()), none(light.organ_absorbed), none(light.plant_absorbed_w),
          none(light.kind_absorbed), none(light.plane_down)};
}

std::vector<DateSums> sum_dates(const DayCourse& course, std::span<const StepLight> lights) {
  std::vector<Sums> dates(course.dates.size());
  for (std::size_t i = 0; i < lights.size(); ++i) {
    const DayStep& step = course.steps[i];
    dates.at(step.date).add(lights[i], step.length_s);
  }
  std::vector<DateSums> sums;
  for (const Sums& date : dates) sums.push_back(date.sums());
  return sums;
}

BandFluxes sum_over_dates(std::span<const DateSums> dates, std::size_t band) {
  BandSum sum;
  for (const DateSums& date : dates) {
    if (date.steps > 0) sum.add(date.bands[band], 1.0, [](std::size_t) { return std::nullopt; });
  }
  return sum.estimate();
}

}  // namespace sunfleck
