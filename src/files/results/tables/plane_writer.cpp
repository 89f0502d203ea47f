#include "files/results/tables/plane_writer.h"

#include "base/check.h"
#include "files/results/tables/plane_map.h"
#include "files/results/tables/table_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace sunfleck {
namespace {

constexpr double cm2_per_m2 = 1e4;

std::string number(double value) {
  return std::isfinite(value) ? fmt::format("{:.9g}", value) : std::string("unknown");
}

// Says why there are no sizes, and how many cells would have enough rays.
std::string too_few_rays(const UserMap& map, const FleckSizes& sizes) {
  const double shrink = std::sqrt(sizes.rays_per_cell / least_fleck_rays);
  const auto cells = [&](const MapAxis& axis) { return std::max(1.0, std::floor(shrink * axis.cells)); };
  return fmt::format(
      "no sizes of flecks: too few rays: {:.3g} a cell, {:g} are needed; use a coarser cells = [{}, {}] or a smaller "
      "error",
      sizes.rays_per_cell, least_fleck_rays, cells(map.first), cells(map.second));
}

// Returns a table without columns.
Table empty_table(const PlaneResult& plane, const UserMap& map, const FleckSizes& sizes, const char* content,
                  const std::string& units) {
  Table table;
  table.content = fmt::format("{} of the horizontal plane at {:.9g} m, {} x {} cells", content, plane.height_m, map.first.cells,
                              map.second.cells);
  table.units = units;
  if (std::isnan(plane.sunfleck_ratio.value)) {
    table.notes = {"no direct beam"};
    return table;
  }
  const std::string ratio =
      fmt::format("sunfleck ratio {}, error {}; {:.9g} beam rays a cell without the canopy", number(plane.sunfleck_ratio.value),
                  number(plane.sunfleck_ratio.half_width), sizes.rays_per_cell);
  if (!sizes.enough_rays()) {
    table.notes = {ratio, too_few_rays(map, sizes)};
    return table;
  }
  std::string flecks = fmt::format("flecks (joined cells with sunfleck >= 0.5): {}, together {:.9g} of the plane",
                                   sizes.areas_m2.size(), sizes.area_share);
  if (!sizes.areas_m2.empty()) {
    flecks += fmt::format("; median {:.9g} cm2, largest {:.9g} cm2",
                          cm2_per_m2 * sizes.areas_m2[(sizes.areas_m2.size() - 1) / 2], cm2_per_m2 * sizes.areas_m2.back());
  }
  table.notes = {ratio, flecks};
  return table;
}

}  // namespace

PlaneIrradiance plane_irradiance(const RadiationModel& model, const RadiationResult& result, std::size_t plane,
                                 std::size_t band) {
  EXPECT(plane, <, result.planes.size());
  EXPECT(band, <, model.bands.size());
  const PlaneResult& from = result.planes[plane];
  const std::size_t cells = std::size_t{from.cells_x} * from.cells_z;
  const std::size_t bands = model.bands.size();
  const double cell_m2 = model.plot.area_m2() / static_cast<double>(cells);
  PlaneIrradiance irradiance;
  irradiance.direct_w_m2.reserve(cells);
  irradiance.total_w_m2.reserve(cells);
  for (std::size_t cell = 0; cell < cells; ++cell) {
    const double direct_w_m2 =
        from.reached.empty() ? 0.0 : result.irradiance_w_m2(from.reached[cell], cell_m2, model.bands[band].direct_w_m2);
    const double other_w =
        from.down.empty() ? 0.0 : static_cast<double>(from.down[cell * bands + band]) * result.w_per_quantum[band];
    irradiance.direct_w_m2.push_back(direct_w_m2);
    irradiance.total_w_m2.push_back(direct_w_m2 + other_w / cell_m2);
  }
  return irradiance;
}

std::vector<double> plane_sunfleck(const PlaneResult& plane) {
  std::vector<double> shares(std::size_t{plane.cells_x} * plane.cells_z, std::numeric_limits<double>::quiet_NaN());
  for (std::size_t cell = 0; cell < plane.crossing.size(); ++cell) {
    if (plane.crossing[cell] > 0)
      shares[cell] = static_cast<double>(plane.reached[cell]) / static_cast<double>(plane.crossing[cell]);
  }
  return shares;
}

Table plane_table(const RadiationModel& model, const RadiationResult& result, std::size_t plane) {
  EXPECT(plane, <, result.planes.size());
  const PlaneResult& from = result.planes[plane];
  const UserMap map(from.cells_x, from.cells_z, model.plot);
  const std::vector<std::size_t> once;
  Table table = empty_table(from, map, fleck_sizes(from, model.plot), "Facula map",
                            map.centres_text() +
                                "; sunfleck: share of the cell that the direct beam reaches; direct, total: "
                                "W m-2 downwards");
  table.shape = {map.second.cells, map.first.cells};
  table.add({"height_m", "m", "height of the plane", in_arrays, once}, [&](std::size_t) { return from.height_m; });
  table.add({"sunfleck_ratio", "1", "share of the plane that the direct beam reaches", in_arrays, once},
            [&](std::size_t) { return from.sunfleck_ratio; });
  map.add_centres(table);
  table.add({"sunfleck", "1", "share of the cell that the direct beam reaches"}, map.in_rows(plane_sunfleck(from)));
  for (std::size_t b = 0; b < model.bands.size(); ++b) {
    PlaneIrradiance irradiance = plane_irradiance(model, result, plane, b);
    table.add({model.bands[b].name + "_direct", "W m-2", "downward irradiance by the sun's beam"},
              map.in_rows(std::move(irradiance.direct_w_m2)));
    table.add({model.bands[b].name + "_total", "W m-2", "downward irradiance by all light"},
              map.in_rows(std::move(irradiance.total_w_m2)));
  }
  return table;
}

std::string plane_csv(const RunRecord& record, const RadiationModel& model, const RadiationResult& result, std::size_t plane) {
  return csv_text(record, plane_table(model, result, plane));
}

std::string plane_flecks_csv(const RunRecord& record, const RadiationModel& model, const RadiationResult& result,
                             std::size_t plane) {
  EXPECT(plane, <, result.planes.size());
  const FleckSizes sizes = fleck_sizes(result.planes[plane], model.plot);
  const std::vector<FleckClass> of = sizes.enough_rays() ? sizes.classes : std::vector<FleckClass>();
  const PlaneResult& from = result.planes[plane];
  Table table = empty_table(from, UserMap(from.cells_x, from.cells_z, model.plot), sizes, "Sunflecks",
                            "lower_cm2 <= area < upper_cm2: cm2; flecks: number; area_share: share of the plane's area");
  table.shape = {of.size()};
  table.add({"lower_cm2", "cm2", "least area of the class"}, [&](std::size_t i) { return cm2_per_m2 * of[i].lower_m2; });
  table.add({"upper_cm2", "cm2", "least area of the next class"}, [&](std::size_t i) { return cm2_per_m2 * of[i].upper_m2; });
  table.add({"flecks", "1", "number of sunflecks"}, [&](std::size_t i) { return static_cast<std::uint32_t>(of[i].flecks); });
  table.add({"area_share", "1", "share of the plane's area"}, [&](std::size_t i) { return of[i].area_share; });
  return csv_text(record, table);
}

}  // namespace sunfleck
