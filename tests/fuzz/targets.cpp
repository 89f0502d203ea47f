#include "fuzz/targets.h"

#include "files/formats/caribu/caribu_reader.h"
#include "files/formats/caribu/light_reader.h"
#include "files/formats/measured/measured_reader.h"
#include "files/formats/measured/plant_positions.h"
#include "files/formats/mesh/mesh_reader.h"
#include "files/formats/spectra/spectrum_reader.h"
#include "files/formats/weather/weather_reader.h"
#include "files/results/stores/result_store.h"
#include "files/scene/scene_reader.h"
#include "fuzz/support.h"

#include <array>
#include <cmath>
#include <limits>

namespace sunfleck::fuzz {

void feed_step(std::string_view bytes);
void feed_step_settings(std::string_view bytes);
void feed_run_state(std::string_view bytes);

namespace {

void check_mesh(const Mesh& mesh) {
  const std::size_t triangles = mesh.triangles.size();
  promise(triangles > 0 && mesh.optics_of.size() == triangles && mesh.organ_of.size() == triangles, "arrays of one length");
  for (std::size_t t = 0; t < triangles; ++t) {
    for (int k = 0; k < 3; ++k) promise(mesh.triangles[t][k] < mesh.vertices.size(), "vertex numbers in range");
    promise(mesh.optics_of[t] < mesh.optics_names.size() && mesh.organ_of[t] < mesh.organs.size(), "names in range");
  }
  for (const glm::dvec3& v : mesh.vertices) promise(std::isfinite(v.x + v.y + v.z), "finite positions");
}

template <int Number>
void feed_mesh(std::string_view bytes) {
  static constexpr std::array names{"a.gltf", "a.glb", "a.obj", "a.ply", "a.stl", "a.can", "a.can.gz", "a.dae", "a.opf"};
  const std::filesystem::path file = write(names[Number], bytes);
  read_or_refuse([&] { check_mesh(read_mesh(file, {.optics = "leaf", .up = std::nullopt, .split = OrganSplit::parts})); });
}

void check_scene(const Scene& scene) {
  const Canopy& canopy = scene.model.canopy;
  for (std::size_t e = 0; e < canopy.size(); ++e) {
    for (const glm::vec3& corner : canopy.corners[e]) promise(std::isfinite(corner.x + corner.y + corner.z), "finite corners");
    promise(canopy.optics_of[e] < scene.model.optics.size() && canopy.organ_of[e] < canopy.organs.size(), "names in range");
  }
  for (const SurfaceOptics& optics : scene.model.optics)
    promise(optics.upper.size() == scene.light.bands.size() && optics.lower.size() == optics.upper.size(), "optics by band");
}

void feed_scene(std::string_view bytes) {
  // Generating stands takes long; their few keys are tested elsewhere.
  if (bytes.find("maize") != bytes.npos) return;
  const std::filesystem::path file = write("scene.toml", bytes);
  for (const ScenePurpose purpose : {ScenePurpose::moment, ScenePurpose::day})
    read_or_refuse([&] { check_scene(read_scene(file, {.allow_outside = false, .purpose = purpose})); });
}

void feed_lights(std::string_view bytes) {
  read_or_refuse([&] {
    for (const SkyLight& light : read_lights(write("a.light", bytes)))
      promise(light.weight >= 0.0 && light.to_sky.y > 0.0 && std::isfinite(light.weight), "lights above the horizon");
  });
}

void feed_opt(std::string_view bytes) {
  read_or_refuse([&] {
    const CaribuOptics optics = read_opt(write("a.opt", bytes));
    const auto share = [](double value) { return value >= 0.0 && value <= 1.0; };
    promise(!optics.species.empty() && optics.species.size() <= most_species && share(optics.soil_reflectance),
            "species and soil");
    for (const SpeciesOptics& species : optics.species) {
      promise(share(species.stem_reflectance), "a stem's share");
      for (const FaceOptics& face : {species.upper, species.lower})
        promise(share(face.reflectance) && share(face.transmittance) && face.absorptance() > -1e-9, "shares of a leaf");
    }
  });
}

void feed_domain(std::string_view bytes) {
  read_or_refuse([&] {
    const CaribuDomain domain = read_domain(write("a.8", bytes));
    promise(domain.x_min < domain.x_max && domain.y_min < domain.y_max, "a rectangle");
    promise(std::isfinite(domain.x_min) && std::isfinite(domain.x_max), "finite borders");
  });
}

void check_weather(const Weather& weather) {
  promise(!weather.intervals.empty(), "at least one interval");
  for (const WeatherInterval& interval : weather.intervals)
    promise(interval.length_s > 0.0 && std::isfinite(interval.length_s), "an interval's length");
}

void feed_station(std::string_view bytes) {
  read_or_refuse([&] { check_weather(read_weather(write("a.csv", bytes)).weather); });
}

void feed_epw(std::string_view bytes) {
  read_or_refuse([&] { check_weather(read_weather(write("a.epw", bytes)).weather); });
}

void feed_measured(std::string_view bytes) {
  read_or_refuse([&] {
    for (const MeasuredRatio& point : read_measured(write("field.csv", bytes)).points)
      promise(point.height_m >= 0.0 && point.sunfleck_ratio >= 0.0 && point.sunfleck_ratio <= 1.0, "ratios in 0..1");
  });
}

void check_spectrum(const Spectrum& spectrum, double most) {
  promise(spectrum.values.size() == spectrum.wavelength_nm.size() && spectrum.values.size() > 1, "at least two values");
  for (std::size_t k = 0; k < spectrum.values.size(); ++k) {
    promise(spectrum.values[k] >= 0.0 && spectrum.values[k] <= most, "values in range");
    promise(k == 0 || spectrum.wavelength_nm[k] > spectrum.wavelength_nm[k - 1], "ascending wavelengths");
  }
}

void feed_spectrum(std::string_view bytes) {
  const std::filesystem::path file = write("leaf.csv", bytes);
  read_or_refuse([&] { check_spectrum(read_surface_spectra(file).reflectance, 1.0 + 1e-6); });
  read_or_refuse([&] { check_spectrum(read_light_spectrum(file), std::numeric_limits<double>::max()); });
}

void feed_positions(std::string_view bytes) {
  read_or_refuse([&] {
    for (const PlantPosition& position : read_plant_positions(write("plants.csv", bytes)))
      promise(std::isfinite(position.x_m + position.y_m + position.z_m) && position.scale > 0.0, "places and sizes");
  });
}

void feed_pictures(std::string_view bytes) {
  read_or_refuse([&] {
    const StoredResult stored = read_result_store(write(result_store_file, bytes));
    promise(stored.result.elements.size() == stored.scene.model.canopy.size(), "a result for each element");
  });
}

constexpr std::array all_targets{
    Target{"scene", feed_scene},         Target{"gltf", feed_mesh<0>},   Target{"glb", feed_mesh<1>},
    Target{"obj", feed_mesh<2>},         Target{"ply", feed_mesh<3>},    Target{"stl", feed_mesh<4>},
    Target{"can", feed_mesh<5>},         Target{"can_gz", feed_mesh<6>}, Target{"lights", feed_lights},
    Target{"station", feed_station},     Target{"epw", feed_epw},        Target{"measured", feed_measured},
    Target{"pictures", feed_pictures},   Target{"step", feed_step},      Target{"step_settings", feed_step_settings},
    Target{"spectrum", feed_spectrum},   Target{"dae", feed_mesh<7>},    Target{"opf", feed_mesh<8>},
    Target{"positions", feed_positions}, Target{"opt", feed_opt},        Target{"domain", feed_domain},
    Target{"run_state", feed_run_state}};

}  // namespace

std::span<const Target> targets() {
  return all_targets;
}

}  // namespace sunfleck::fuzz
