#include "programs/python/light.h"

#include "base/error.h"
#include "base/random.h"
#include "base/units.h"
#include "files/scene/scene_reader.h"
#include "physics/light/sky.h"
#include "physics/light/sun.h"
#include "programs/python/arrays.h"

#include <pybind11/numpy.h>

#include <string>
#include <utility>

namespace sunfleck {
namespace {

namespace py = pybind11;

// Converts seconds since 1970-01-01 UTC to elevation and azimuth in degrees.
std::pair<double, double> sun_position_deg(double unix_s, double latitude_deg, double longitude_deg, double altitude_m) {
  const UtcTime time = plus_seconds({.year = 1970}, unix_s);
  const SunPosition sun = sun_position(time, {latitude_deg * degree, longitude_deg * degree, altitude_m});
  return {in_degrees(sun.elevation_rad), in_degrees(sun.azimuth_rad)};
}

// Returns the sky of a scene's text at its own moment, with horizontal irradiance 1.
Sky sky_of(const std::string& file, const std::string& text, bool allow_outside) {
  const Scene scene = read_scene(SceneText{file, text, {}}, {.allow_outside = allow_outside});
  if (!scene.model.sky) throw_input("sky", "the scene has no sky", "add [sky] with a model");
  return {*scene.model.sky, scene.model.sun};
}

py::array radiance(const Sky& sky, const Doubles& elevation_deg, const Doubles& azimuth_deg) {
  std::vector<double> values(static_cast<std::size_t>(elevation_deg.size()));
  const double* elevation = elevation_deg.data();
  const double* azimuth = azimuth_deg.data();
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = sky.radiance(direction_to_sun({elevation[i] * degree, azimuth[i] * degree}));
  return array_of(std::move(values));
}

// Returns directions [n][3] drawn with density radiance times cosine, one from each n-th of the distribution of zenith angles.
py::array draw(const Sky& sky, std::size_t count, std::uint64_t seed) {
  std::vector<double> directions;
  directions.reserve(3 * count);
  for (std::size_t i = 0; i < count; ++i) {
    RandomStream random(seed, i);
    const double u = (static_cast<double>(i) + random.unit()) / static_cast<double>(count);
    const glm::dvec3 to_sky = sky.draw_by_horizontal_irradiance(u, random.unit());
    directions.insert(directions.end(), {to_sky.x, to_sky.y, to_sky.z});
  }
  return array_of(std::move(directions), {static_cast<py::ssize_t>(count), 3});
}

py::list lights(const Sky& sky) {
  py::list list;
  for (const SkyLight& light : sky.lights())
    list.append(py::make_tuple(light.weight, py::make_tuple(light.to_sky.x, light.to_sky.y, light.to_sky.z)));
  return list;
}

}  // namespace

void bind_light(py::module_& module) {
  module.def("sun_position", &sun_position_deg);
  py::class_<Sky>(module, "Sky")
      .def(py::init(&sky_of))
      .def("radiance", &radiance)
      .def("draw", &draw)
      .def("lights", &lights)
      .def_property_readonly("is_list", &Sky::is_list)
      .def_property_readonly("spherical_irradiance", &Sky::spherical_irradiance);
}

}  // namespace sunfleck
