#include "files/formats/mesh/mesh_reader.h"

#include "base/check.h"
#include "base/error.h"
#include "base/file.h"
#include "base/text.h"
#include "files/formats/mesh/can_reader.h"
#include "files/formats/mesh/dae_reader.h"
#include "files/formats/mesh/gltf_reader.h"
#include "files/formats/mesh/mesh_content.h"
#include "files/formats/mesh/obj_reader.h"
#include "files/formats/mesh/opf_reader.h"
#include "files/formats/mesh/ply_reader.h"
#include "files/formats/mesh/stl_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <new>
#include <span>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace sunfleck {

namespace {

enum class MeshFormat { can, dae, gltf, obj, opf, ply, stl, unknown };

// A mesh in the frame of its file.
struct FileMesh {
  Mesh mesh;
  FileAxis up = FileAxis::y;
  double unit_m = 1.0;
};

MeshFormat format_of(const std::filesystem::path& file) {
  const std::string name = lower_case(file.filename().string());
  constexpr std::pair<std::string_view, MeshFormat> endings[] = {
      {".can", MeshFormat::can},  {".can.gz", MeshFormat::can}, {".dae", MeshFormat::dae},
      {".glb", MeshFormat::gltf}, {".gltf", MeshFormat::gltf},  {".obj", MeshFormat::obj},
      {".opf", MeshFormat::opf},  {".ply", MeshFormat::ply},    {".stl", MeshFormat::stl}};
  for (const auto& [ending, format] : endings)
    if (name.ends_with(ending)) return format;
  return MeshFormat::unknown;
}

FileMesh read_format(const MeshSource& source, MeshFormat format) {
  switch (format) {
    case MeshFormat::can:
      return {read_can(source), FileAxis::z};
    case MeshFormat::dae: {
      DaeMesh read = read_dae(source);
      return {std::move(read.mesh), read.up};
    }
    case MeshFormat::gltf:
      return {read_gltf(source)};
    case MeshFormat::obj:
      return {read_obj(source)};
    case MeshFormat::opf:
      return {read_opf(source), FileAxis::z, 0.01};  // centimetres
    case MeshFormat::ply:
      return {read_ply(source)};
    case MeshFormat::stl:
      return {read_stl(source)};
    case MeshFormat::unknown:
      break;
  }
  if (const auto ending = mesh_ending_of_file(source.file))
    refuse(source, 0, "unknown kind of mesh", fmt::format("its content looks like {}", *ending),
           fmt::format("rename it so that it ends in {}", *ending));
  refuse(source, 0, "unknown kind of mesh", fmt::format("the name must end in {}", readable_meshes),
         "convert it, or rename it to match its format");
}

// Converts to the scene's axes and metres. Elements are stored in single precision, so coordinates must be finite in that.
void place(const std::string& where, Mesh& mesh, FileAxis up, const MeshImport& import, double unit_m) {
  const double scale = import.scale * unit_m;
  for (glm::dvec3& v : mesh.vertices) {
    v = scene_direction(up, import.axes, v) * scale;
    const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    if (std::isnan(v.x + v.y + v.z) || largest > std::numeric_limits<float>::max())
      throw_input(fmt::format("{}: a vertex at ({}, {}, {}) m after scaling by {}", where, v.x, v.y, v.z, scale),
                  "it must be finite in single precision, i.e. below 3.4e38", "check its numbers and scale");
  }
}

void check_numbers(const std::string& where, const char* what, std::span<const std::uint32_t> numbers, std::size_t triangles,
                   std::size_t count) {
  if (numbers.size() != triangles)
    throw_input(fmt::format("{}: {} {} numbers", where, numbers.size(), what), fmt::format("there are {} triangles", triangles),
                "give one for each triangle");
  const auto beyond = std::find_if(numbers.begin(), numbers.end(), [&](std::uint32_t number) { return number >= count; });
  if (beyond == numbers.end()) return;
  throw_input(fmt::format("{}: {} number {} of triangle {}", where, what, *beyond, beyond - numbers.begin()),
              fmt::format("there are {}, counted from 0", count), "correct the numbers");
}

void check_corners(const std::string& where, const Mesh& mesh) {
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const glm::uvec3& corners = mesh.triangles[t];
    const std::uint32_t largest = std::max({corners.x, corners.y, corners.z});
    if (largest < mesh.vertices.size()) continue;
    throw_input(fmt::format("{}: vertex number {} of triangle {}", where, largest, t),
                fmt::format("there are {}, counted from 0", mesh.vertices.size()), "correct the triangles");
  }
}

}  // namespace

bool is_mesh_file(const std::filesystem::path& file) {
  return format_of(file) != MeshFormat::unknown;
}

bool is_can_file(const std::filesystem::path& file) {
  return format_of(file) == MeshFormat::can;
}

Mesh read_mesh(const std::filesystem::path& file, const MeshImport& import, SourceFiles* files) {
  EXPECT(import.scale, >, 0.0);
  const MeshFormat format = format_of(file);
  MeshSource source{file, {}, import.optics, import.allow_outside, files, import.named, import.keeps_colours};
  try {
    const std::string bytes = format == MeshFormat::unknown ? std::string() : read_source(file, files);
    source.bytes = without_mark(bytes);
    if (source.bytes.empty() && format != MeshFormat::unknown)
      refuse(source, 0, "the file is empty", "a mesh needs at least one triangle", "export it again");
    FileMesh read = read_format(source, format);
    Mesh& mesh = read.mesh;
    if (mesh.triangles.empty())
      refuse(source, 0, "no triangles found", "a mesh needs at least one", "check that surfaces were exported");
    place(printable(file.string()), mesh, import.up.value_or(read.up), import, read.unit_m);
    split_organs(mesh, import.split);
    return std::move(mesh);
  } catch (const std::bad_alloc&) {
    throw_failure(fmt::format("{}: does not fit into memory", printable(file.string())), "out of memory", "use a smaller mesh");
  } catch (const std::length_error&) {
    throw_failure(fmt::format("{}: does not fit into memory", printable(file.string())), "out of memory", "use a smaller mesh");
  }
}

Mesh import_mesh(Mesh mesh, const std::string& place_of_mesh, const MeshImport& import) {
  EXPECT(import.scale, >, 0.0);
  if (mesh.triangles.empty())
    throw_input(place_of_mesh + ": no triangle", "a mesh needs at least one", "give some, or leave the mesh out");
  check_corners(place_of_mesh, mesh);
  check_numbers(place_of_mesh, "optics", mesh.optics_of, mesh.triangles.size(), mesh.optics_names.size());
  check_numbers(place_of_mesh, "organ", mesh.organ_of, mesh.triangles.size(), mesh.organs.size());
  if (!mesh.labels.empty() && mesh.labels.size() != mesh.triangles.size())
    throw_input(fmt::format("{}: {} labels", place_of_mesh, mesh.labels.size()),
                fmt::format("there are {} triangles", mesh.triangles.size()), "give one for each triangle, or none");
  place(place_of_mesh, mesh, import.up.value_or(FileAxis::y), import, 1.0);
  split_organs(mesh, import.split);
  return mesh;
}

}  // namespace sunfleck
