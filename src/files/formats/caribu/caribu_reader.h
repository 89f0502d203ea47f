#pragma once
// Readers of the small files that accompany a CARIBU .can file: `.opt` holds the optical properties of one waveband, `.8` the
// periodic domain. light_reader.h reads the light directions, `.light`. All of them ignore blank lines and whatever follows a
// #. Both readers throw Error (input) with one line that names the file and the line, and add the file to `files` if that is
// given.

#include "base/source_files.h"
#include "physics/canopy/optics.h"

#include <filesystem>
#include <vector>

namespace sunfleck {

// One optical species: opaque stems, and both faces of the leaves.
struct SpeciesOptics {
  double stem_reflectance = 0.0;
  FaceOptics upper, lower;
};

struct CaribuOptics {
  double soil_reflectance = 0.0;
  std::vector<SpeciesOptics> species;  // [species - 1]; the first digit of a label is the species, from 1
};

inline constexpr std::size_t most_species = 9;  // a label has one digit for the species

// Reads the lines `n COUNT` (number of species), `s d R` (soil) and, for each species, `e d Rstem d Rup Tup d Rdown Tdown`.
// Only the order of the species lines matters. The letter d means Lambertian, the only kind supported. Refuses lines that begin
// otherwise or have the wrong number of words, numbers outside 0..1, R + T > 1, a missing or repeated n or s, and any number of
// species other than n.
[[nodiscard]] CaribuOptics read_opt(const std::filesystem::path& file, SourceFiles* files = nullptr);

// A rectangle on the ground in the unit of the file, x east and y north.
struct CaribuDomain {
  double x_min = 0.0, y_min = 0.0, x_max = 0.0, y_max = 0.0;
};

// Reads four numbers, `xmin ymin` and `xmax ymax`, on any number of lines. Refuses any other count, numbers that are not
// finite, and a rectangle without area.
[[nodiscard]] CaribuDomain read_domain(const std::filesystem::path& file, SourceFiles* files = nullptr);

}  // namespace sunfleck
