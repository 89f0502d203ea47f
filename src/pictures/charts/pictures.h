#pragma once
// Draws the pictures of a result.

#include "devices/tracers/engine.h"
#include "files/scene/scene_reader.h"
#include "physics/transport/model/counters.h"
#include "physics/transport/model/result.h"
#include "pictures/charts/colouring.h"
#include "pictures/charts/picture.h"
#include "pictures/drawing/camera.h"
#include "pictures/drawing/chart.h"
#include "pictures/drawing/exr_writer.h"
#include "pictures/drawing/image.h"
#include "pictures/drawing/surface_image.h"

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>

namespace sunfleck {

// Returns the number of the waveband of that name; an empty name means the first. Throws Error (input) if the scene has no such
// waveband.
[[nodiscard]] std::size_t picture_band(const RadiationModel& model, const std::string& name);

// Throw Error (input) if the scene lacks what a picture is to show, or does not allow the view.
void check_view(const RadiationModel& model, const PictureOptions& options);
void check_field(const RadiationModel& model, const Picture& picture);

// What to draw. `layout` is the scene's, `result` is of that scene, and the engine holds the scene's tree.
struct Drawing {
  const Scene& scene;
  const CounterLayout& layout;
  const RadiationResult& result;
  const Engine& engine;
};

// Building blocks of draw_charts, for callers that redraw one scene.

// Returns how many plots a picture shows along X and along Z: as many as the options say. Otherwise it is one, and in a view
// upwards from a periodic plot as many as reach twice as far as the canopy is high, at most 9: one plot alone would stand there
// in an empty field.
[[nodiscard]] int plots_shown(const RadiationModel& model, const CounterLayout& layout, const PictureOptions& options);

// The box around the plot and the canopy.
struct ShownBox {
  glm::dvec3 lo_m, hi_m;
};
[[nodiscard]] ShownBox shown_box(const RadiationModel& model, const CounterLayout& layout);

// Returns the scene's own camera or the requested view. A view fits the plot with its canopy and axes into the picture; it comes
// closer where plants would fill less than 60 % of the picture's height and width or, in a picture too narrow for that, less
// than 90 % of the room beside the legend.
[[nodiscard]] Camera picture_camera(const Scene& scene, const CounterLayout& layout, const PictureOptions& options);

// Returns how to look through that camera, with the size, samples and copies of the plot that the options give.
[[nodiscard]] CanopyLook picture_look(const RadiationModel& model, const CounterLayout& layout, const PictureOptions& options,
                                      const Camera& camera);

// Returns what the viewer saw as rows of a picture with those options.
[[nodiscard]] SurfaceImage surface_image(const std::vector<shared::SeenSurface>& samples, const RowBand& rows,
                                         const PictureOptions& options);

// Colours and text of one chart. `title` is the scene's.
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

// Returns the bytes that draw_charts needs on a device to draw `pictures` charts of the size in `options`, in addition to the
// result and the tree.
[[nodiscard]] double drawing_bytes(const CounterLayout& layout, const RadiationModel& model, const PictureOptions& options,
                                   std::size_t pictures, const TracerDevice& device);

// Draws charts of one view: the scene is looked at once for all of them or, in a scene of millions of triangles, for as many as
// have their colours in half a gibibyte. Passes each on as soon as it is finished, with its index in `pictures`; several
// threads may do so at once. Returns false if stopped before the last.
using ChartReceiver = std::function<void(std::size_t picture, const Image& image)>;
[[nodiscard]] bool draw_charts(const Drawing& drawing, const PictureOptions& options, std::span<const Picture> pictures,
                               const StopQuestion& stop, const ChartReceiver& receive);

// Returns the values themselves, or none if stopped. Channels: "Y" is the field in W m-2, averaged over the pixel's samples
// that see a surface, 0 if none does; "A" is the share of samples that see a surface; "element" is the number of the element
// that most of them see, 4294967295 if most see none (the soil is not an element).
[[nodiscard]] std::optional<ExrImage> draw_values(const Drawing& drawing, const PictureOptions& options, LightField field,
                                                  const StopQuestion& stop);

}  // namespace sunfleck
