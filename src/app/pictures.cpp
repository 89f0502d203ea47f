#include "app/pictures.h"

#include "base/error.h"
#include "io/file.h"
#include "transport/solve.h"

#include <fmt/format.h>

#include <algorithm>
#include <glm/common.hpp>
#include <numbers>

namespace sunfleck {
namespace {

Camera camera_of(const Scene& scene, double height_m, double aspect) {
  if (scene.camera) return look_at(scene.camera->position_m, scene.camera->look_at_m, scene.camera->fov_rad, aspect);
  const RadiationModel& model = scene.model;
  const Box elements = bounds(model.canopy);
  glm::dvec3 lo(0.0);
  glm::dvec3 hi(model.plot.size_x_m, height_m, model.plot.size_z_m);
  if (model.canopy.size() > 0) {
    lo = glm::min(lo, glm::dvec3(elements.lo) + model.canopy.origin_m);
    hi = glm::max(hi, glm::dvec3(elements.hi) + model.canopy.origin_m);
  }
  return three_quarter_view(lo, hi, aspect);
}

shared::ViewBlock view_block(const RadiationModel& model, const CounterLayout& layout, const Camera& camera,
                             const SurfaceImage& image) {
  shared::ViewBlock view;
  view.position = camera.position_m - model.canopy.origin_m;
  view.forward = camera.forward;
  view.right = camera.right * (camera.tan_half_fov * camera.aspect);
  view.up = camera.up * camera.tan_half_fov;
  view.width = static_cast<std::uint32_t>(image.width);
  view.height = static_cast<std::uint32_t>(image.height);
  view.samples = static_cast<std::uint32_t>(image.samples);
  view.elements = static_cast<std::uint32_t>(model.canopy.size());
  view.ground = make_ground_map(layout);
  return view;
}

std::string subtitle_line(const RadiationModel& model, const RadiationResult& result) {
  constexpr double degree = std::numbers::pi / 180.0;
  std::string line;
  if (model.has_beam()) {
    line = fmt::format("Sun at elevation {:.2f}°, azimuth {:.2f}°; ", model.sun->elevation_rad / degree,
                       model.sun->azimuth_rad / degree);
  }
  return line + fmt::format("{} triangles, leaf area index {:.2f}", model.canopy.size(), result.leaf_area_index);
}

std::string footer_line(LightField field, const RadiationResult& result) {
  std::string line = fmt::format("{:.2f} million rays", static_cast<double>(result.direct.rays) * 1e-6);
  if (result.direct.relative_error) line += fmt::format(", relative error {:.2g}", *result.direct.relative_error);
  if (field == LightField::direct || result.indirect.packets == 0) return line;
  line += fmt::format("; {:.2f} million packets", static_cast<double>(result.indirect.packets) * 1e-6);
  if (result.indirect.relative_error) line += fmt::format(", relative error {:.2g}", *result.indirect.relative_error);
  return line;
}

const char* field_name(LightField field) {
  switch (field) {
    case LightField::direct:
      return "Direct";
    case LightField::indirect:
      return "Indirect";
    case LightField::total:
      return "Total";
  }
  return "";
}

}  // namespace

std::size_t picture_band(const RadiationModel& model, const std::string& name) {
  if (name.empty()) return 0;
  std::string known;
  for (std::size_t b = 0; b < model.bands.size(); ++b) {
    if (model.bands[b].name == name) return b;
    known += (known.empty() ? "" : ", ") + model.bands[b].name;
  }
  throw_input(fmt::format("--band {}", printable(name)), "no band of the scene", "give one of " + known);
}

RankCharts::RankCharts(const Scene& scene, const CounterLayout& layout, const RadiationResult& result,
                       const RunOptions& options)
    : scene_(scene),
      layout_(layout),
      result_(result),
      band_(picture_band(scene.model, options.band)),
      camera_(
          camera_of(scene, layout.layers.height_m, static_cast<double>(options.width) / static_cast<double>(options.height))),
      seen_{options.width, options.height, options.samples, {}, {}} {}

bool RankCharts::look(const Engine& engine, const StopQuestion& stop) {
  static_assert(SurfaceImage::nothing == shared::seen_nothing);
  const std::vector<shared::SeenSurface> samples =
      engine.see(view_block(scene_.model, layout_, camera_, seen_), sample_offsets(seen_.samples), stop);
  seen_.surface.reserve(samples.size());
  seen_.depth_m.reserve(samples.size());
  for (const shared::SeenSurface& sample : samples) {
    seen_.surface.push_back(sample.surface);
    seen_.depth_m.push_back(sample.depth);
  }
  return !samples.empty();
}

RankCharts::SurfaceValues RankCharts::surface_values(LightField field) const {
  const RadiationModel& model = scene_.model;
  const double beam_w_m2 = model.bands[band_].direct_w_m2;
  SurfaceValues values;
  const auto add = [&](std::uint64_t landings, double indirect_w_m2, double area) {
    double irradiance_w_m2 = 0.0;
    if (field != LightField::indirect) irradiance_w_m2 += result_.irradiance_w_m2(landings, area, beam_w_m2);
    if (field != LightField::direct) irradiance_w_m2 += indirect_w_m2;
    values.irradiance_w_m2.push_back(irradiance_w_m2);
    values.area_m2.push_back(area);
  };
  for (std::size_t e = 0; e < model.canopy.size(); ++e) {
    const double area = area_m2(model.canopy.corners[e]);
    add(result_.elements[e].upper, result_.side_indirect_w_m2(2 * e, area, band_), area);
    add(result_.elements[e].lower, result_.side_indirect_w_m2(2 * e + 1, area, band_), area);
  }
  const double cell_m2 = layout_.cells() > 0 ? model.plot.area_m2() / layout_.cells() : 0.0;
  for (std::size_t cell = 0; cell < result_.soil_cells.size(); ++cell) {
    add(result_.soil_cells[cell], result_.cell_indirect_w_m2(cell, cell_m2, band_), cell_m2);
  }
  return values;
}

ChartText RankCharts::chart_text(LightField field, const RankScale& scale) const {
  ChartText text;
  text.title = scene_.title;
  text.subtitle = subtitle_line(scene_.model, result_);
  text.legend_title = fmt::format("{} {} irradiance, W m⁻²", field_name(field), scene_.model.bands[band_].name);
  text.legend = rank_legend(scale);
  text.footer = footer_line(field, result_);
  return text;
}

Image RankCharts::draw(LightField field) const {
  const SurfaceValues values = surface_values(field);
  const RankScale scale = equal_count_ranks(values.irradiance_w_m2, values.area_m2);
  std::vector<Colour> colours;
  colours.reserve(values.irradiance_w_m2.size());
  for (const double irradiance : values.irradiance_w_m2) colours.push_back(rank_colour(rank_of(scale, irradiance)));
  return draw_chart(seen_, colours, camera_, scene_.model.plot, layout_.layers.height_m, chart_text(field, scale));
}

}  // namespace sunfleck
