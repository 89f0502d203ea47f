#include "files/results/tables/plane_writer.h"

#include "base/check.h"
#include "files/results/tables/table_text.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <utility>

namespace sunfleck {
namespace {

constexpr double cm2_per_m2 = 1e4;

std::string number(double value) {
  return std::isfinite(value) ? fmt::format("{:.9g}", value) : std::string("unknown");
}

// Returns a table without columns.
Table empty_table(const PlaneResult& plane, const FleckSizes& sizes, const char* content, const char* units) {
  Table table;
  table.content = fmt::format("{} of the horizontal plane at {:.9g} m, {} x {} cells", content, plane.height_m, plane.cells_x,
                              plane.cells_z);
  table.units = units;
  if (std::isnan(plane.sunfleck_ratio.value)) {
    table.notes = {"no direct beam"};
    return table;
  }
  std::string flecks = fmt::format("flecks (joined cells with sunfleck >= 0.5): {}, together {:.9g} of the plane",
                                   sizes.areas_m2.size(), sizes.area_share);
  if (!sizes.areas_m2.empty()) {
    flecks += fmt::format("; median {:.9g} cm2, largest {:.9g} cm2",
                          cm2_per_m2 * sizes.areas_m2[(sizes.areas_m2.size() - 1) / 2], cm2_per_m2 * sizes.areas_m2.back());
  }
  table.notes = {fmt::format("sunfleck ratio {}, error {}; {:.9g} beam rays a cell without the canopy",
                             number(plane.sunfleck_ratio.value), number(plane.sunfleck_ratio.half_width), sizes.rays_per_cell),
                 flecks};
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
  const std::vector<std::size_t> once, along_z{0}, along_x{1};
  Table table = empty_table(from, fleck_sizes(from, model.plot), "Facula map",
                            "x_m (south), z_m (west): m, centre of the cell; sunfleck: share of the cell that the direct beam "
                            "reaches; direct, total: W m-2 downwards");
  table.shape = {from.cells_z, from.cells_x};
  const auto centre_m = [](std::size_t i, std::uint32_t cells, double size_m) {
    return (static_cast<double>(i) + 0.5) / cells * size_m;
  };
  table.add({"height_m", "m", "height of the plane", in_arrays, once}, [&](std::size_t) { return from.height_m; });
  table.add({"sunfleck_ratio", "1", "share of the plane that the direct beam reaches", in_arrays, once},
            [&](std::size_t) { return from.sunfleck_ratio; });
  table.add({"x_m", "m", "centre of the cell, towards the south", in_csv | in_arrays, along_x},
            [&](std::size_t x) { return centre_m(x, from.cells_x, model.plot.size_x_m); });
  table.add({"z_m", "m", "centre of the cell, towards the west", in_csv | in_arrays, along_z},
            [&](std::size_t z) { return centre_m(z, from.cells_z, model.plot.size_z_m); });
  table.add({"sunfleck", "1", "share of the cell that the direct beam reaches"}, plane_sunfleck(from));
  for (std::size_t b = 0; b < model.bands.size(); ++b) {
    PlaneIrradiance irradiance = plane_irradiance(model, result, plane, b);
    table.add({model.bands[b].name + "_direct", "W m-2", "downward irradiance by the sun's beam"},
              std::move(irradiance.direct_w_m2));
    table.add({model.bands[b].name + "_total", "W m-2", "downward irradiance by all light"}, std::move(irradiance.total_w_m2));
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
  const std::vector<FleckClass>& of = sizes.classes;
  Table table = empty_table(result.planes[plane], sizes, "Sunflecks",
                            "lower_cm2 <= area < upper_cm2: cm2; flecks: number; area_share: share of the plane's area");
  table.shape = {of.size()};
  table.add({"lower_cm2", "cm2", "least area of the class"}, [&](std::size_t i) { return cm2_per_m2 * of[i].lower_m2; });
  table.add({"upper_cm2", "cm2", "least area of the next class"}, [&](std::size_t i) { return cm2_per_m2 * of[i].upper_m2; });
  table.add({"flecks", "1", "number of sunflecks"}, [&](std::size_t i) { return static_cast<std::uint32_t>(of[i].flecks); });
  table.add({"area_share", "1", "share of the plane's area"}, [&](std::size_t i) { return of[i].area_share; });
  return csv_text(record, table);
}

}  // namespace sunfleck
