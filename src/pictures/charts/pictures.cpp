#include "pictures/charts/pictures.h"

#include "base/error.h"
#include "base/file.h"
#include "base/text.h"
#include "base/threads.h"
#include "base/units.h"
#include "devices/tracers/canopy_view.h"
#include "physics/transport/model/surfaces.h"
#include "pictures/charts/fields.h"
#include "pictures/charts/open_spot.h"
#include "pictures/drawing/value_image.h"
#include "pictures/drawing/view_block.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <glm/common.hpp>
#include <utility>
#include <vector>

namespace sunfleck {
namespace {

// Height from which a canopy photograph is taken: between the plants, above the clods of the soil.
constexpr double fisheye_height_m = 0.1;

std::string subtitle_line(const RadiationModel& model, const RadiationResult& result) {
  std::string line;
  if (model.has_beam()) {
    line = fmt::format("Sun at elevation {:.2f}°, azimuth {:.2f}°; ", in_degrees(model.sun->elevation_rad),
                       in_degrees(model.sun->azimuth_rad));
  }
  return line + fmt::format("{}, leaf area index {:.2f}", counted(model.canopy.size(), "triangle"), result.leaf_area_index);
}

std::string footer_line(LightField field, const RadiationResult& result, std::size_t band, const std::string& note) {
  std::string line;
  const auto add = [&](std::uint64_t count, const char* what, const std::optional<double>& error) {
    if (count == 0) return;
    line += fmt::format("{}{:.2f} million {}", line.empty() ? "" : "; ", static_cast<double>(count) * 1e-6, what);
    if (error) line += fmt::format(", relative error {:.2g}", *error);
  };
  add(result.direct.rays, "rays", result.direct.relative_error);
  if (field != LightField::direct) {
    add(result.indirect.packets + result.indirect.sky_rays, "packets", result.indirect.relative_error);
  }
  if (band < result.triangle_relative_error.size() && !std::isnan(result.triangle_relative_error[band])) {
    line += fmt::format("; what a triangle absorbs is known to {:.2g} %", 100.0 * result.triangle_relative_error[band]);
  }
  return note.empty() ? line : line + (line.empty() ? "" : "; ") + note;
}

// Looks at the scene once, and passes on every band of rows from top to bottom. Returns false if stopped.
template <class Receive>
[[nodiscard]] bool each_band(const Drawing& drawing, const PictureOptions& options, const Camera& camera,
                             const StopQuestion& stop, const Receive& receive) {
  const auto viewer = drawing.engine.viewer(picture_look(drawing.scene.model, drawing.layout, options, camera));
  for (const RowBand& rows :
       row_bands(options.width, options.height, options.samples, samples_at_once(drawing.engine.device()))) {
    const auto samples = viewer->see(static_cast<std::uint32_t>(rows.first), static_cast<std::uint32_t>(rows.count), stop);
    if (samples.empty()) return false;
    receive(surface_image(samples, rows, options));
  }
  return true;
}

// Returns how many charts are drawn in one look at the scene: as many as their colours of all surfaces fit into half a
// gibibyte, and at least one.
std::size_t charts_at_once(const CounterLayout& layout, const RadiationModel& model) {
  constexpr std::size_t most_bytes = std::size_t{1} << 29U;
  const std::size_t bytes_each = (2 * model.canopy.size() + layout.cells() + 1) * sizeof(Colour);
  return std::max<std::size_t>(1, most_bytes / bytes_each);
}

// Draws charts in one look at the scene. Returns false if stopped.
bool draw_together(const Drawing& drawing, const PictureOptions& options, const SurfaceColours& surfaces,
                   std::span<const Picture> pictures, const StopQuestion& stop, const ChartReceiver& receive) {
  const RadiationModel& model = drawing.scene.model;
  const Camera camera = picture_camera(drawing.scene, drawing.layout, options);
  const ChartFrame frame{options.width, options.height, camera, model.plot, drawing.layout.layers.height_m};
  std::vector<ChartContent> contents(pictures.size());
  tbb::parallel_for(std::size_t{0}, pictures.size(), [&](std::size_t k) {
    contents[k] = chart_content({drawing.scene.title, model, drawing.layout, drawing.result}, options, pictures[k], surfaces);
  });
  std::vector<ChartCanvas> canvases;
  for (ChartContent& content : contents) canvases.emplace_back(frame, std::move(content.colours));
  const bool seen = each_band(drawing, options, camera, stop, [&](const SurfaceImage& rows) {
    tbb::parallel_for(std::size_t{0}, canvases.size(), [&](std::size_t k) { canvases[k].paint(rows); });
  });
  if (!seen) return false;
  std::atomic<bool> finished = true;
  tbb::parallel_for(std::size_t{0}, canvases.size(), [&](std::size_t k) {
    if (stop && stop()) {
      finished = false;
    } else {
      receive(k, canvases[k].finish(contents[k].text));
    }
  });
  return finished;
}

constexpr double least_filled_share = 0.6;
// The part of the room for plants that they fill where the legend leaves too little of a narrow picture.
constexpr double least_filled_room = 0.9;

// Returns the corners of plants, of large stands those of a sample.
std::vector<glm::dvec3> plant_points(const RadiationModel& model) {
  constexpr std::size_t most_elements = std::size_t{1} << 17U;
  const Surfaces surfaces(model);
  const std::size_t step = 1 + model.canopy.size() / most_elements;
  std::vector<glm::dvec3> points_m;
  for (std::size_t e = 0; e < model.canopy.size(); e += step) {
    const Triangle corners = model.canopy.corners[e];
    if (!is_vegetation(surfaces.at(e).role) || area_m2(corners) == 0.0) continue;
    for (const glm::vec3& corner : corners) points_m.push_back(glm::dvec3(corner) + model.canopy.origin_m);
  }
  return points_m;
}

// Returns the part of the picture's width or height, whichever is larger, that the points take up.
double filled_share(const Camera& camera, std::span<const glm::dvec3> points_m) {
  glm::dvec2 lo(1.0), hi(0.0);
  for (const glm::dvec3& point : points_m) {
    const auto seen = project(camera, point);
    if (!seen) continue;
    lo = glm::min(lo, seen->at);
    hi = glm::max(hi, seen->at);
  }
  return std::max(hi.x - lo.x, hi.y - lo.y);
}

// Returns a camera between two of one direction, as little nearer than `far` as lets the points fill `share` of the picture.
Camera near_enough(const Camera& far, const Camera& near, std::span<const glm::dvec3> points_m, double share) {
  constexpr int halvings = 8;
  const auto at = [&](double way) {
    Camera camera = far;
    camera.position_m = glm::mix(far.position_m, near.position_m, way);
    camera.half_height_m = glm::mix(far.half_height_m, near.half_height_m, way);
    return camera;
  };
  double too_far = 0.0, enough = 1.0;
  for (int k = 0; k < halvings; ++k) {
    const double middle = 0.5 * (too_far + enough);
    (filled_share(at(middle), points_m) < share ? too_far : enough) = middle;
  }
  return at(enough);
}

Camera view_of(ViewKind view, std::span<const glm::dvec3> points_m, double aspect) {
  if (view == ViewKind::top) return top_view(points_m, aspect);
  return view == ViewKind::side ? side_view(points_m, aspect) : three_quarter_view(points_m, aspect);
}

}  // namespace

std::size_t picture_band(const RadiationModel& model, const std::string& name) {
  if (name.empty()) return 0;
  std::vector<std::string_view> known;
  for (std::size_t b = 0; b < model.bands.size(); ++b) {
    if (model.bands[b].name == name) return b;
    known.push_back(model.bands[b].name);
  }
  throw_input(fmt::format("--band {}", printable(name)), "the scene has no such waveband",
              fmt::format("give one of {}", fmt::join(known, ", ")));
}

void check_view(const RadiationModel& model, const PictureOptions& options) {
  static_cast<void>(picture_band(model, options.band));
  if (options.repeat.value_or(1) == 1 || model.plot.periodic) return;
  throw_input(fmt::format("--repeat {}", *options.repeat), "the plot is isolated: it has no neighbours",
              "leave --repeat out, or make the scene periodic");
}

void check_field(const RadiationModel& model, const Picture& picture) {
  if (has_field(model, picture.field)) return;
  const char* why = "nothing in the scene reflects, transmits or emits light, and there is no sky";
  if (picture.field == LightField::direct) why = "the scene has no beam";
  if (picture.field == LightField::sky) why = "the scene has no light from the sky";
  throw_input("picture " + stem_of(picture), why, "choose another field");
}

ShownBox shown_box(const RadiationModel& model, const CounterLayout& layout) {
  const Box elements = bounds(model.canopy);
  ShownBox box{glm::dvec3(0.0), glm::dvec3(model.plot.size_x_m, layout.layers.height_m, model.plot.size_z_m)};
  if (model.canopy.size() > 0) {
    box.lo_m = glm::min(box.lo_m, glm::dvec3(elements.lo) + model.canopy.origin_m);
    box.hi_m = glm::max(box.hi_m, glm::dvec3(elements.hi) + model.canopy.origin_m);
  }
  return box;
}

int plots_shown(const RadiationModel& model, const CounterLayout& layout, const PictureOptions& options) {
  constexpr double reach_in_heights = 2.0;
  constexpr int most = 9;
  if (options.repeat) return *options.repeat;
  if (options.view != ViewKind::fisheye || !model.plot.periodic) return 1;
  const double plots_aside = reach_in_heights * layout.layers.height_m / std::min(model.plot.size_x_m, model.plot.size_z_m);
  int plots = 1;
  while (plots < most && 0.5 * plots < plots_aside) plots += 2;
  return plots;
}

Camera picture_camera(const Scene& scene, const CounterLayout& layout, const PictureOptions& options) {
  const RadiationModel& model = scene.model;
  const double aspect = static_cast<double>(options.width) / options.height;
  const auto& pose = scene.camera;
  if (options.view == ViewKind::camera && pose) return look_at(pose->position_m, pose->look_at_m, pose->fov_rad, aspect);
  if (options.view == ViewKind::fisheye) return fisheye_view(open_spot(model, fisheye_height_m), aspect);
  auto [lo, hi] = shown_box(model, layout);
  const int plots = plots_shown(model, layout, options);
  const glm::dvec3 beside = 0.5 * (plots - 1) * glm::dvec3(model.plot.size_x_m, 0.0, model.plot.size_z_m);
  const Camera camera = view_of(options.view, box_with_axes(lo - beside, hi + beside, model.plot.axes), aspect);
  if (plots > 1) return camera;
  const std::vector<glm::dvec3> plants_m = plant_points(model);
  if (plants_m.empty()) return camera;
  const Camera nearest = view_of(options.view, plants_m, aspect);
  const double share = std::min(least_filled_share, least_filled_room * filled_share(nearest, plants_m));
  return filled_share(camera, plants_m) < share ? near_enough(camera, nearest, plants_m, share) : camera;
}

CanopyLook picture_look(const RadiationModel& model, const CounterLayout& layout, const PictureOptions& options,
                        const Camera& camera) {
  CanopyLook look;
  look.view = make_view_block(camera, {options.width, options.height, options.samples}, model.canopy.origin_m);
  look.view.elements = static_cast<std::uint32_t>(model.canopy.size());
  look.view.ground = make_ground_map(layout);
  look.offsets = sample_offsets(options.samples);
  const int plots = plots_shown(model, layout, options);
  if (plots == 1) return look;
  // In a side view, copies in front would hide the plot itself.
  const bool from_the_side = options.view == ViewKind::camera || options.view == ViewKind::side;
  look.copies = {plots, model.canopy.period_m, from_the_side ? SeenCopies::Which::not_before_plot : SeenCopies::Which::all};
  return look;
}

SurfaceImage surface_image(const std::vector<shared::SeenSurface>& samples, const RowBand& rows,
                           const PictureOptions& options) {
  static_assert(SurfaceImage::nothing == shared::seen_nothing);
  SurfaceImage image{options.width, rows.count, options.samples, {}, {}, {}, rows.first};
  image.surface.reserve(samples.size());
  image.depth_m.reserve(samples.size());
  const bool neighbours = std::any_of(samples.begin(), samples.end(), [](const auto& sample) { return sample.copy != 0; });
  if (neighbours) image.neighbour.reserve(samples.size());
  for (const shared::SeenSurface& sample : samples) {
    image.surface.push_back(sample.surface);
    image.depth_m.push_back(sample.depth);
    if (neighbours) image.neighbour.push_back(sample.copy != 0 ? 1 : 0);
  }
  return image;
}

ChartContent chart_content(const ChartSource& source, const PictureOptions& options, const Picture& picture,
                           const SurfaceColours& surfaces) {
  const RadiationModel& model = source.model;
  const std::size_t band = picture_band(model, options.band);
  FieldValues values = field_values(model, source.layout, source.result, band, picture.field);
  const bool of_leaves = is_rank(picture.chart);
  if (of_leaves) values = leaf_values(model, std::move(values), picture.field);
  const int faces = of_leaves || picture.field == LightField::absorbed ? 2 : 1;
  const ScaleLimits limits{options.top_w_m2, of_leaves ? lit_from_w_m2(model, band, picture.field) : 0.0,
                           largest_possible_w_m2(model, band, picture.field, faces),
                           largest_on_soil_w_m2(model, band, picture.field)};
  const std::string title = field_title(picture.field, model.bands[band].name, of_leaves);
  Colouring colouring = colour_field(picture.chart, values, surfaces, title, limits);
  return {std::move(colouring.colours),
          {source.title, subtitle_line(model, source.result), std::move(colouring.legend),
           footer_line(picture.field, source.result, band, colouring.note)}};
}

double drawing_bytes(const CounterLayout& layout, const RadiationModel& model, const PictureOptions& options,
                     std::size_t pictures, const TracerDevice& device) {
  const auto surfaces = 2.0 * static_cast<double>(model.canopy.size()) + layout.cells();
  const auto count = static_cast<double>(std::min(pictures, charts_at_once(layout, model)));
  const double colours = surfaces * (count + 1.0) * sizeof(Colour);  // and once without light
  const double values = surfaces * 3.0 * sizeof(double);             // values, areas, luminances
  const double picture = static_cast<double>(options.width) * options.height * sizeof(decltype(Image::pixels)::value_type);
  const double samples = std::max<double>(samples_at_once(device), options.width * options.samples) *
                         (sizeof(shared::SeenSurface) + sizeof(decltype(SurfaceImage::surface)::value_type) +
                          sizeof(decltype(SurfaceImage::depth_m)::value_type));
  // A picture is filtered as a whole before it is compressed, after the samples were seen. Threads that share a core are seldom
  // at it together.
  constexpr double encoded = 1.15;
  const auto at_once = static_cast<double>(std::min<std::size_t>(threads_allowed(), cpu_thread_count(0)));
  const double encoding = encoded * picture * std::min(count, at_once);
  return colours + values + count * picture + std::max(samples, encoding);
}

bool draw_charts(const Drawing& drawing, const PictureOptions& options, std::span<const Picture> pictures,
                 const StopQuestion& stop, const ChartReceiver& receive) {
  const SurfaceColours surfaces = surface_colours(drawing.scene.model, drawing.layout);
  const std::size_t at_once = charts_at_once(drawing.layout, drawing.scene.model);
  for (std::size_t first = 0; first < pictures.size(); first += at_once) {
    const auto some = pictures.subspan(first, std::min(at_once, pictures.size() - first));
    const auto receive_some = [&](std::size_t k, const Image& image) { receive(first + k, image); };
    if (!draw_together(drawing, options, surfaces, some, stop, receive_some)) return false;
  }
  return true;
}

std::optional<ExrImage> draw_values(const Drawing& drawing, const PictureOptions& options, LightField field,
                                    const StopQuestion& stop) {
  const RadiationModel& model = drawing.scene.model;
  const std::size_t band = picture_band(model, options.band);
  const FieldValues values = field_values(model, drawing.layout, drawing.result, band, field);
  ValueImage image;
  const bool seen = each_band(drawing, options, picture_camera(drawing.scene, drawing.layout, options), stop,
                              [&](const SurfaceImage& rows) { append_rows(image, resolve_values(rows, values.w_m2)); });
  if (!seen) return std::nullopt;
  for (std::uint32_t& surface : image.surface) {
    surface = surface < 2 * model.canopy.size() ? surface / 2 : SurfaceImage::nothing;
  }
  ExrImage exr{image.width, image.height, {}, {}};
  exr.channels.push_back({"Y", std::move(image.value)});
  exr.channels.push_back({"A", std::move(image.coverage)});
  exr.channels.push_back({"element", std::move(image.surface)});
  exr.comments = fmt::format(
      "{}; Y: {}, mean over the samples that see a surface; A: share of the samples that see one; element: number of the "
      "triangle that most samples see, from 0, 4294967295 for soil and sky",
      drawing.scene.title, field_title(field, model.bands[band].name));
  return exr;
}

}  // namespace sunfleck
