#pragma once
// Sky light: radiance over the hemisphere, and directions drawn from it. Directions are unit vectors towards the sky in the
// scene's axes (X south, Y up, Z west).

#include "light/sun.h"

#include <glm/vec3.hpp>
#include <vector>

namespace sunfleck {

enum class SkyKind { uniform, overcast, general, all_weather, lights };

// No direction of a sky, drawn or listed, has a smaller sine of elevation: a level ray never leaves an endless plot.
inline constexpr double least_sky_sine = 1e-6;

// One direction of a list, CARIBU's way: `weight` is its share of the horizontal irradiance, to any common factor.
struct SkyLight {
  double weight = 0.0;         // >= 0
  glm::dvec3 to_sky{0, 1, 0};  // unit, y at least least_sky_sine
};

// What a scene says of its sky; it becomes radiance once the sun is known.
struct SkyModel {
  SkyKind kind = SkyKind::uniform;
  int cie_type = 12;             // general: type 1 to 15 of ISO 15469:2004; 12 is the CIE clear sky
  double dni_w_m2 = 0.0;         // all_weather: broadband direct normal irradiance
  double dhi_w_m2 = 0.0;         // all_weather: broadband diffuse horizontal irradiance, > 0
  std::vector<SkyLight> lights;  // lights: at least one with weight

  // True if its radiance depends on where the sun stands: it does for types 2, 4 and 6 to 15, and all_weather.
  [[nodiscard]] bool follows_sun() const;
};

struct SkyShape;

// A sky whose horizontal irradiance is 1: cells of constant radiance, even in zenith angle and in azimuth; or a list
// of directions. What it says and what it draws are the same sky exactly.
class Sky {
 public:
  static constexpr int rows = 180;  // vertical planes then differ from the models' by at most 3e-4
  static constexpr int columns = 360;

  // `sun` matters where model.follows_sun(); a sun below the horizon counts as on it. Throws Error (input) for lights without
  // weight.
  Sky(const SkyModel& model, const SunPosition& sun);

  // Radiance, sr-1, of the cell that holds the direction; 0 below the horizon. Not for lights (EXPECT).
  [[nodiscard]] double radiance(const glm::dvec3& to_sky) const;

  // The integral of radiance over the hemisphere: irradiance of a sphere's cross-section, which is what falls on a disc that
  // turns to face each direction. For lights the sum of weights over the sine of elevation.
  [[nodiscard]] double spherical_irradiance() const { return spherical_; }

  // A direction, drawn with density radiance times cosine of zenith angle (every ray then carries the same share of the
  // horizontal irradiance), or with density radiance alone (every ray the same share of the spherical one). u, zenith angle
  // rising with it, and v, azimuth within a row of cells, in [0, 1); a list goes by u alone. Always above the horizon.
  [[nodiscard]] glm::dvec3 draw_by_horizontal_irradiance(double u, double v) const;
  [[nodiscard]] glm::dvec3 draw_by_radiance(double u, double v) const;

  [[nodiscard]] bool is_list() const { return !lights_.empty(); }
  [[nodiscard]] const std::vector<SkyLight>& lights() const { return lights_; }  // weights sum to 1; empty unless is_list()

 private:
  void take_lights(const std::vector<SkyLight>& lights);
  void take_shape(const SkyShape& shape, const SunPosition& sun);
  [[nodiscard]] double azimuth_in_row(std::size_t row, double v) const;

  std::vector<double> radiance_;                // [row, zenith first][column, azimuth from north clockwise]
  std::vector<double> row_cosine_, row_plain_;  // cumulative shares of the rows by either density
  std::vector<double> column_;                  // [row][column], cumulative shares within a row
  std::vector<SkyLight> lights_;
  std::vector<double> light_cosine_, light_plain_;  // cumulative shares by either density
  double spherical_ = 0.0;
};

// The all-weather model's parameters for a moment (Perez, Seals and Michalsky 1993, Solar Energy 50:235), dhi_w_m2 > 0.
// Clearness is kept to at most 12.01, brightness to 0.01..0.6 (0.2..0.6 in bins 2 to 5), b below 0 and a where the zenith is
// not negative.
struct AllWeather {
  double clearness = 1.0;   // epsilon
  double brightness = 0.0;  // delta
  int bin = 1;              // 1..8
  double a = 0.0, b = 0.0, c = 0.0, d = 0.0, e = 0.0;
};
[[nodiscard]] AllWeather all_weather(double dni_w_m2, double dhi_w_m2, const SunPosition& sun);

}  // namespace sunfleck
