#include "io/plane_writer.h"

#include "base/check.h"
#include "io/table_text.h"

#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <limits>

namespace sunfleck {
namespace {

constexpr double cm2_per_m2 = 1e4;

std::string number(double value) {
  return std::isfinite(value) ? fmt::format("{:.9g}", value) : std::string("unknown");
}

// Returns the lines before the column names.
std::string head(const RunRecord& record, const PlaneResult& plane, const FleckSizes& sizes, const char* content,
                 const char* units) {
  std::string text = table_head(record,
                                fmt::format("{} of the horizontal plane at {:.9g} m, {} x {} cells", content, plane.height_m,
                                            plane.cells_x, plane.cells_z),
                                units);
  if (std::isnan(plane.sunfleck_ratio.value)) return text + "# no direct beam\n";
  text += fmt::format("# sunfleck ratio {}, error {}; {:.9g} beam rays a cell without the canopy\n",
                      number(plane.sunfleck_ratio.value), number(plane.sunfleck_ratio.half_width), sizes.rays_per_cell);
  text += fmt::format("# flecks (joined cells with sunfleck >= 0.5): {}, together {:.9g} of the plane", sizes.areas_m2.size(),
                      sizes.area_share);
  if (!sizes.areas_m2.empty()) {
    text += fmt::format("; median {:.9g} cm2, largest {:.9g} cm2", cm2_per_m2 * sizes.areas_m2[(sizes.areas_m2.size() - 1) / 2],
                        cm2_per_m2 * sizes.areas_m2.back());
  }
  return text + '\n';
}

}  // namespace

std::string plane_stem(double height_m) {
  const double millimetres = std::round(1000.0 * height_m);
  return fmt::format("plane_{:.3f}", millimetres == 0.0 ? 0.0 : millimetres / 1000.0);
}

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

std::string plane_csv(const RunRecord& record, const RadiationModel& model, const RadiationResult& result, std::size_t plane) {
  EXPECT(plane, <, result.planes.size());
  const PlaneResult& from = result.planes[plane];
  std::string text = head(record, from, fleck_sizes(from, model.plot), "Facula map",
                          "x_m (south), z_m (west): m, centre of the cell; sunfleck: share of the cell that the direct beam "
                          "reaches; direct, total: W m-2 downwards");
  text += "x_m,z_m,sunfleck";
  for (const Waveband& band : model.bands) text += fmt::format(",{0}_direct,{0}_total", band.name);
  text += '\n';
  std::vector<PlaneIrradiance> irradiance;
  for (std::size_t b = 0; b < model.bands.size(); ++b) irradiance.push_back(plane_irradiance(model, result, plane, b));
  const std::vector<double> sunfleck = plane_sunfleck(from);
  for (std::size_t cell = 0; cell < std::size_t{from.cells_x} * from.cells_z; ++cell) {
    const std::size_t x = cell % from.cells_x;
    const std::size_t z = cell / from.cells_x;
    fmt::format_to(std::back_inserter(text), "{:.9g},{:.9g}",
                   (static_cast<double>(x) + 0.5) / from.cells_x * model.plot.size_x_m,
                   (static_cast<double>(z) + 0.5) / from.cells_z * model.plot.size_z_m);
    append_number(text, sunfleck[cell]);
    for (const PlaneIrradiance& band : irradiance) {
      append_number(text, band.direct_w_m2[cell]);
      append_number(text, band.total_w_m2[cell]);
    }
    text += '\n';
  }
  return text;
}

std::string plane_flecks_csv(const RunRecord& record, const RadiationModel& model, const RadiationResult& result,
                             std::size_t plane) {
  EXPECT(plane, <, result.planes.size());
  const PlaneResult& from = result.planes[plane];
  const FleckSizes sizes = fleck_sizes(from, model.plot);
  std::string text = head(record, from, sizes, "Sunflecks",
                          "lower_cm2 <= area < upper_cm2: cm2; flecks: number; area_share: share of the plane's area");
  text += "lower_cm2,upper_cm2,flecks,area_share\n";
  for (const FleckClass& of : sizes.classes) {
    fmt::format_to(std::back_inserter(text), "{:.9g},{:.9g},{},{:.9g}\n", cm2_per_m2 * of.lower_m2, cm2_per_m2 * of.upper_m2,
                   of.flecks, of.area_share);
  }
  return text;
}

}  // namespace sunfleck
