#pragma once
// A finished chart: coloured surfaces, axes, the plot's border, title and legend.

#include "canopy/plot.h"
#include "view/camera.h"
#include "view/colour_scale.h"
#include "view/image.h"
#include "view/legend.h"
#include "view/surface_image.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace sunfleck {

// UTF-8, a line each. What is too long for the picture is set smaller.
struct ChartText {
  std::string title;
  std::string subtitle;      // may be empty
  std::string legend_title;  // as Legend::title
  std::vector<LegendEntry> legend;
  std::string footer;            // may be empty
  std::optional<ColourBar> bar;  // below the entries of the legend
};

// What a chart shows, and how large. A fisheye's chart has the horizon's circle and N, E, S, W instead of axes and border.
struct ChartFrame {
  int width = 0;
  int height = 0;
  Camera camera;
  Plot plot;
  double height_m = 0.0;  // of the canopy, for the length of the axes
};

// A chart that is painted band of rows by band of rows; how the rows are cut changes no pixel.
//
// Surfaces in their colours averaged over each pixel's samples over a soft background, those of neighbouring copies of the plot
// mixed half and half with it; the axes from the plot's origin in red (X), green (Y), blue (Z) with their letters, the plot's
// border at ground level in black, both hidden where a surface stands before them (their letters never are); text in a
// sans-serif type whose size follows the picture's height, readable at half size.
class ChartCanvas {
 public:
  // colours: linear, [surface number].
  ChartCanvas(const ChartFrame& frame, std::vector<Colour> colours);

  // Paints the rows that are in `seen`; each row once, in any order.
  void paint(const SurfaceImage& seen);

  // After all rows. The picture is handed over.
  [[nodiscard]] Image finish(const ChartText& text);

 private:
  ChartFrame frame_;
  std::vector<Colour> colours_;
  Image image_;
};

// The same in one go, at the size of `seen`.
[[nodiscard]] Image draw_chart(const SurfaceImage& seen, std::span<const Colour> colours, const Camera& camera,
                               const Plot& plot, double height_m, const ChartText& text);

}  // namespace sunfleck
