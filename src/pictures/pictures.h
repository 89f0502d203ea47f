#pragma once
// From a result to its pictures.

#include "io/exr_writer.h"
#include "io/scene_reader.h"
#include "pictures/colouring.h"
#include "pictures/picture.h"
#include "tracers/engine.h"
#include "transport/counters.h"
#include "transport/result.h"
#include "view/camera.h"
#include "view/chart.h"
#include "view/image.h"
#include "view/surface_image.h"

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>

namespace sunfleck {

// The number of the band of that name, of the first for an empty one. Throws Error (input) if the scene has none such.
[[nodiscard]] std::size_t picture_band(const RadiationModel& model, const std::string& name);

// Throws Error (input) if the scene does not have what a picture is to show, or cannot be looked at that way.
void check_view(const RadiationModel& model, const PictureOptions& options);
void check_field(const RadiationModel& model, const Picture& picture);

// What is drawn. `layout` is the scene's, `result` of the scene; the tree of the engine is the scene's.
struct Drawing {
  const Scene& scene;
  const CounterLayout& layout;
  const RadiationResult& result;
  const Engine& engine;
};

// The parts that draw_charts is made of, for who draws one scene again and again.

// Plot and canopy.
struct ShownBox {
  glm::dvec3 lo_m, hi_m;
};
[[nodiscard]] ShownBox shown_box(const RadiationModel& model, const CounterLayout& layout);

// The scene's own camera, or the view asked for.
[[nodiscard]] Camera picture_camera(const Scene& scene, const CounterLayout& layout, const PictureOptions& options);

// How a viewer looks through that camera: size, samples and copies of the plot are those of the options.
[[nodiscard]] CanopyLook picture_look(const RadiationModel& model, const CounterLayout& layout, const PictureOptions& options,
                                      const Camera& camera);

// What the viewer saw, rows of a picture of those options.
[[nodiscard]] SurfaceImage surface_image(const std::vector<shared::SeenSurface>& samples, const RowBand& rows,
                                         const PictureOptions& options);

// Colours and words of one chart. `title` is the scene's.
struct ChartContent {
  std::vector<Colour> colours;  // linear, [surface number]
  ChartText text;
};
struct ChartSource {
  const std::string& title;
  const RadiationModel& model;
  const CounterLayout& layout;
  const RadiationResult& result;
};
[[nodiscard]] ChartContent chart_content(const ChartSource& source, const PictureOptions& options, const Picture& picture,
                                         const SurfaceColours& surfaces);

// Draws charts of one view: the scene is looked at once for all of them. Each is handed over as soon as it is finished, in
// order. False if stopped before the last.
using ChartReceiver = std::function<void(const Picture& picture, const Image& image)>;
[[nodiscard]] bool draw_charts(const Drawing& drawing, const PictureOptions& options, std::span<const Picture> pictures,
                               const StopQuestion& stop, const ChartReceiver& receive);

// The values themselves. Channels: "Y" the field in W m-2, mean over the samples of the pixel that see a surface, 0 where none
// does; "A" the share of samples that see one; "element" the number of the element that most of them see, 4294967295 where it
// is none, which the soil is not. None if stopped.
[[nodiscard]] std::optional<ExrImage> draw_values(const Drawing& drawing, const PictureOptions& options, LightField field,
                                                  const StopQuestion& stop);

}  // namespace sunfleck
