#include "io/plane_plot.h"

#include "base/check.h"
#include "io/plane_writer.h"
#include "io/plot_script.h"
#include "transport/fleck_sizes.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace sunfleck {
namespace {

constexpr int width_px = 1600;
constexpr double left_px = 150.0;
constexpr double between_px = 50.0;
constexpr double colour_bar_px = 220.0;  // including its gap and labels
constexpr double head_px = 165.0;        // title, sunfleck ratio, names of the maps
constexpr double map_axis_px = 150.0;
constexpr double sizes_px = 230.0;
constexpr double sizes_axis_px = 120.0;
constexpr double highest_map_px = 760.0;
constexpr double narrowest_slot_px = 340.0;  // width for a map with its title
constexpr double lowest_bar_px = 260.0;      // minimum height of the colour bar, beside lower maps
constexpr double widest_map_px = (width_px - left_px - between_px - colour_bar_px) / 2.0;
constexpr std::size_t most_dots = 800;  // most dots per side; a map has no more pixels than this
constexpr double cm2_per_m2 = 1e4;

// The palette Viridis at nine positions (van der Walt and Smith 2015, matplotlib), perceptually uniform in colour and in grey.
constexpr const char* viridis =
    "set palette defined (0 '#440154', 1 '#472d7b', 2 '#3b528b', 3 '#2c728e', 4 '#21918c', 5 '#28ae80', 6 '#5ec962', "
    "7 '#addc30', 8 '#fde725')";

struct Frame {
  double map_width_px, map_height_px, first_px, second_px, bottom_px;
  double bar_bottom_px, bar_height_px;
  int height_px;
};

Frame make_frame(const Plot& plot) {
  const double px_per_m = std::min(widest_map_px / plot.size_z_m, highest_map_px / plot.size_x_m);
  Frame frame{};
  frame.map_width_px = px_per_m * plot.size_z_m;
  frame.map_height_px = px_per_m * plot.size_x_m;
  const double slot_px = std::max(frame.map_width_px, narrowest_slot_px);
  frame.first_px = left_px + widest_map_px - 0.5 * (slot_px + frame.map_width_px);
  frame.second_px = frame.first_px + slot_px + between_px;
  frame.bar_bottom_px = sizes_axis_px + sizes_px + map_axis_px;
  frame.bar_height_px = std::max(frame.map_height_px, lowest_bar_px);
  frame.bottom_px = frame.bar_bottom_px + 0.5 * (frame.bar_height_px - frame.map_height_px);
  frame.height_px = static_cast<int>(std::ceil(frame.bar_bottom_px + frame.bar_height_px + head_px));
  return frame;
}

// How a map is divided into the dots of an image. Neighbouring cells are averaged if there are more than can be seen; a single
// row or column of cells is drawn twice, because an image needs at least two.
struct Dots {
  std::size_t cells = 1;   // cells per side of a dot
  std::size_t copies = 1;  // of each dot
  double size_m = 0.0;
};

Dots make_dots(std::size_t cells, std::size_t together, double length_m) {
  const std::size_t copies = cells <= together ? 2 : 1;
  const auto dot_cells = static_cast<double>(std::min(cells, together));
  return {together, copies, length_m * dot_cells / static_cast<double>(cells * copies)};
}

// Writes one line per dot along X, with one number per dot along Z.
void add_map(PlotScript& script, const char* name, const PlaneResult& plane, const std::vector<double>& w_m2,
             const Dots& along_x, const Dots& along_z) {
  script.begin_data(name);
  for (std::size_t x0 = 0; x0 < plane.cells_x; x0 += along_x.cells) {
    std::vector<double> line;
    for (std::size_t z0 = 0; z0 < plane.cells_z; z0 += along_z.cells) {
      const std::size_t x1 = std::min<std::size_t>(x0 + along_x.cells, plane.cells_x);
      const std::size_t z1 = std::min<std::size_t>(z0 + along_z.cells, plane.cells_z);
      double sum = 0.0;
      for (std::size_t z = z0; z < z1; ++z) {
        for (std::size_t x = x0; x < x1; ++x) sum += w_m2[z * plane.cells_x + x];
      }
      line.insert(line.end(), along_z.copies, sum / static_cast<double>((x1 - x0) * (z1 - z0)));
    }
    for (std::size_t copy = 0; copy < along_x.copies; ++copy) script.row(line);
  }
  script.end_data();
}

// Returns the end of the colour scale: at least the full beam, and beyond all but the few brightest cells, whose excess is
// noise.
double brightest(const std::vector<double>& total_w_m2, double beam_w_m2) {
  constexpr double share_within = 0.995;
  std::vector<double> sorted = total_w_m2;
  const auto place = sorted.begin() + static_cast<std::ptrdiff_t>(share_within * static_cast<double>(sorted.size() - 1));
  std::nth_element(sorted.begin(), place, sorted.end());
  const double most = std::max(*place, beam_w_m2);
  return most > 0.0 ? most : 1.0;
}

void draw_map(PlotScript& script, const Dots& along_x, const Dots& along_z, const std::string& name, const char* data) {
  script.add("set title {} noenhanced offset 0,-0.3", plot_quoted(name));
  script.x_title("Z (m), from east to west");
  script.add("plot ${} matrix using (($1+0.5)*{:.9g}):(($2+0.5)*{:.9g}):3 with image notitle", data, along_z.size_m,
             along_x.size_m);
}

// Returns the map to draw: for the beam, the sunlit share of each cell times the irradiance of the beam. The landings in the
// table fluctuate with the number of rays that happened to cross each cell, which would show as grain in full sun.
PlaneIrradiance without_grain(PlaneIrradiance irradiance, const PlaneResult& plane, double beam_w_m2) {
  for (std::size_t cell = 0; cell < plane.crossing.size(); ++cell) {
    if (plane.crossing[cell] == 0) continue;
    const double share = static_cast<double>(plane.reached[cell]) / static_cast<double>(plane.crossing[cell]);
    irradiance.total_w_m2[cell] += share * beam_w_m2 - irradiance.direct_w_m2[cell];
    irradiance.direct_w_m2[cell] = share * beam_w_m2;
  }
  return irradiance;
}

std::string sunfleck_line(const PlaneResult& plane, const FleckSizes& sizes) {
  if (std::isnan(plane.sunfleck_ratio.value)) return "No direct beam";
  std::string line = fmt::format("Sunfleck ratio {:.4f}", plane.sunfleck_ratio.value);
  if (std::isfinite(plane.sunfleck_ratio.half_width)) line += fmt::format(" \u00b1 {:.2g}", plane.sunfleck_ratio.half_width);
  return line + fmt::format("   \u00b7   {} {}, {:.1f} beam rays a cell", sizes.areas_m2.size(),
                            sizes.areas_m2.size() == 1 ? "fleck" : "flecks", sizes.rays_per_cell);
}

void add_sizes(PlotScript& script, const FleckSizes& sizes) {
  constexpr double rounding = 1e-9;
  script.begin_data("sizes");
  double most = 0.0;
  for (const FleckClass& of : sizes.classes) {
    const double middle = std::sqrt(of.lower_m2 * of.upper_m2);
    script.row({cm2_per_m2 * middle, 100.0 * of.area_share, cm2_per_m2 * of.lower_m2, cm2_per_m2 * of.upper_m2,
                static_cast<double>(of.flecks)});
    most = std::max(most, 100.0 * of.area_share);
  }
  script.end_data();
  const double high = most > 0.0 ? 1.25 * most : 1.0;
  script.place({left_px, sizes_axis_px, width_px - left_px - 60.0, sizes_px});
  script.x_title("Area of a fleck (cm\u00b2); above the columns: number of flecks");
  script.y_title("Share of plane (%)");
  script.add("unset title; unset colorbox; set xrange [*:*]; set yrange [0:{:.9g}]", high);
  script.add("set ytics {:.9g}", tic_step(high, sizes_px, 50.0));
  script.add("set grid ytics; set grid noxtics; set logscale x; set format x '%g'; set xtics autofreq");
  if (sizes.classes.empty()) {
    script.notice("no flecks");
    script.add("set xrange [1:1000]");
    script.add("plot NaN notitle");
    return;
  }
  const double first_decade = std::floor(std::log10(cm2_per_m2 * sizes.classes.front().lower_m2) + rounding);
  const double last_decade = std::ceil(std::log10(cm2_per_m2 * sizes.classes.back().upper_m2) - rounding);
  script.add("set xrange [{:.9g}:{:.9g}]", std::pow(10.0, first_decade), std::pow(10.0, last_decade));
  script.add(
      "plot $sizes using 1:2:3:4:(0):2 with boxxyerror fillcolor '{}' fillstyle solid 0.8 border linecolor '#ffffff' notitle, "
      "'' using 1:2:(sprintf('%d', $5)) with labels offset 0,0.7 font ',17' notitle",
      plot_colours[0]);
}

}  // namespace

std::string plane_plot(const std::string& title, const RadiationModel& model, const RadiationResult& result, std::size_t plane,
                       std::size_t band) {
  const double beam_w_m2 = model.bands[band].direct_w_m2;
  const PlaneIrradiance irradiance =
      without_grain(plane_irradiance(model, result, plane, band), result.planes[plane], beam_w_m2);
  const PlaneResult& from = result.planes[plane];
  const FleckSizes sizes = fleck_sizes(from, model.plot);
  const Frame frame = make_frame(model.plot);
  const std::string& name = model.bands[band].name;

  PlotScript script(width_px, frame.height_px);
  const std::size_t together = (std::max<std::size_t>(from.cells_x, from.cells_z) + most_dots - 1) / most_dots;
  const Dots along_x = make_dots(from.cells_x, together, model.plot.size_x_m);
  const Dots along_z = make_dots(from.cells_z, together, model.plot.size_z_m);
  add_map(script, "direct", from, irradiance.direct_w_m2, along_x, along_z);
  add_map(script, "total", from, irradiance.total_w_m2, along_x, along_z);
  script.add("set multiplot");
  script.add("{}", viridis);
  script.add("set cbrange [0:{:.9g}]", brightest(irradiance.total_w_m2, beam_w_m2));
  script.add("unset grid; unset colorbox; unset key; set tics out nomirror");
  script.add("set xrange [{:.9g}:0]; set yrange [{:.9g}:0]", model.plot.size_z_m, model.plot.size_x_m);
  script.add("set xtics {:.9g}; set ytics {:.9g}", tic_step(model.plot.size_z_m, frame.map_width_px, 90.0),
             tic_step(model.plot.size_x_m, frame.map_height_px, 70.0));
  script.place({frame.first_px, frame.bottom_px, frame.map_width_px, frame.map_height_px});
  script.y_title("X (m), from north to south");
  script.headline(fmt::format("{} \u2013 plane at {:.3f} m", title, from.height_m), 40.0, 24, 88);
  script.headline(sunfleck_line(from, sizes), 82.0, 18, 120);
  draw_map(script, along_x, along_z, "Direct " + name, "direct");

  script.add("set format y ''");
  script.add("set colorbox vertical user origin screen {:.6f},{:.6f} size screen {:.6f},{:.6f} bdefault",
             (frame.second_px + frame.map_width_px + 30.0) / width_px, frame.bar_bottom_px / frame.height_px, 30.0 / width_px,
             frame.bar_height_px / frame.height_px);
  script.place({frame.second_px, frame.bottom_px, frame.map_width_px, frame.map_height_px});
  script.upright(fmt::format("{} downwards (W m\u207b\u00b2)", name), frame.second_px + frame.map_width_px + 185.0,
                 frame.bottom_px + 0.5 * frame.map_height_px);
  draw_map(script, along_x, along_z, "Total " + name, "total");
  script.add("set format y '%g'");
  add_sizes(script, sizes);
  script.add("unset multiplot");
  return script.text();
}

}  // namespace sunfleck
