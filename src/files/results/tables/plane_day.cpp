#include "files/results/tables/plane_day.h"

#include "base/check.h"
#include "base/units.h"
#include "files/results/tables/plane_map.h"
#include "files/results/tables/plane_writer.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>

namespace sunfleck {
namespace {

constexpr double seconds_per_hour = 3600.0;

// Returns the mean of the numbers; nothing if there are none.
std::optional<double> mean_of_known(std::span<const float> values) {
  double sum = 0.0;
  std::size_t known = 0;
  for (const float value : values) {
    if (std::isnan(value)) continue;
    sum += double{value};
    ++known;
  }
  if (known == 0) return std::nullopt;
  return sum / static_cast<double>(known);
}

}  // namespace

std::vector<float> plane_maps(const RadiationModel& model, const RadiationResult& result) {
  EXPECT(result.planes.size(), ==, model.planes.size());
  std::vector<float> maps;
  maps.reserve(plane_map_values(model));
  for (std::size_t p = 0; p < model.planes.size(); ++p) {
    const UserMap map(model.planes[p], model.plot);
    const auto add = [&](std::vector<double> values) {
      for (const double value : map.in_rows(std::move(values))) maps.push_back(static_cast<float>(value));
    };
    add(plane_sunfleck(result.planes[p]));
    for (std::size_t b = 0; b < model.bands.size(); ++b) {
      PlaneIrradiance irradiance = plane_irradiance(model, result, p, b);
      add(std::move(irradiance.direct_w_m2));
      add(std::move(irradiance.total_w_m2));
    }
  }
  return maps;
}

std::size_t plane_map_values(const RadiationModel& model, std::size_t plane) {
  return model.planes[plane].cells() * (1 + 2 * model.bands.size());
}

std::size_t plane_map_values(const RadiationModel& model) {
  std::size_t values = 0;
  for (std::size_t p = 0; p < model.planes.size(); ++p) values += plane_map_values(model, p);
  return values;
}

PlaneMapSums::PlaneMapSums(const RadiationModel& model) : plot_(model.plot), bands_(model.bands), planes_(model.planes) {
  for (const PlaneReceiver& plane : model.planes) {
    const std::size_t cells = plane.cells();
    const std::vector<double> dark(model.bands.size() * cells);
    sums_.push_back({std::vector<double>(cells), 0.0, dark, dark});
  }
}

void PlaneMapSums::add(const DayStep& step, std::span<const float> maps) {
  ++steps_;
  bool beam = false;
  for (Sums& sums : sums_) {
    const std::size_t cells = sums.sunlit_s.size();
    EXPECT(maps.size(), >=, cells * (1 + 2 * bands_.size()));
    const auto next = [&] {
      const std::span<const float> values = maps.first(cells);
      maps = maps.subspan(cells);
      return values;
    };
    const std::span<const float> shares = next();
    if (const std::optional<double> mean = mean_of_known(shares)) {
      beam = true;
      sums.known_s += step.length_s;
      for (std::size_t c = 0; c < cells; ++c)
        sums.sunlit_s[c] += step.length_s * (std::isnan(shares[c]) ? *mean : double{shares[c]});
    }
    for (std::size_t b = 0; b < bands_.size(); ++b) {
      for (std::vector<double>* of : {&sums.direct, &sums.total}) {
        const std::span<const float> irradiance = next();
        for (std::size_t c = 0; c < cells; ++c) (*of)[b * cells + c] += step.length_s * double{irradiance[c]};
      }
    }
  }
  if (beam) beam_s_ += step.length_s;
}

Table PlaneMapSums::table(const DayCourse& course, std::size_t plane) const {
  const Sums& sums = sums_.at(plane);
  const UserMap map(planes_[plane], plot_);
  const std::size_t cells = sums.sunlit_s.size();
  const std::size_t dates = steps_ > 0 ? course.steps[steps_ - 1].date + 1 : 0;
  Table table{fmt::format("Sums of the light through the horizontal plane at {:.9g} m, {} x {} cells", planes_[plane].height_m,
                          map.first.cells, map.second.cells),
              map.centres_text() +
                  "; sunlit_h: hours in direct sun; sunlit_share: the same as a share of the hours with a direct "
                  "beam; direct, total: MJ m-2 and mol of photons m-2 downwards",
              {map.second.cells, map.first.cells},
              {fmt::format("dates {}, steps {}, hours with a direct beam {:.9g}", dates, steps_, beam_s_ / seconds_per_hour)}};
  map.add_centres(table);
  const auto share = [&](std::size_t c) { return sums.known_s > 0.0 ? sums.sunlit_s[c] / sums.known_s : no_value; };
  table.add({"sunlit_h", "h", "time in direct sun"},
            [&](std::size_t c) { return beam_s_ > 0.0 ? share(c) * beam_s_ / seconds_per_hour : 0.0; });
  table.add({"sunlit_share", "1", "time in direct sun, as a share of the time with a direct beam"}, share);
  for (std::size_t b = 0; b < bands_.size(); ++b) {
    const Waveband& band = bands_[b];
    const auto add = [&](const char* name, const char* unit, const char* meaning, const std::vector<double>& of,
                         double factor) {
      table.add({band.name + name, unit, meaning}, [&, b](std::size_t c) { return of[b * cells + c] * factor; });
    };
    add("_direct_mj_m2", "MJ m-2", "energy of the sun's beam, downwards", sums.direct, per_mega);
    add("_total_mj_m2", "MJ m-2", "energy of all light, downwards", sums.total, per_mega);
    if (band.umol_per_joule > 0.0)
      add("_total_mol_m2", "mol m-2", "photons of all light, downwards", sums.total, per_mega * band.umol_per_joule);
  }
  return table;
}

std::string plane_day_stem(const PlaneReceiver& plane) {
  return plane_stem(plane.height_m) + "_day";
}

}  // namespace sunfleck
