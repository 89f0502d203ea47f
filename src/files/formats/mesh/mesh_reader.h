#pragma once
// Reads mesh files: glTF and GLB, OBJ, PLY, STL, COLLADA, OPF, CARIBU .can and .can.gz. The file's name determines the format.

#include "base/source_files.h"
#include "files/formats/mesh/file_axis.h"
#include "files/formats/mesh/mesh_source.h"
#include "files/formats/mesh/organ_split.h"
#include "physics/canopy/mesh.h"
#include "physics/canopy/plot.h"

#include <filesystem>
#include <optional>
#include <string>

namespace sunfleck {

struct MeshImport {
  std::optional<std::string> optics;  // for triangles whose file names no material
  std::optional<FileAxis> up;         // default: z for .can and .opf, what the file says for .dae, otherwise y
  double scale = 1.0;                 // > 0; the units of .dae and .opf files are applied besides
  bool allow_outside = false;         // true if the buffers of a glTF file may lie outside its folder
  OrganSplit split = OrganSplit::names;
  Axes axes = Axes::south_up_west;  // of the user, which decide what x and z are in a file with y up
  NamedParts* named = nullptr;      // receives what read_mesh counts, if given
  bool keeps_colours = false;       // true if the colours of a PLY name its materials whether `optics` is given or not
};

// Returns the triangles of the file in the scene's axes, scaled, with polygons cut into triangles. A z-up file has x east, y north:
// X = -y, Y = z, Z = -x. An x-up file has y east, z north: X = -z, Y = x, Z = -y. A y-up file has x south, z west as the scene;
// but with the user's axes east_north_up it has x east, z south, which is how glTF and Blender turn these axes: X = z, Y = y, Z
// = -x. Every named object, group, node or solid of the file is an organ of plant 1, with its name and rank 0; names like
// plant1_leaf7, `.can` labels, glTF node extras {"plant", "organ", "rank"} and the ids of .opf give plant and rank too. Objects
// of one name are one organ in OBJ, where a name may recur; in other formats, the second becomes `NAME 2`. Where nothing is
// named, and in a file of a single named object with several materials, organs are named after their materials; a PLY file may
// name them by colour (ply_colours.h). `split` then splits them further (organ_split.h). Throws Error (input), one line with
// the file and, if known, the line, for a missing or empty file, an unknown format, truncated or malformed content, an index
// out of range, a number that is not finite or unreadable, a mesh without triangles, or a triangle without a material if
// `optics` is not given. Adds the file and the buffers of a glTF file to `files` if that is given.
[[nodiscard]] Mesh read_mesh(const std::filesystem::path& file, const MeshImport& import, SourceFiles* files = nullptr);

// Imports a mesh from memory whose optics are all named: checks it, turns it to the scene's axes (y is up by default), scales
// it and splits its organs. Throws Error (input), beginning with `place`, for a mesh without triangles, arrays of different
// lengths, an index out of range, or a coordinate that is not finite.
[[nodiscard]] Mesh import_mesh(Mesh mesh, const std::string& place, const MeshImport& import);

// Returns whether read_mesh has a reader for this name.
[[nodiscard]] bool is_mesh_file(const std::filesystem::path& file);
inline constexpr const char* readable_meshes = ".glb, .gltf, .obj, .ply, .stl, .dae, .opf, .can or .can.gz";
[[nodiscard]] bool is_can_file(const std::filesystem::path& file);  // true for .can and .can.gz

}  // namespace sunfleck
