#pragma once
// Writes meshes, for other programs and for read_mesh.

#include "canopy/mesh.h"

#include <filesystem>
#include <string>
#include <vector>

namespace sunfleck {

// In the kind of mesh that the file's name says; upper and lower case do not matter. X south, Y up, Z west, metres, but for
// .can. .glb, .gltf  as write_gltf .obj         triangles in the mesh's order; organs as objects, plant1_leaf7, optics as
// materials; double precision .ply         binary; double precision; of each face `plant`, `rank`, and the numbers `organ` and
// `optics`, which comments of
//              the header name
// .can         CARIBU's polygons, triangles in order, x east, y north, z up; double precision. Labels are the mesh's own, or
//              made by its rule (export_formats.h) of plant, rank and optics
// Throws Error: input for another ending, failure for a mesh too large for the format, a plant or rank too large for a label,
// or a file that cannot be written.
void write_mesh(const Mesh& mesh, const std::filesystem::path& file);

// True if write_mesh has a writer for this name.
[[nodiscard]] bool is_writable_mesh(const std::filesystem::path& file);
inline constexpr const char* writable_meshes = ".glb, .gltf, .obj, .ply or .can";

// The optics names that a .can file of the mesh cannot keep: it knows soil, and leaves and stems of nine species.
[[nodiscard]] std::vector<std::string> optics_lost_in_can(const Mesh& mesh);

// GLB (name ends in .glb) or glTF with embedded buffer (.gltf): one node a plant and organ with extras {"plant", "organ",
// "rank"}, one material an optics name. read_mesh gives the same triangles, in single precision, with the same optics and
// organs, organ by organ; organs without triangles are left out. From an empty mesh comes a valid file that read_mesh refuses.
// Throws Error: input for another ending, failure if the file cannot be written.
void write_gltf(const Mesh& mesh, const std::filesystem::path& file);

}  // namespace sunfleck
