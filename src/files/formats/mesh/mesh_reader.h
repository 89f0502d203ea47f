#pragma once
// Reads mesh files: glTF and GLB, OBJ, PLY, STL, CARIBU .can and .can.gz. The file's name determines the format.

#include "base/source_files.h"
#include "physics/canopy/mesh.h"

#include <filesystem>
#include <optional>
#include <string>

namespace sunfleck {

enum class UpAxis { y, z, x };

struct MeshImport {
  std::optional<std::string> optics;  // for triangles whose file names no material
  std::optional<UpAxis> up;           // default: z for .can, otherwise y
  double scale = 1.0;                 // > 0
  bool allow_outside = false;         // true if the buffers of a glTF file may lie outside its folder
};

// Returns the triangles of the file in the scene's axes (a z-up file has x east, y north: X = -y, Y = z, Z = -x; an
// x-up file has y east, z north: X = -z, Y = x, Z = -y), scaled, with
// polygons cut into fans. The organs come from `.can` labels, or from the glTF node extras {"plant", "organ", "rank"}, or from
// node names like plant1_leaf7; otherwise there is one plant (number 1), whose organs are named after the optics, with rank 0.
// Throws Error (input), one line with the file and, if known, the line, for a missing or empty file, an unknown format,
// truncated or malformed content, an index out of range, a number that is not finite or unreadable, a mesh without triangles,
// or a triangle without a material if `optics` is not given. Adds the file and the buffers of a glTF file to `files` if that is
// given.
[[nodiscard]] Mesh read_mesh(const std::filesystem::path& file, const MeshImport& import, SourceFiles* files = nullptr);

// Imports a mesh from memory whose optics are all named: checks it, turns it to the scene's axes (y is up by default) and
// scales it. Throws Error (input), beginning with `place`, for a mesh without triangles, arrays of different lengths, an index
// out of range, or a coordinate that is not finite.
[[nodiscard]] Mesh import_mesh(Mesh mesh, const std::string& place, const MeshImport& import);

// Returns whether read_mesh has a reader for this name.
[[nodiscard]] bool is_mesh_file(const std::filesystem::path& file);
[[nodiscard]] bool is_can_file(const std::filesystem::path& file);  // true for .can and .can.gz

}  // namespace sunfleck
