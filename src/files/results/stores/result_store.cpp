#include "files/results/stores/result_store.h"

#include "base/file.h"
#include "base/packed_array.h"
#include "physics/transport/model/counters.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>

namespace sunfleck {
namespace {

using nlohmann::json;

constexpr const char* store_format = "sunfleck pictures";
constexpr int store_version = 1;

// Largest coordinate of a scene, such as a mesh of up to 1e7 m, turned and placed as far from zero.
constexpr double farthest_m = 1e8;
constexpr double most_patches = 64e6;
constexpr std::size_t deepest = 6;  // nesting depth of lists and maps; a valid file has four levels

[[noreturn]] void refuse(const std::string& why) {
  throw std::runtime_error(why);
}

void require(bool good, const char* what) {
  if (!good) refuse(fmt::format("{} is out of range", what));
}

json vector_json(const glm::dvec3& v) {
  return {v.x, v.y, v.z};
}

json faces_json(const std::vector<FaceOptics>& faces) {
  json list = json::array();
  for (const FaceOptics& face : faces) list.push_back({face.reflectance, face.transmittance});
  return list;
}

json model_json(const RadiationModel& model) {
  json bands = json::array();
  for (const Waveband& band : model.bands) {
    bands.push_back({{"name", band.name}, {"direct_w_m2", band.direct_w_m2}, {"diffuse_w_m2", band.diffuse_w_m2}});
  }
  json optics = json::array();
  for (const SurfaceOptics& surface : model.optics) {
    optics.push_back({{"name", surface.name},
                      {"upper", faces_json(surface.upper)},
                      {"lower", faces_json(surface.lower)},
                      {"rgb", vector_json(surface.rgb)},
                      {"emission_w_m2", surface.emission_w_m2}});
  }
  json organs = json::array();
  for (const Organ& organ : model.canopy.organs) organs.push_back({organ.plant, organ.name, organ.rank});
  json sun = nullptr;
  if (model.sun) sun = {{"elevation_rad", model.sun->elevation_rad}, {"azimuth_rad", model.sun->azimuth_rad}};
  json soil = nullptr;
  if (model.soil) {
    soil = {{"reflectance", model.soil->reflectance}, {"patch_m", model.soil->patch_m}, {"rgb", vector_json(model.soil->rgb)}};
  }
  const Canopy& canopy = model.canopy;
  return {{"plot", {{"size_x_m", model.plot.size_x_m}, {"size_z_m", model.plot.size_z_m}, {"periodic", model.plot.periodic}}},
          {"bands", bands},
          {"optics", optics},
          {"organs", organs},
          {"sun", sun},
          {"sky", model.sky.has_value()},
          {"soil", soil},
          {"layers", model.layers},
          {"triangles", canopy.size()},
          {"origin_m", vector_json(canopy.origin_m)},
          {"period_m", {canopy.period_m.x, canopy.period_m.y}},
          {"corners_m", pack(canopy.corners)},
          {"organ_of", pack(canopy.organ_of)},
          {"optics_of", pack(canopy.optics_of)}};
}

json error_json(const std::optional<double>& error) {
  return error ? json(*error) : json(nullptr);
}

json result_json(const RadiationResult& result) {
  return {{"leaf_area_index", result.leaf_area_index},
          {"ground_per_ray_m2", result.ground_per_ray_m2},
          {"w_per_quantum", result.w_per_quantum},
          {"rays", result.direct.rays},
          {"direct_error", error_json(result.direct.relative_error)},
          {"packets", result.indirect.packets},
          {"sky_rays", result.indirect.sky_rays},
          {"indirect_error", error_json(result.indirect.relative_error)},
          {"landings", pack(result.elements)},
          {"cells", result.soil_cells.size()},
          {"cell_landings", pack(result.soil_cells)},
          {"has_indirect", !result.side_indirect.empty() || !result.cell_indirect.empty()},
          {"side_indirect", pack(result.side_indirect)},
          {"cell_indirect", pack(result.cell_indirect)},
          {"has_sky", !result.side_sky.empty() || !result.cell_sky.empty()},
          {"side_sky", pack(result.side_sky)},
          {"cell_sky", pack(result.cell_sky)}};
}

// Returns a finite number in lo..hi.
double number(const json& object, const char* key, double lo, double hi) {
  const auto value = object.at(key).get<double>();
  require(value >= lo && value <= hi, key);
  return value;
}

std::vector<double> numbers(const json& list, std::size_t count, double lo, double hi, const char* what) {
  auto values = list.get<std::vector<double>>();
  require(values.size() == count, what);
  for (const double value : values) require(value >= lo && value <= hi, what);
  return values;
}

glm::dvec3 vector_of(const json& object, const char* key, double largest) {
  const std::vector<double> v = numbers(object.at(key), 3, -largest, largest, key);
  return {v[0], v[1], v[2]};
}

std::vector<FaceOptics> faces_of(const json& list, std::size_t bands) {
  require(list.size() == bands, "optics");
  std::vector<FaceOptics> faces;
  for (const json& face : list) {
    const std::vector<double> both = numbers(face, 2, 0.0, 1.0, "optics");
    faces.push_back({both[0], both[1]});
  }
  return faces;
}

void read_surfaces(const json& from, RadiationModel& model) {
  constexpr double brightest_w_m2 = 1e15;
  for (const json& band : from.at("bands")) {
    model.bands.push_back({band.at("name").get<std::string>(), number(band, "direct_w_m2", 0.0, brightest_w_m2),
                           number(band, "diffuse_w_m2", 0.0, brightest_w_m2)});
  }
  const std::size_t bands = model.bands.size();
  require(bands > 0, "bands");
  for (const json& surface : from.at("optics")) {
    SurfaceOptics optics;
    optics.name = surface.at("name").get<std::string>();
    optics.upper = faces_of(surface.at("upper"), bands);
    optics.lower = faces_of(surface.at("lower"), bands);
    optics.rgb = vector_of(surface, "rgb", 1.0);
    const json& emission = surface.at("emission_w_m2");
    if (!emission.empty()) optics.emission_w_m2 = numbers(emission, bands, 0.0, brightest_w_m2, "emission_w_m2");
    model.canopy.optics_names.push_back(optics.name);
    model.optics.push_back(std::move(optics));
  }
  if (from.at("soil").is_null()) return;
  const json& soil = from["soil"];
  model.soil = Soil{numbers(soil.at("reflectance"), bands, 0.0, 1.0, "soil"), number(soil, "patch_m", 0.0, farthest_m),
                    vector_of(soil, "rgb", 1.0)};
  const Plot& ground = model.plot;
  require(std::ceil(ground.size_x_m / model.soil->patch_m) * std::ceil(ground.size_z_m / model.soil->patch_m) <= most_patches,
          "patch_m");
}

void read_canopy(const json& from, Canopy& canopy, std::size_t optics) {
  for (const json& organ : from.at("organs")) {
    canopy.organs.push_back({whole<std::uint32_t>(organ.at(0)), organ.at(1).get<std::string>(), whole<int>(organ.at(2))});
  }
  const auto triangles = whole<std::size_t>(from.at("triangles"));
  canopy.origin_m = vector_of(from, "origin_m", farthest_m);
  const std::vector<double> period_m = numbers(from.at("period_m"), 2, 0.0, farthest_m, "period_m");
  canopy.period_m = {period_m[0], period_m[1]};
  canopy.corners = unpack<Triangle>(from.at("corners_m"), triangles);
  canopy.organ_of = unpack<std::uint32_t>(from.at("organ_of"), triangles);
  canopy.optics_of = unpack<std::uint16_t>(from.at("optics_of"), triangles);
  for (const Triangle& corners : canopy.corners) {
    for (const glm::vec3& corner : corners) {
      for (int i = 0; i < 3; ++i) require(std::abs(corner[i]) <= farthest_m, "corners_m");
    }
  }
  for (const std::uint32_t organ : canopy.organ_of) require(organ < canopy.organs.size(), "organ_of");
  for (const std::uint16_t number : canopy.optics_of) require(number < optics, "optics_of");
}

RadiationModel read_model(const json& from) {
  constexpr double least_m = 1e-6;
  constexpr int most_layers = 100000;
  RadiationModel model;
  const json& plot = from.at("plot");
  model.plot = {number(plot, "size_x_m", least_m, farthest_m), number(plot, "size_z_m", least_m, farthest_m),
                plot.at("periodic").get<bool>()};
  model.layers = static_cast<int>(number(from, "layers", 1, most_layers));
  if (!from.at("sun").is_null()) {
    constexpr double most_rad = 7.0;  // more than a full turn
    const json& sun = from["sun"];
    model.sun = SunPosition{number(sun, "elevation_rad", -most_rad, most_rad), number(sun, "azimuth_rad", -most_rad, most_rad)};
  }
  if (from.at("sky").get<bool>()) model.sky = SkyModel{};
  read_surfaces(from, model);
  read_canopy(from, model.canopy, model.optics.size());
  const bool has_period = model.canopy.period_m.x > 0.0 && model.canopy.period_m.y > 0.0;
  require(has_period || !model.plot.periodic || model.canopy.size() == 0, "period_m");
  return model;
}

std::optional<double> error_of(const json& object, const char* key) {
  return object.at(key).is_null() ? std::nullopt : std::optional(object[key].get<double>());
}

RadiationResult read_result(const json& from, const RadiationModel& model) {
  constexpr double largest = 1e30;
  RadiationResult result;
  result.leaf_area_index = number(from, "leaf_area_index", 0.0, largest);
  result.ground_per_ray_m2 = number(from, "ground_per_ray_m2", 0.0, largest);
  const std::size_t elements = model.canopy.size();
  const auto cells = whole<std::size_t>(from.at("cells"));
  require(cells == make_counter_layout(model).cells(), "cells");
  result.direct.rays = whole<std::uint64_t>(from.at("rays"));
  result.direct.relative_error = error_of(from, "direct_error");
  result.indirect.packets = whole<std::uint64_t>(from.at("packets"));
  if (from.contains("sky_rays")) result.indirect.sky_rays = whole<std::uint64_t>(from["sky_rays"]);
  result.indirect.relative_error = error_of(from, "indirect_error");
  result.elements = unpack<BeamLandings>(from.at("landings"), elements);
  result.soil_cells = unpack<std::uint64_t>(from.at("cell_landings"), cells);
  const auto quanta = [&](const char* key, bool there, std::size_t places) {
    return unpack<std::int64_t>(from.at(key), there ? places * model.bands.size() : 0);
  };
  const bool indirect = from.at("has_indirect").get<bool>();
  const bool sky = from.at("has_sky").get<bool>();
  result.side_indirect = quanta("side_indirect", indirect, 2 * elements);
  result.cell_indirect = quanta("cell_indirect", indirect, cells);
  result.side_sky = quanta("side_sky", sky, 2 * elements);
  result.cell_sky = quanta("cell_sky", sky, cells);
  const json& w_per_quantum = from.at("w_per_quantum");
  require(!w_per_quantum.empty() || (!indirect && !sky), "w_per_quantum");
  if (!w_per_quantum.empty()) {
    result.w_per_quantum = numbers(w_per_quantum, model.bands.size(), 0.0, largest, "w_per_quantum");
  }
  return result;
}

StoredResult read_checked(const std::string& bytes) {
  const json file = read_cbor(bytes, deepest);
  if (file.at("format") != store_format) refuse("it is a different kind of file");
  const int version = whole<int>(file.at("version"));
  if (version != store_version)
    refuse(fmt::format("it has version {}, but this program reads version {}", version, store_version));
  StoredResult stored;
  stored.seed = whole<std::uint64_t>(file.at("seed"));
  stored.complete = file.at("complete").get<bool>();
  Scene& scene = stored.scene;
  scene.title = file.at("title").get<std::string>();
  scene.digest = file.at("scene_digest").get<std::string>();
  scene.model = read_model(file.at("model"));
  if (!file.at("camera").is_null()) {
    constexpr double widest_rad = 3.1;
    const json& camera = file["camera"];
    scene.camera = CameraPose{vector_of(camera, "position_m", farthest_m), vector_of(camera, "look_at_m", farthest_m),
                              number(camera, "fov_rad", 1e-6, widest_rad)};
    require(scene.camera->position_m != scene.camera->look_at_m, "camera");
  }
  stored.result = read_result(file.at("result"), scene.model);
  return stored;
}

}  // namespace

void write_result_store(const std::filesystem::path& file, const RunRecord& record, const Scene& scene,
                        const RadiationResult& result) {
  json camera = nullptr;
  if (scene.camera) {
    camera = {{"position_m", vector_json(scene.camera->position_m)},
              {"look_at_m", vector_json(scene.camera->look_at_m)},
              {"fov_rad", scene.camera->fov_rad}};
  }
  const json store = {
      {"format", store_format},           {"version", store_version},     {"sunfleck", record.version},  {"title", scene.title},
      {"scene_digest", scene.digest},     {"seed", record.seed},          {"complete", record.complete}, {"camera", camera},
      {"model", model_json(scene.model)}, {"result", result_json(result)}};
  std::string bytes;
  json::to_cbor(store, bytes);
  write_file(file, bytes);
}

StoredResult read_result_store(const std::filesystem::path& file) {
  return parse_result_store(read_file(file), file);
}

StoredResult parse_result_store(const std::string& bytes, const std::filesystem::path& file) {
  const auto fail = [&](const std::string& why) {
    throw_input(fmt::format("{}: cannot be used to draw pictures", printable(file.string())), printable(why),
                "run its scene again");
  };
  try {
    StoredResult stored = read_checked(bytes);
    stored.scene.file = file;
    return stored;
  } catch (const json::exception& error) {
    fail(fmt::format("it is damaged: {}", error.what()));
  } catch (const std::runtime_error& error) {
    fail(error.what());
  }
  return {};
}

}  // namespace sunfleck
