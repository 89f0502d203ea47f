#pragma once
// Chooses the organs of a mesh whose file names too few of them.

#include "physics/canopy/mesh.h"

#include <cstdint>
#include <string>
#include <vector>

namespace sunfleck {

enum class OrganSplit {
  names,      // the organs that the file names
  materials,  // one organ for each material of a named organ
  parts       // one organ for each connected piece
};

// Returns the words for them in scenes and options, in this order.
[[nodiscard]] const std::vector<std::string>& organ_split_names();

// Splits the organs of a mesh; new organs are in the order of their first triangles.
// materials  the triangles of an organ that has several materials become one organ for each, with the name `ORGAN MATERIAL`.
// parts      the triangles of an organ and material that are connected by corners at exactly the same positions become an organ
//            of their own. An organ of several pieces gives them its name and the ranks 1, 2, ... in the order of the triangles;
//            if it has a rank already, or if others of its plant have its name, they are named `ORGAN 1`, `ORGAN 2`, ... instead.
void split_organs(Mesh& mesh, OrganSplit split);

// Replaces an organ that has several materials by organs of its plant and rank that are named after them.
void name_after_materials(Mesh& mesh, std::uint32_t organ);

}  // namespace sunfleck
