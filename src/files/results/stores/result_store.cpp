#include "files/results/stores/result_store.h"

#include "base/archive.h"
#include "base/file.h"
#include "physics/transport/model/counters.h"

#include <fmt/format.h>

#include <cmath>
#include <ostream>

namespace sunfleck {
namespace {

using nlohmann::json;

constexpr const char* store_format = "sunfleck pictures";
constexpr int oldest_version = 2, store_version = 3;  // version 2 had no planes of bytes

// Largest coordinate of a scene, such as a mesh of up to 1e7 m, turned and placed as far from zero.
constexpr double farthest_stored_m = 1e8;
constexpr double most_patches = 64e6;
constexpr std::size_t deepest = 6;  // nesting depth of lists and maps; a valid file has four levels
constexpr double brightest_w_m2 = 1e15;

[[noreturn]] void refuse(const std::string& why) {
  throw std::runtime_error(why);
}

void require(bool good, const char* what) {
  if (!good) refuse(fmt::format("{} is out of range", what));
}

// The functions named `visit` describe the content of the file, and serve to write and to read it.

template <class Archive, class Vector>
void visit_vector(const Archive& archive, double largest, Vector& vector) {
  archive.row(-largest, largest, vector.x, vector.y, vector.z);
}

template <class Archive, class Camera>
void visit_camera(const Archive& archive, Camera& camera) {
  constexpr double widest_rad = 3.1;
  visit_vector(archive["position_m"], farthest_stored_m, camera.position_m);
  visit_vector(archive["look_at_m"], farthest_stored_m, camera.look_at_m);
  archive["fov_rad"].value(camera.fov_rad, 1e-6, widest_rad);
}

template <class Archive, class Model>
void visit_surfaces(const Archive& archive, Model& model) {
  archive["bands"].list(model.bands, [](const auto& to, auto& band) {
    to["name"].value(band.name);
    to["direct_w_m2"].value(band.direct_w_m2, 0.0, brightest_w_m2);
    to["diffuse_w_m2"].value(band.diffuse_w_m2, 0.0, brightest_w_m2);
  });
  const auto visit_face = [](const auto& to, auto& face) { to.row(0.0, 1.0, face.reflectance, face.transmittance); };
  archive["optics"].list(model.optics, [&](const auto& to, auto& surface) {
    to["name"].value(surface.name);
    to["upper"].list(surface.upper, visit_face);
    to["lower"].list(surface.lower, visit_face);
    visit_vector(to["rgb"], 1.0, surface.rgb);
    to["emission_w_m2"].value(surface.emission_w_m2, 0.0, brightest_w_m2);
  });
  archive["soil"].part(model.soil, [](const auto& to, auto& soil) {
    to["reflectance"].value(soil.reflectance, 0.0, 1.0);
    to["patch_m"].value(soil.patch_m, 0.0, farthest_stored_m);
    visit_vector(to["rgb"], 1.0, soil.rgb);
  });
}

void visit_corners(const StoreWriter& to, const ElementCorners& corners, std::size_t triangles) {
  const NumberPieces<Triangle> pieces = [&](const std::function<void(std::span<const Triangle>)>& take) {
    constexpr std::size_t at_once = 4096;
    std::vector<Triangle> piece;
    for (const Triangle& triangle : corners) {
      piece.push_back(triangle);
      if (piece.size() < at_once) continue;
      take(piece);
      piece.clear();
    }
    take(piece);
  };
  to.packed(pieces, triangles);
}

void visit_corners(const StoreReader& from, ElementCorners& corners, std::size_t triangles) {
  std::vector<Triangle> all;
  from.packed(all, triangles);
  corners = std::move(all);
}

template <class Archive, class Canopy>
void visit_canopy(const Archive& archive, Canopy& canopy) {
  archive["organs"].list(canopy.organs, [](const auto& to, auto& organ) {
    to[0].value(organ.plant);
    to[1].value(organ.name);
    to[2].value(organ.rank);
  });
  std::size_t triangles = canopy.size();
  archive["triangles"].value(triangles);
  visit_vector(archive["origin_m"], farthest_stored_m, canopy.origin_m);
  archive["period_m"].row(0.0, farthest_stored_m, canopy.period_m.x, canopy.period_m.y);
  visit_corners(archive["corners_m"], canopy.corners, triangles);
  archive["organ_of"].packed(SharedVector<std::uint32_t>::of(canopy.organ_of), triangles);
  archive["optics_of"].packed(SharedVector<std::uint16_t>::of(canopy.optics_of), triangles);
}

template <class Archive, class Model>
void visit_model(const Archive& archive, Model& model) {
  constexpr double least_m = 1e-6;
  constexpr double most_layers = 100000;
  constexpr double most_rad = 7.0;  // more than a full turn
  archive["plot"]["size_x_m"].value(model.plot.size_x_m, least_m, farthest_stored_m);
  archive["plot"]["size_z_m"].value(model.plot.size_z_m, least_m, farthest_stored_m);
  archive["plot"]["periodic"].value(model.plot.periodic);
  auto axes = static_cast<int>(model.plot.axes);
  if (Archive::reads || axes != 0) archive["plot"].recent_value("axes", axes);
  require(axes == 0 || axes == 1, "axes");
  if constexpr (Archive::reads) model.plot.axes = static_cast<Axes>(axes);
  archive["layers"].value(model.layers, 1, most_layers);
  archive["sun"].part(model.sun, [](const auto& to, auto& sun) {
    to["elevation_rad"].value(sun.elevation_rad, -most_rad, most_rad);
    to["azimuth_rad"].value(sun.azimuth_rad, -most_rad, most_rad);
  });
  bool sky = model.sky.has_value();
  archive["sky"].value(sky);
  if constexpr (Archive::reads) {
    if (sky) model.sky.emplace();
  }
  visit_surfaces(archive, model);
  visit_canopy(archive, model.canopy);
}

template <class Archive, class Result>
void visit_result(const Archive& archive, Result& result, const RadiationModel& model) {
  constexpr double largest = 1e30;
  const std::size_t elements = model.canopy.size();
  const std::size_t bands = model.bands.size();
  std::size_t cells = result.soil_cells.size();
  bool indirect = !result.side_indirect.empty() || !result.cell_indirect.empty();
  bool sky = !result.side_sky.empty() || !result.cell_sky.empty();
  bool refined = !result.side_direct.empty();
  archive["leaf_area_index"].value(result.leaf_area_index, 0.0, largest);
  archive["ground_per_ray_m2"].value(result.ground_per_ray_m2, 0.0, largest);
  archive["w_per_quantum"].value(result.w_per_quantum, 0.0, largest);
  archive["rays"].value(result.direct.rays);
  archive["direct_relative_error"].value(result.direct.relative_error);
  archive["packets"].value(result.indirect.packets);
  archive["sky_rays"].value(result.indirect.sky_rays);
  archive["indirect_relative_error"].value(result.indirect.relative_error);
  archive["landings"].packed(result.elements, elements);
  archive["has_side_direct"].value(refined);
  archive["side_direct"].packed(result.side_direct, refined ? 2 * elements : 0);
  archive["triangle_relative_error"].value(result.triangle_relative_error, 0.0, largest);
  archive["cells"].value(cells);
  archive["cell_landings"].packed(result.soil_cells, cells);
  archive["has_indirect"].value(indirect);
  archive["side_indirect"].packed(result.side_indirect, indirect ? 2 * elements * bands : 0);
  archive["cell_indirect"].packed(result.cell_indirect, indirect ? cells * bands : 0);
  archive["has_sky"].value(sky);
  archive["side_sky"].packed(result.side_sky, sky ? 2 * elements * bands : 0);
  archive["cell_sky"].packed(result.cell_sky, sky ? cells * bands : 0);
}

template <class Archive, class Scene, class Result, class Record>
void visit_store(const Archive& archive, Scene& scene, Result& result, Record& record) {
  archive["title"].value(scene.title);
  archive["scene_digest"].value(scene.digest);
  archive["seed"].value(record.seed);
  archive["complete"].value(record.complete);
  archive["camera"].part(scene.camera, [](const auto& to, auto& camera) { visit_camera(to, camera); });
  visit_model(archive["model"], scene.model);
  visit_result(archive["result"], result, scene.model);
}

// The functions named `check` refuse parts that do not fit each other.

void check_surfaces(const RadiationModel& model) {
  const std::size_t bands = model.bands.size();
  require(bands > 0, "bands");
  for (const SurfaceOptics& surface : model.optics) {
    require(surface.upper.size() == bands && surface.lower.size() == bands, "optics");
    require(surface.emission_w_m2.empty() || surface.emission_w_m2.size() == bands, "emission_w_m2");
  }
  if (!model.soil) return;
  require(model.soil->reflectance.size() == bands, "soil");
  const Plot& ground = model.plot;
  require(std::ceil(ground.size_x_m / model.soil->patch_m) * std::ceil(ground.size_z_m / model.soil->patch_m) <= most_patches,
          "patch_m");
}

void check_canopy(const RadiationModel& model) {
  const Canopy& canopy = model.canopy;
  for (const Triangle& corners : canopy.corners) {
    for (const glm::vec3& corner : corners) {
      for (int i = 0; i < 3; ++i) require(std::abs(corner[i]) <= farthest_stored_m, "corners_m");
    }
  }
  for (const std::uint32_t organ : canopy.organ_of) require(organ < canopy.organs.size(), "organ_of");
  for (const std::uint16_t number : canopy.optics_of) require(number < model.optics.size(), "optics_of");
  const bool has_period = canopy.period_m.x > 0.0 && canopy.period_m.y > 0.0;
  require(has_period || !model.plot.periodic || canopy.size() == 0, "period_m");
}

StoredResult read_checked(const std::string& bytes) {
  const json file = read_cbor(bytes, deepest);
  if (file.at("format") != store_format) refuse("it is a different kind of file");
  const int version = whole<int>(file.at("version"));
  if (version < oldest_version || version > store_version) {
    refuse(fmt::format("it has version {}, but this program reads versions {} to {}", version, oldest_version, store_version));
  }
  StoredResult stored;
  visit_store(StoreReader(file), stored.scene, stored.result, stored);
  RadiationModel& model = stored.scene.model;
  check_surfaces(model);
  check_canopy(model);
  for (const SurfaceOptics& surface : model.optics) model.canopy.optics_names.push_back(surface.name);
  const std::optional<CameraPose>& camera = stored.scene.camera;
  require(!camera || camera->position_m != camera->look_at_m, "camera");
  const RadiationResult& result = stored.result;
  require(result.soil_cells.size() == make_counter_layout(model).cells(), "cells");
  const bool counts_quanta =
      !result.side_indirect.empty() || !result.cell_indirect.empty() || !result.side_sky.empty() || !result.cell_sky.empty();
  const std::size_t factors = result.w_per_quantum.size();
  require(factors == model.bands.size() || (factors == 0 && !counts_quanta), "w_per_quantum");
  return stored;
}

}  // namespace

void write_result_store(const std::filesystem::path& file, const RunRecord& record, const Scene& scene,
                        const RadiationResult& result) {
  json store = {{"format", store_format}, {"version", store_version}, {"sunfleck", record.version}};
  visit_store(StoreWriter(store), scene, result, record);
  write_file(file, [&](std::ostream& out) { json::to_cbor(store, out); });
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
