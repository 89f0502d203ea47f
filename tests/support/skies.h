#pragma once
// Skies for tests, and integrals over them.

#include "base/units.h"
#include "physics/light/sky.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <numbers>
#include <utility>
#include <vector>

namespace sunfleck::test {

inline constexpr double pi = std::numbers::pi;
inline constexpr double row_height = pi / 2.0 / Sky::rows, column_width = 2.0 * pi / Sky::columns;
inline constexpr SunPosition paper_sun{(90.0 - 36.9824) * degree, 120.569 * degree};
inline constexpr SunPosition low_sun{30.0 * degree, 180.0 * degree};

inline glm::dvec3 to_sky(double zenith_rad, double azimuth_rad) {
  return {-std::sin(zenith_rad) * std::cos(azimuth_rad), std::cos(zenith_rad), -std::sin(zenith_rad) * std::sin(azimuth_rad)};
}

inline const std::array<glm::dvec3, 4> north_east_south_west{glm::dvec3(-1, 0, 0), {0, 0, -1}, {1, 0, 0}, {0, 0, 1}};

// Integrates f over the hemisphere's solid angle, with Gauss-Legendre's three by two points in each cell.
template <class Function>
auto integral(const Function& f) {
  using Value = decltype(f(glm::dvec3()));
  constexpr std::array<double, 3> point{0.1127016653792583, 0.5, 0.8872983346207417}, weight{5 / 18.0, 8 / 18.0, 5 / 18.0};
  Value sum(0.0);
  for (int row = 0; row < Sky::rows; ++row)
    for (std::size_t i = 0; i < 3; ++i) {
      const double zenith = (row + point[i]) * row_height;
      Value ring(0.0);
      for (int column = 0; column < Sky::columns; ++column)
        for (const double at : {0.2113248654051871, 0.7886751345948129})
          ring += f(to_sky(zenith, (column + at) * column_width)) / 2.0;
      sum += ring * weight[i] * std::sin(zenith) * row_height * column_width;
    }
  return sum;
}

inline double irradiance(const Sky& sky, const glm::dvec3& normal) {
  return integral([&](const glm::dvec3& d) { return sky.radiance(d) * std::max(0.0, glm::dot(normal, d)); });
}

inline double zenith_radiance(const Sky& sky) {
  double sum = 0.0;
  for (int column = 0; column < Sky::columns; ++column) sum += sky.radiance(to_sky(1e-3, (column + 0.5) * column_width));
  return sum / Sky::columns;
}

inline SkyModel general(int type) {
  return {SkyKind::general, type, 0.0, 0.0, {}};
}
inline SkyModel all_weather_model(double dni, double dhi) {
  return {SkyKind::all_weather, 12, dni, dhi, {}};
}

inline std::vector<std::pair<SkyModel, SunPosition>> many_skies() {
  std::vector<std::pair<SkyModel, SunPosition>> skies{{{SkyKind::uniform, 1, 0, 0, {}}, paper_sun},
                                                      {{SkyKind::overcast, 1, 0, 0, {}}, paper_sun}};
  for (int type = 1; type <= 15; ++type) skies.emplace_back(general(type), type % 2 == 0 ? paper_sun : low_sun);
  for (const auto& [dni, dhi] : {std::pair(850.0, 100.0), {400.0, 250.0}, {5.0, 300.0}, {900.0, 40.0}})
    skies.emplace_back(all_weather_model(dni, dhi), paper_sun);
  skies.emplace_back(all_weather_model(700.0, 60.0), SunPosition{90.0 * degree, 0.0});
  skies.emplace_back(all_weather_model(200.0, 30.0), SunPosition{3.0 * degree, 359.0 * degree});
  return skies;
}

}  // namespace sunfleck::test
