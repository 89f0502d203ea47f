#include "programs/validate/light_cases.h"

#include "physics/light/sky.h"
#include "programs/validate/known/case_scenes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

namespace sunfleck {
namespace {

using std::numbers::pi;
constexpr std::array<const char*, 4> quarters = {"north", "east", "south", "west"};

glm::dvec3 towards_sky(double zenith_rad, double azimuth_rad) {
  return {-std::sin(zenith_rad) * std::cos(azimuth_rad), std::cos(zenith_rad), -std::sin(zenith_rad) * std::sin(azimuth_rad)};
}

// Integrates radiance times f over the hemisphere with Gauss-Legendre quadrature, three by two points in each of the sky's
// cells.
template <class Value, class Function>
Value sky_integral(const Sky& sky, const Function& f) {
  constexpr std::array point{0.1127016653792583, 0.5, 0.8872983346207417};
  constexpr std::array weight{5 / 18.0, 8 / 18.0, 5 / 18.0};
  constexpr double row_rad = pi / 2.0 / Sky::rows, column_rad = 2.0 * pi / Sky::columns;
  Value sum(0.0);
  for (int row = 0; row < Sky::rows; ++row)
    for (std::size_t i = 0; i < point.size(); ++i) {
      const double zenith = (row + point[i]) * row_rad;
      for (int column = 0; column < Sky::columns; ++column)
        for (const double at : {0.2113248654051871, 0.7886751345948129}) {
          const glm::dvec3 d = towards_sky(zenith, (column + at) * column_rad);
          sum += f(d) * (0.5 * sky.radiance(d) * weight[i] * std::sin(zenith) * row_rad * column_rad);
        }
    }
  return sum;
}

double on_plane(const Sky& sky, double tilt_rad) {
  const glm::dvec3 normal = towards_sky(tilt_rad, 1.0);
  return sky_integral<double>(sky, [&](const glm::dvec3& d) { return std::max(0.0, glm::dot(normal, d)); });
}

// Returns the irradiance of walls facing north, east, south, west.
glm::dvec4 on_walls(const Sky& sky) {
  return sky_integral<glm::dvec4>(sky, [](const glm::dvec3& d) { return glm::max(glm::dvec4(-d.x, -d.z, d.x, d.z), 0.0); });
}

double zenith_radiance(const Sky& sky) {
  double sum = 0.0;
  for (int column = 0; column < Sky::columns; ++column)
    sum += sky.radiance(towards_sky(1e-3, (column + 0.5) * 2.0 * pi / Sky::columns));
  return sum / Sky::columns;
}

// A sky of cells matches the models' values on planes to 3e-4; a plane's own horizon cuts through cells.
constexpr double cells = 3e-4;

void compare_walls(CaseBench& bench, const std::string& name, const Sky& sky, const std::array<double, 4>& expected) {
  const glm::dvec4 got = on_walls(sky);
  int worst = 0;
  for (int side = 1; side < 4; ++side) {
    if (std::abs(got[side] - expected[static_cast<std::size_t>(side)]) >
        std::abs(got[worst] - expected[static_cast<std::size_t>(worst)]))
      worst = side;
  }
  const double value = expected[static_cast<std::size_t>(worst)];
  bench.equal(fmt::format("{}, the worst of four walls: {}", name, quarters[static_cast<std::size_t>(worst)]), got[worst],
              value, cells * value);
}

SkyModel general_sky(int type) {
  return {.kind = SkyKind::general, .cie_type = type};
}
SkyModel perez_sky(double dhi, double dni) {
  return {.kind = SkyKind::all_weather, .dni_w_m2 = dni, .dhi_w_m2 = dhi};
}

struct StandardSky {
  int type;
  double horizontal_by_zenith;
  std::array<double, 4> walls;
};

// ISO 15469:2004, by quadrature over 400 x 1440 directions with the sun of Beijing: horizontal irradiance over zenith radiance.
constexpr std::array standard_skies = {StandardSky{1, 2.44954, {0.37918, 0.37918, 0.37918, 0.37918}},
                                       StandardSky{3, 2.76999, {0.44665, 0.44665, 0.44665, 0.44665}},
                                       StandardSky{4, 2.47889, {0.33892, 0.49337, 0.44326, 0.31672}},
                                       StandardSky{6, 2.77633, {0.37873, 0.54707, 0.49244, 0.35456}},
                                       StandardSky{7, 2.77107, {0.31939, 0.56812, 0.48199, 0.29284}},
                                       StandardSky{9, 3.74645, {0.48345, 0.68693, 0.62086, 0.45429}},
                                       StandardSky{10, 3.68132, {0.41112, 0.70070, 0.60015, 0.38067}},
                                       StandardSky{11, 3.67380, {0.34370, 0.71249, 0.58119, 0.31042}},
                                       StandardSky{12, 3.94219, {0.39034, 0.78120, 0.64176, 0.35554}},
                                       StandardSky{14, 4.15311, {0.38965, 0.89532, 0.71540, 0.34382}}};

// Perez, Seals and Michalsky 1993: zenith radiance over horizontal irradiance, and the walls, by the same quadrature.
struct PerezSky {
  double dhi, dni, zenith;
  std::array<double, 4> walls;
};
constexpr std::array perez_skies = {PerezSky{100, 850, 0.21815, {0.43355, 0.80890, 0.66418, 0.41844}},
                                    PerezSky{250, 400, 0.26241, {0.31613, 0.69144, 0.55646, 0.28457}},
                                    PerezSky{300, 5, 0.37293, {0.39093, 0.47206, 0.44760, 0.37611}}};

}  // namespace

void sky_integral_cases(CaseBench& bench) {
  const Sky uniform({.kind = SkyKind::uniform}, {});
  const Sky overcast({.kind = SkyKind::overcast}, {});
  bench.equal("uniform, on the horizontal", on_plane(uniform, 0.0), 1.0);
  bench.equal("overcast, on the horizontal", on_plane(overcast, 0.0), 1.0);
  bench.equal("overcast, zenith radiance 9 / (7 pi)", zenith_radiance(overcast), 9.0 / (7.0 * pi), cells * 0.41);
  for (const double tilt_deg : {60.0, 90.0, 150.0}) {
    const double tilt = tilt_deg * degree;
    const double seen = 0.5 * (1.0 + std::cos(tilt));
    // Moon and Spencer 1942: (1 + 2 cos theta) / 3 of the zenith's radiance.
    const double under_overcast = 3.0 / 7.0 * seen + 4.0 / (7.0 * pi) * ((pi - tilt) * std::cos(tilt) + std::sin(tilt));
    bench.equal(fmt::format("uniform, on a plane tilted by {:g} degrees", tilt_deg), on_plane(uniform, tilt), seen,
                cells * seen);
    bench.equal(fmt::format("overcast, on a plane tilted by {:g} degrees", tilt_deg), on_plane(overcast, tilt), under_overcast,
                4e-5);
  }
  for (const StandardSky& each : standard_skies) {
    const Sky sky(general_sky(each.type), beijing_sun());
    const std::string name = fmt::format("CIE type {}", each.type);
    bench.equal(name + ", horizontal over zenith", 1.0 / zenith_radiance(sky), each.horizontal_by_zenith,
                cells * each.horizontal_by_zenith);
    compare_walls(bench, name, sky, each.walls);
  }
  for (const PerezSky& each : perez_skies) {
    const Sky sky(perez_sky(each.dhi, each.dni), beijing_sun());
    const std::string name = fmt::format("Perez, DHI {:g} and DNI {:g} W m-2", each.dhi, each.dni);
    bench.equal(name + ", zenith radiance", zenith_radiance(sky), each.zenith, cells * each.zenith);
    compare_walls(bench, name, sky, each.walls);
  }
}

// The two faces of a vertical square above black ground together receive what the two walls in the tables receive.
void sky_light_cases(CaseBench& bench) {
  struct Row {
    const char* name;
    SkyModel sky;
    std::array<double, 4> walls;
  };
  const std::array rows = {Row{"uniform", {.kind = SkyKind::uniform}, {0.5, 0.5, 0.5, 0.5}},
                           Row{"overcast", {.kind = SkyKind::overcast}, {0.396177, 0.396177, 0.396177, 0.396177}},
                           Row{"CIE type 12", general_sky(12), {0.39034, 0.78120, 0.64176, 0.35554}},
                           Row{"Perez, clear", perez_sky(100, 850), {0.43355, 0.80890, 0.66418, 0.41844}}};
  const std::array normals = {glm::dvec3(-1, 0, 0), glm::dvec3(0, 0, -1)};
  for (const Row& row : rows) {
    for (const std::size_t pair : {0U, 1U}) {
      MeshMaker mesh;
      mesh.polygon({0.05, 0.08, 0.05}, normals[pair], 0.01, 4);
      RadiationModel model = black_model(mesh.mesh(), {0.1, 0.1, false}, beijing_sun());
      shine_from_sky(model, row.sky);
      const RadiationResult result = bench.simulate(model, case_work(model, 1.0, 16384));
      const double both = row.walls[pair] + row.walls[pair + 2];
      bench.compare(fmt::format("{}, upright square facing {} and {}", row.name, quarters[pair], quarters[pair + 2]),
                    result.organs[0].indirect[0], both, {.largest_error = 0.004, .tolerance = cells * both});
    }
  }
}

}  // namespace sunfleck
