#include "programs/cli/convert.h"

#include "base/error.h"
#include "base/file.h"
#include "base/log.h"
#include "base/text.h"
#include "files/formats/mesh/mesh_reader.h"
#include "files/formats/mesh/mesh_text.h"
#include "files/formats/mesh/mesh_writer.h"
#include "physics/canopy/axes.h"
#include "programs/cli/terminal.h"
#include "simulate/interrupt.h"
#include "simulate/scene_source.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <meshoptimizer.h>

#include <algorithm>
#include <optional>
#include <system_error>

namespace sunfleck {

namespace {

namespace fs = std::filesystem;

constexpr const char* default_optics = "leaf";  // for triangles whose mesh names no optics

bool is_scene_file(const fs::path& file) {
  return file.extension() == ".toml";
}

std::vector<fs::path> inputs(const ConvertOptions& options) {
  std::vector<fs::path> files{options.input, options.stand.light, options.stand.domain};
  for (const std::string& word : options.stand.optics) files.push_back(caribu_band(word).file);
  return files;
}

void check(const ConvertOptions& options) {
  const std::string in = printable(options.input.string());
  const std::string out = printable(options.output.string());
  const bool to_scene = is_scene_file(options.output);
  if (!is_mesh_file(options.input) && !is_scene_file(options.input))
    throw_input(in, "unknown file ending", fmt::format("give a mesh, {}, or a scene, .toml", readable_meshes));
  if (!to_scene && !is_writable_mesh(options.output))
    throw_input(out, "unknown file ending", fmt::format("use {}, or .toml", writable_meshes));
  if (to_scene && is_scene_file(options.input))
    throw_input(out, "the input and the output are both scene files",
                fmt::format("give the output the ending {}", writable_meshes));
  const std::string option = options.stand.first_given();
  if (!to_scene && !option.empty() && option != "--scale")
    throw_input(option, "a mesh file cannot hold this", "leave it out, or give the output the ending .toml");
  if (is_scene_file(options.input) && options.stand.scale) throw_input("--scale", "a scene is in metres", "leave it out");
  if (options.z_up && (to_scene || is_scene_file(options.input)))
    throw_input("--z-up", "only applies when a mesh is converted to another mesh",
                "leave it out, or write up = \"z\" under [[geometry]] in the scene");
  if (!options.split.empty() && (to_scene || is_scene_file(options.input)))
    throw_input("--split", "only applies when a mesh is converted to another mesh",
                fmt::format("leave it out, or write split = \"{}\" under [[geometry]] in the scene", options.split));
  for (const fs::path& file : inputs(options)) {
    std::error_code error;
    if (!file.empty() && fs::equivalent(file, options.output, error))
      throw_input(out, fmt::format("it is the same file as the input {}", printable(file.string())), "give another name");
  }
}

// Returns the canopy as a mesh in which coincident corners are welded into one vertex, in the scene's axes but with the origin
// of the user's.
Mesh mesh_of(const Canopy& canopy, const Plot& plot) {
  Mesh mesh;
  mesh.optics_of.assign(canopy.optics_of.begin(), canopy.optics_of.end());
  mesh.organ_of = canopy.organ_of;
  mesh.optics_names = canopy.optics_names;
  mesh.organs = canopy.organs;
  mesh.labels = canopy.labels;
  const std::vector<Triangle> triangles = canopy.corners.all();
  const std::size_t corners = 3 * canopy.size();
  std::vector<unsigned> numbers(corners);
  const std::size_t vertices =
      meshopt_generateVertexRemap(numbers.data(), nullptr, corners, triangles.data(), corners, sizeof(glm::vec3));
  mesh.vertices.resize(vertices);
  for (std::size_t e = 0; e < canopy.size(); ++e) {
    const unsigned* number = &numbers[3 * e];
    mesh.triangles.emplace_back(number[0], number[1], number[2]);
    for (std::size_t k = 0; k < 3; ++k) {
      const glm::dvec3 user_m = user_position_m(plot, canopy.origin_m + glm::dvec3(triangles[e][k]));
      mesh.vertices[number[k]] = scene_direction(plot.axes, user_m);
    }
  }
  return mesh;
}

// A mesh to be written, and the axes that its file is to have.
struct MeshToWrite {
  Mesh mesh;
  Axes axes = Axes::south_up_west;
};

MeshToWrite read_input(const ConvertOptions& options) {
  if (!is_scene_file(options.input)) {
    MeshImport import{.optics = default_optics,
                      .up = std::nullopt,
                      .scale = options.stand.scale.value_or(1.0),
                      .allow_outside = options.allow_outside,
                      .keeps_colours = true};
    if (options.z_up) import.up = FileAxis::z;
    const std::vector<std::string>& splits = organ_split_names();
    const auto split = std::find(splits.begin(), splits.end(), options.split);
    if (split != splits.end()) import.split = static_cast<OrganSplit>(split - splits.begin());
    return {read_mesh(options.input, import)};
  }
  const Scene scene = read_scene(options.input, {options.allow_outside});
  for (const std::string& warning : scene.warnings) warn(warning);
  if (scene.model.canopy.size() == 0)
    throw_input(printable(options.input.string()), "the scene has no triangles", "give a scene with a [[geometry]]");
  return {mesh_of(scene.model.canopy, scene.model.plot), scene.model.plot.axes};
}

int write_as_mesh(const ConvertOptions& options) {
  const auto [mesh, axes] = read_input(options);
  if (is_can_file(options.output)) {
    const std::vector<std::string> lost = optics_lost_in_can(mesh);
    if (!lost.empty())
      warn(printable(fmt::format("{}: optics {} become leaves or stems: a .can only has soil, leaf, stem, leaf2, stem2, ...",
                                 options.output.string(), fmt::join(lost, ", "))));
    const std::size_t merged = organs_merged_in_can(mesh);
    if (merged > 0)
      warn(
          fmt::format("{}: {} of {} organs are merged: labels of a .can hold species, plant and leaf number alone; another "
                      "format keeps them apart",
                      printable(options.output.string()), merged, mesh.organs.size()));
  }
  write_mesh(mesh, options.output, axes);
  fmt::print("{}: {}, {}, optics {}\n", options.output.string(), counted(mesh.triangles.size(), "triangle"),
             counted(mesh.organs.size(), "organ"), printable(fmt::format("{}", fmt::join(mesh.optics_names, ", "))));
  return exit_done;
}

// A file that the scene names. It stays where it is if that is within the scene's folder; otherwise it is copied next to the
// scene.
struct NamedFile {
  fs::path from;
  fs::path name;  // as written in the scene
  bool copied = false;
};

NamedFile named_file(const fs::path& folder, const fs::path& file) {
  const fs::path name = name_from(folder, file);
  if (name.is_relative()) return {file, name, false};
  if (file.extension() == ".gltf")
    throw_input(printable(file.string()), "outside the scene's folder, and it may refer to files next to it",
                "write the scene into the folder of this file, or convert the file to .glb first");
  return {file, file.filename(), true};
}

// Returns the bytes to write for the file's copy; none if a file with the same content is already there.
std::optional<std::string> bytes_to_copy(const fs::path& folder, const NamedFile& file) {
  if (!file.copied) return std::nullopt;
  const fs::path to = folder / file.name;
  std::string bytes = read_file(file.from);
  std::error_code error;
  const fs::file_status there = fs::symlink_status(to, error);
  if (!fs::exists(there)) return bytes;
  if (fs::is_regular_file(there) && read_file(to) == bytes) return std::nullopt;
  throw_input(printable(to.string()),
              fmt::format("a different file from {}, which has to be copied here for the scene", printable(file.from.string())),
              "write the scene into another folder");
}

int write_as_scene(const ConvertOptions& options) {
  const fs::path folder = options.output.parent_path();
  const CaribuSet set = caribu_set(options.input, options.stand, options.allow_outside);
  const NamedFile canopy = named_file(folder, set.canopy);
  NamedFile light = named_file(folder, set.light);
  const CaribuScene made = caribu_scene(set, {canopy.name.generic_string(), light.name.generic_string()});
  light.copied = light.copied && made.names_light;
  const std::optional<std::string> canopy_bytes = bytes_to_copy(folder, canopy);
  const std::optional<std::string> light_bytes = bytes_to_copy(folder, light);
  if (canopy_bytes) write_file(folder / canopy.name, *canopy_bytes);
  if (light_bytes) write_file(folder / light.name, *light_bytes);
  const Scene scene = read_scene(SceneText{options.output, made.text, {}}, {options.allow_outside});
  for (const std::string& warning : scene.warnings) warn(warning);
  write_file(options.output, made.text);
  fmt::print("{}: {}, plot {:.6g} x {:.6g} m\n", options.output.string(), counted(scene.model.canopy.size(), "triangle"),
             scene.model.plot.size_x_m, scene.model.plot.size_z_m);
  return exit_done;
}

}  // namespace

int convert(const ConvertOptions& options) {
  start_log(Verbosity::normal);
  exit_on_interrupts();
  check(options);
  return is_scene_file(options.output) ? write_as_scene(options) : write_as_mesh(options);
}

}  // namespace sunfleck
