#pragma once
// Reads the small files that stand beside a .can in a set of CARIBU's: `.opt`, optical properties of one waveband, and `.8`,
// the domain that repeats. Light directions, `.light`, have light_reader.h. In all of them blank lines and what follows a # are
// ignored; both throw Error (input), one line with file and line. `files`, where given, gets the file.

#include "canopy/optics.h"
#include "io/source_files.h"

#include <filesystem>
#include <vector>

namespace sunfleck {

// One optical species: its stems, which let nothing through, and both faces of its leaves.
struct SpeciesOptics {
  double stem_reflectance = 0.0;
  FaceOptics upper, lower;
};

struct CaribuOptics {
  double soil_reflectance = 0.0;
  std::vector<SpeciesOptics> species;  // [species - 1]: the first digit of a label counts them from 1
};

inline constexpr std::size_t most_species = 9;  // a label has one digit for them

// Lines, in any order but that of the species: `n COUNT`, their number; `s d R`, the soil; for each species
// `e d Rstem d Rup Tup d Rdown Tdown`. The letter d stands for Lambertian, the only kind there is here.
// Refused: a line that begins otherwise, or has more or fewer words; a number outside 0..1, R + T > 1; n or s missing or given
// twice; other than n species.
[[nodiscard]] CaribuOptics read_opt(const std::filesystem::path& file, SourceFiles* files = nullptr);

// A rectangle on the ground in the file's own unit, x east and y north.
struct CaribuDomain {
  double x_min = 0.0, y_min = 0.0, x_max = 0.0, y_max = 0.0;
};

// Four numbers, `xmin ymin` and `xmax ymax`, on as many lines as the file likes. Refused: more or fewer, one that is not
// finite, a rectangle without area.
[[nodiscard]] CaribuDomain read_domain(const std::filesystem::path& file, SourceFiles* files = nullptr);

}  // namespace sunfleck
