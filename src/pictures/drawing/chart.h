#pragma once
// Draws finished charts: coloured surfaces, axes, the plot's border, title and legend.

#include "physics/canopy/plot.h"
#include "pictures/drawing/camera.h"
#include "pictures/drawing/colour_scale.h"
#include "pictures/drawing/image.h"
#include "pictures/drawing/legend.h"
#include "pictures/drawing/north_arrow.h"
#include "pictures/drawing/surface_image.h"

#include <span>
#include <string>
#include <vector>

namespace sunfleck {

// Text of a chart: UTF-8, one line each. A line too long for the picture is set in a smaller size.
struct ChartText {
  std::string title;
  std::string subtitle;  // may be empty
  Legend legend;
  std::string footer;  // may be empty
};

// The content of a chart, and its size. A fisheye's chart has the horizon's circle and N, E, S, W instead of axes and border.
struct ChartFrame {
  int width = 0;
  int height = 0;
  Camera camera;
  Plot plot;
  double height_m = 0.0;  // of the canopy, for the length of the axes
};

// Returns where a chart of that size has its north arrow: in the lower right corner, above the footer.
[[nodiscard]] NorthArrowPlace north_arrow_place(double width_px, double height_px);

// A chart that is painted in bands of rows; the division into bands does not affect any pixel.
//
// Surfaces are shown in their colours, averaged over each pixel's samples, on a soft background; neighbouring copies of the
// plot are blended half and half with it. The user's axes start at their origin in red (X), green (Y) and blue (Z) with their
// letters, and the plot's border is black at ground level; both are hidden behind surfaces (the letters never are). An arrow in
// the lower right corner points north. Text is in a sans-serif typeface whose size scales with the picture's height and which
// stays readable at half size.
class ChartCanvas {
 public:
  // colours: linear, [surface number].
  ChartCanvas(const ChartFrame& frame, std::vector<Colour> colours);

  // Paints the rows that `seen` holds. Call once per row, in any order.
  void paint(const SurfaceImage& seen);

  // Adds lines and text after all rows are painted, and returns the picture.
  [[nodiscard]] Image finish(const ChartText& text);

 private:
  ChartFrame frame_;
  std::vector<Colour> colours_;
  Image image_;
};

// Draws a whole chart at once, at the size of `seen`.
[[nodiscard]] Image draw_chart(const SurfaceImage& seen, std::span<const Colour> colours, const Camera& camera,
                               const Plot& plot, double height_m, const ChartText& text);

}  // namespace sunfleck
