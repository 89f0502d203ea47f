#pragma once
// Labels of elements in CARIBU files, O PPPPP LLL EEE: species, plant, leaf and number of the triangle.

#include "physics/canopy/mesh.h"

#include <cstddef>
#include <cstdint>
#include <string>

namespace sunfleck {

// Returns the label of an element in CARIBU files, O PPPPP LLL EEE: the species (N for organs named leafN or stemN, 1 for other
// names, 0 for soil); the plant; the leaf (the rank, at least 1, for leaves, 000 for all others); and the number of the triangle
// in its organ, modulo 1000. The organ's role or, without one, its name says whether it is a leaf or soil. Throws Error (failure)
// if a number has too many digits.
[[nodiscard]] std::string caribu_label(const Organ& organ, std::size_t number_in_organ);

// Returns the label of an element that its file already labelled, with only the plant replaced: other meshes or copies placed
// before it change the plant numbers.
[[nodiscard]] std::string caribu_label_as_read(const Organ& organ, std::uint64_t label);

}  // namespace sunfleck
