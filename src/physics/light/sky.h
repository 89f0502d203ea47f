#pragma once
// Sky light: radiance over the hemisphere, and directions drawn from it. Directions are unit vectors towards the sky in the
// scene's axes (X south, Y up, Z west).

#include "physics/light/sky_model.h"
#include "physics/light/sun.h"

#include <cstddef>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

namespace sunfleck {

// A sky whose horizontal irradiance is 1: cells of constant radiance, uniform in zenith angle and in azimuth, or a list of
// directions. Its radiance and the directions drawn from it describe exactly the same sky.
class Sky {
 public:
  static constexpr int rows = 180;  // with these, vertical planes differ from the models' by at most 3e-4
  static constexpr int columns = 360;

  // `sun` may be missing unless model.follows_sun() (EXPECT); a sun below the horizon counts as on it. Throws Error (input) for a
  // list whose weights are all zero.
  Sky(const SkyModel& model, const std::optional<SunPosition>& sun);

  // Returns a sky whose radiance is the mean of these skies' radiances. All of them must be of cells, or all the same list
  // (EXPECT).
  [[nodiscard]] static Sky mean_of(std::span<const Sky> skies);

  // Returns the cell that holds the direction, and the radiance of a cell, sr-1. Must not be called for lights.
  [[nodiscard]] static std::size_t cell_of(const glm::dvec3& to_sky);
  [[nodiscard]] double radiance_of_cell(std::size_t cell) const { return radiance_[cell]; }

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
  Sky() = default;

  void take_lights(const std::vector<SkyLight>& lights);
  void take_radiance();  // that of the cells, of any unit
  void take_shape(const SkyShape& shape, const SunPosition& sun);
  [[nodiscard]] double azimuth_in_row(std::size_t row, double v) const;

  std::vector<double> radiance_;                // [row, zenith first][column, azimuth from north clockwise]
  std::vector<double> row_cosine_, row_plain_;  // cumulative shares of the rows by either density
  std::vector<double> column_;                  // [row][column], cumulative shares within a row
  std::vector<SkyLight> lights_;
  std::vector<double> light_cosine_, light_plain_;  // cumulative shares by either density
  double spherical_ = 0.0;
};

}  // namespace sunfleck
