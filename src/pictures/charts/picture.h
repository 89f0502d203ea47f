#pragma once
// The pictures that can be requested, and the views from which they are drawn.

#include <optional>
#include <string>
#include <vector>

namespace sunfleck {

// The light to show. direct: irradiance by the beam's first landings. sky: by unscattered sky light. indirect: by everything
// except the beam. total: by all light. absorbed: absorbed flux instead of irradiance. scattered: irradiance by everything
// except the beam and unscattered sky light, that is by scattered light and the light of lamps.
enum class LightField { direct, sky, indirect, total, absorbed, scattered };

// rank, rank_interval and rank_log divide the leaf area into five classes: of equal area, of equal width, of equal ratio.
enum class ChartKind { rank, rank_interval, rank_log, hue, map };

// The scene's camera, a view from above, from the south, or upwards from the middle of the plot's ground.
enum class ViewKind { camera, top, side, fisheye };

struct Picture {
  ChartKind chart = ChartKind::rank;
  LightField field = LightField::total;

  friend bool operator==(const Picture&, const Picture&) = default;
};

struct PictureOptions {
  std::string band;  // empty: the scene's first
  ViewKind view = ViewKind::camera;
  int width = 1600, height = 1200;
  int samples = 4;  // per pixel
  // Plots shown along X and along Z if the plot is periodic; odd, with the plot itself in the middle. None: as many as the view
  // needs.
  std::optional<int> repeat;
  // Upper end of the scales of rank_interval, rank_log and map, and of the soil in rank charts; none: chosen from the values.
  std::optional<double> top_w_m2;
};

// Returns whether the chart divides the leaf area into classes.
[[nodiscard]] constexpr bool is_rank(ChartKind chart) {
  return chart == ChartKind::rank || chart == ChartKind::rank_interval || chart == ChartKind::rank_log;
}

// Returns whether the chart's scale, of a rank chart that of its soil, can be given an upper end.
[[nodiscard]] constexpr bool has_top(ChartKind chart) {
  return chart != ChartKind::hue;
}

// Return the names used on the command line, in the order of the enumerations.
[[nodiscard]] std::vector<std::string> field_names();
[[nodiscard]] std::vector<std::string> chart_names();
[[nodiscard]] std::vector<std::string> view_names();

// Returns the stem of the picture's file: chart_field, e.g. "rank_direct".
[[nodiscard]] std::string stem_of(const Picture& picture);

// Returns every possible picture.
[[nodiscard]] std::vector<Picture> all_pictures();
// Returns the pictures for which `all` stands: rank and hue of direct light if there is any, and of indirect and total light if
// some light is indirect.
[[nodiscard]] std::vector<Picture> usual_pictures(bool any_direct, bool any_indirect);

}  // namespace sunfleck
