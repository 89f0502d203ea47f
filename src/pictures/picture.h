#pragma once
// What pictures are asked for, and how they are looked at.

#include <optional>
#include <string>
#include <vector>

namespace sunfleck {

// Irradiance by the beam's first landings, by the sky unscattered, by all but the beam, by everything; what is absorbed; or
// irradiance by all but beam and unscattered sky, which is scattered light and that of lamps.
enum class LightField { direct, sky, indirect, total, absorbed, scattered };

enum class ChartKind { rank, rank_interval, hue, map };

// The scene's camera, or from above, from the south, or upwards from the middle of the plot's ground.
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
  int samples = 4;                 // a pixel
  int repeat = 1;                  // of a periodic plot: odd, so many plots along X and along Z, itself in the middle
  std::optional<double> top_w_m2;  // where the scales of rank_interval and map end; none: as the values suggest
};

// As on the command line, in the order of the enumerations.
[[nodiscard]] std::vector<std::string> field_names();
[[nodiscard]] std::vector<std::string> chart_names();
[[nodiscard]] std::vector<std::string> view_names();

// Stem of its file: chart_field, "rank_direct".
[[nodiscard]] std::string stem_of(const Picture& picture);

// Every picture there is, by stem; and those that `all` stands for: rank and hue of direct, indirect and total.
[[nodiscard]] std::vector<Picture> all_pictures();
[[nodiscard]] std::vector<Picture> usual_pictures();

}  // namespace sunfleck
