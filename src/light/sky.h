#pragma once
// Sky light: radiance over the hemisphere, and directions drawn from it. Directions are unit vectors towards the sky in the
// scene's axes (X south, Y up, Z west).

#include "light/sun.h"

#include <glm/vec3.hpp>
#include <vector>

namespace sunfleck {

enum class SkyKind { uniform, overcast, general, all_weather, lights };

// Smallest sine of elevation of any direction of a sky, drawn or listed: a level ray would never leave an endless plot.
inline constexpr double least_sky_sine = 1e-6;

// One direction of a list, as CARIBU uses it: `weight` is its share of the horizontal irradiance, up to a common factor.
struct SkyLight {
  double weight = 0.0;         // at least 0
  glm::dvec3 to_sky{0, 1, 0};  // unit vector, y at least least_sky_sine
};

// The sky as a scene describes it; its radiance follows once the sun is known.
struct SkyModel {
  SkyKind kind = SkyKind::uniform;
  int cie_type = 12;             // general: type 1 to 15 of ISO 15469:2004; 12 is the CIE clear sky
  double dni_w_m2 = 0.0;         // all_weather: broadband direct normal irradiance
  double dhi_w_m2 = 0.0;         // all_weather: broadband diffuse horizontal irradiance, > 0
  std::vector<SkyLight> lights;  // lights: at least one with a positive weight

  // Returns true if the radiance depends on the sun's position, as for types 2, 4 and 6 to 15, and all_weather.
  [[nodiscard]] bool follows_sun() const;
};

struct SkyShape;

// A sky whose horizontal irradiance is 1: cells of constant radiance, uniform in zenith angle and in azimuth, or a list of
// directions. Its radiance and the directions drawn from it describe exactly the same sky.
class Sky {
 public:
  static constexpr int rows = 180;  // with these, vertical planes differ from the models' by at most 3e-4
  static constexpr int columns = 360;

  // `sun` matters only if model.follows_sun(); a sun below the horizon counts as on it. Throws Error (input) for a list
  // whose weights are all zero.
  Sky(const SkyModel& model, const SunPosition& sun);

  // Returns the radiance, sr-1, of the cell that holds the direction; 0 below the horizon. Must not be called for lights
  // (EXPECT).
  [[nodiscard]] double radiance(const glm::dvec3& to_sky) const;

  // Returns the integral of radiance over the hemisphere: the irradiance of a sphere's cross-section, which is what a disc
  // receives that turns to face each direction. For lights it is the sum of weights divided by the sine of elevation.
  [[nodiscard]] double spherical_irradiance() const { return spherical_; }

  // Return a random direction, drawn with density radiance times cosine of zenith angle (every ray then carries the same
  // share of the horizontal irradiance), or with density radiance alone (every ray then carries the same share of the
  // spherical one). u, with which the zenith angle rises, and v, the azimuth within a row of cells, lie in [0, 1); a list
  // uses only u. The direction is always above the horizon.
  [[nodiscard]] glm::dvec3 draw_by_horizontal_irradiance(double u, double v) const;
  [[nodiscard]] glm::dvec3 draw_by_radiance(double u, double v) const;

  [[nodiscard]] bool is_list() const { return !lights_.empty(); }
  // Returns the directions of a list, with weights that sum to 1; empty unless is_list().
  [[nodiscard]] const std::vector<SkyLight>& lights() const { return lights_; }

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

// The parameters of the all-weather model for one moment (Perez, Seals and Michalsky 1993, Solar Energy 50:235), dhi_w_m2 >
// 0. Clearness is limited to at most 12.01, brightness to 0.01..0.6 (0.2..0.6 in bins 2 to 5), b to values below 0, and a to
// values that keep the zenith's radiance from being negative.
struct AllWeather {
  double clearness = 1.0;   // epsilon
  double brightness = 0.0;  // delta
  int bin = 1;              // 1..8
  double a = 0.0, b = 0.0, c = 0.0, d = 0.0, e = 0.0;
};
[[nodiscard]] AllWeather all_weather(double dni_w_m2, double dhi_w_m2, const SunPosition& sun);

}  // namespace sunfleck
