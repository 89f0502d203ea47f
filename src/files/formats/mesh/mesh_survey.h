#pragma once
// Describes a mesh before a scene is written for it: extents, unit and axes, surfaces, pieces and defects.

#include "base/source_files.h"
#include "files/formats/mesh/frame_guess.h"
#include "files/formats/mesh/mesh_reader.h"
#include "physics/canopy/mesh.h"
#include "physics/canopy/role.h"

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace sunfleck {

// Stands for the material of triangles to which the file gives none.
inline constexpr std::string_view no_material = "(no material)";

enum class RoleSource { name, organs, shape };
[[nodiscard]] std::string_view role_source_name(RoleSource source);  // name, organs, shape

// A part of the mesh: the triangles of one material, or of the organs whose names differ only in their numbers.
struct MeshShare {
  std::string name;
  std::size_t triangles = 0;
  double area = 0.0;  // one-sided, file units squared
  std::size_t pieces = 0;
  std::size_t organs = 0;
  // |sum of area * normal| of each piece, added up, divided by the area: about 1 for flat sheets, 0 for tubes and closed
  // bodies.
  double flatness = 0.0;
  Role role = Role::leaf;
  RoleSource role_from = RoleSource::shape;
};

struct MeshDefects {
  std::size_t flat_triangles = 0;  // area below 1e-12 of the squared extent
  std::size_t slivers = 0;         // others whose longest edge is over 100 times their height
  std::size_t coincident = 0;      // with the three corners of an earlier triangle, in any order
  std::size_t crowded_edges = 0;   // edges of three or more triangles (non-manifold)
  // Edges of two triangles of one piece that face opposite ways, so that its upper face changes sides.
  std::size_t flipped_edges = 0;
  std::size_t unused_vertices = 0;
  // Those that hold flat triangles, slivers or coincident triangles, by first triangle, without repeats.
  std::vector<std::string> organs;
};

struct MeshSurvey {
  std::size_t vertices = 0, triangles = 0;
  double area = 0.0;  // one-sided, file units squared
  ShapeFigures shape;
  FrameGuess frame;
  std::size_t plants = 0, organs = 0;
  std::vector<MeshShare> materials;  // in the order of the file
  std::vector<MeshShare> families;   // organs by name without numbers, in the order of the file
  std::size_t closed_pieces = 0;     // pieces every edge of which has exactly two triangles
  MeshDefects defects;
  double area_below_ground = 0.0;  // of triangles whose centroid is below 0 along the guessed up axis

  // Returns whether the file names so few organs that its connected pieces are better ones: no family has two organs, and the
  // pieces are more than the organs and of two triangles and more on average.
  [[nodiscard]] bool needs_split() const;
  [[nodiscard]] bool has_materials() const { return materials.size() > 1 || materials.front().name != no_material; }
  [[nodiscard]] double area_m2() const { return area * frame.metres_per_unit * frame.metres_per_unit; }
};

// Returns what the format of a file of this name defines, for the mesh that read_mesh_as_is returns: axis and unit of glTF,
// .dae and .opf, the axis of .can.
[[nodiscard]] KnownFrame frame_of_format(const std::filesystem::path& file);

// Returns the name without the number at its end and the characters that separate it: `leaf` for leaf.012, leaf_12 and leaf 12.
// A name that is only a number stays as it is.
[[nodiscard]] std::string_view family_of(std::string_view name);

// Surveys a mesh in the axes and units of its file, with at least one triangle.
//
// Roles: a share has the role that its name suggests (role_from_name), or else the role of the largest area among its organs
// whose names suggest one. Of the others, a share is a leaf if its pieces are sheets (flatness above 0.3) and a stem if they
// are tubes or closed bodies. If no share is a leaf then, all whose shape decided are, since a plant has leaves.
[[nodiscard]] MeshSurvey survey_mesh(const Mesh& mesh, const KnownFrame& known);

// Reads a file as read_mesh does, but leaves its axes and unit as they are. Only a .dae comes in the scene's axes, since the
// file itself says how it is to be turned; it and an .opf come in metres. Triangles without a material have no_material.
// `named` receives the counts of the file, if given.
[[nodiscard]] Mesh read_mesh_as_is(const std::filesystem::path& file, bool allow_outside, SourceFiles* files = nullptr,
                                   NamedParts* named = nullptr);

}  // namespace sunfleck
