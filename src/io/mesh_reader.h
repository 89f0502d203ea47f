#pragma once
// Reads mesh files: glTF and GLB, OBJ, PLY, STL, CARIBU .can and .can.gz. The format follows from the file's name.

#include "canopy/mesh.h"
#include "io/source_files.h"

#include <filesystem>
#include <optional>
#include <string>

namespace sunfleck {

enum class UpAxis { y, z };

struct MeshImport {
  std::optional<std::string> optics;  // for triangles whose file names no material
  std::optional<UpAxis> up;           // default: y, but z for .can
  double scale = 1.0;                 // > 0
  bool allow_outside = false;         // may a glTF file's buffers lie outside its folder?
};

// The file's triangles in the scene's axes (a z-up file is x east, y north: X = -y, Y = z, Z = -x), scaled, polygons cut
// into fans. Organs: `.can` labels; glTF node extras {"plant", "organ", "rank"}, else node names like plant1_leaf7; else one
// plant (number 1) whose organ names are the optics names, rank 0.
// Throws Error (input), one line with the file and, where it has one, the line: missing or empty file, unknown format, cut-off
// or malformed content, an index out of range, a number that is not finite or cannot be read, no triangle at all, a triangle
// without a material where `optics` is not given. `files`, where given, gets it and a glTF file's buffers.
[[nodiscard]] Mesh read_mesh(const std::filesystem::path& file, const MeshImport& import, SourceFiles* files = nullptr);

// The same for a mesh at hand, whose optics are all named: checked, turned to the scene's axes (y is up unless told otherwise)
// and scaled. Throws Error (input), beginning with `place`: no triangle, arrays of different lengths, an index out of range, a
// coordinate that is not finite.
[[nodiscard]] Mesh import_mesh(Mesh mesh, const std::string& place, const MeshImport& import);

// True if read_mesh has a reader for this name.
[[nodiscard]] bool is_mesh_file(const std::filesystem::path& file);
[[nodiscard]] bool is_can_file(const std::filesystem::path& file);  // .can or .can.gz

}  // namespace sunfleck
