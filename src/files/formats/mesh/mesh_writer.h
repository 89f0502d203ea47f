#pragma once
// Writes meshes, for other programs and for read_mesh.

#include "physics/canopy/mesh.h"
#include "physics/canopy/plot.h"

#include <filesystem>

namespace sunfleck {

// Writes the mesh, which is in the scene's axes, in the format that the file's ending selects, in upper or lower case. Lengths
// are metres. The axes of the file are the given ones; but glTF has y up, so that east_north_up becomes x east, y up, z south
// there.
// .glb, .gltf  as write_gltf
// .obj         triangles in the order of the mesh, organs as objects (plant1_leaf7), optics as materials; double precision
// .ply         binary, double precision; each face has `plant`, `rank`, and the numbers `organ` and `optics`, which comments of
//              the header name
// .can         CARIBU's polygons: triangles in order, x east, y north, z up; double precision. Labels are those of the mesh,
//              or derived from plant, rank and optics by the rule in caribu_label.h
// Throws Error: input for another ending; failure if the mesh is too large for the format, a plant or rank is too large for a
// label, or the file cannot be written.
void write_mesh(const Mesh& mesh, const std::filesystem::path& file, Axes axes = Axes::south_up_west);

// Returns whether write_mesh has a writer for this name.
[[nodiscard]] bool is_writable_mesh(const std::filesystem::path& file);
inline constexpr const char* writable_meshes = ".glb, .gltf, .obj, .ply or .can";

// Writes GLB (.glb) or glTF with an embedded buffer (.gltf), with one node per plant and organ, with extras {"plant", "organ",
// "rank"}, and one material per optics name. read_mesh returns the same triangles in single precision, with the same optics and
// organs, grouped by organ; organs without triangles are left out. An empty mesh yields a valid file that read_mesh refuses.
// Throws Error: input for another ending, failure if the file cannot be written.
void write_gltf(const Mesh& mesh, const std::filesystem::path& file, Axes axes = Axes::south_up_west);

}  // namespace sunfleck
