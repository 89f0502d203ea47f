#pragma once
// A scene made of a set of CARIBU's files, as the text of a scene file: what `convert` writes is what `run` runs.

#include "io/source_files.h"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sunfleck {

// A waveband, and the .opt file with its optical properties.
struct CaribuBand {
  std::string name;
  std::filesystem::path file;
};

// Of a word of the command line, `FILE` or `NAME=FILE`. Without a name the band is called as the file, in capitals and without
// its ending: par.opt is PAR. Throws Error (input) for a name that cannot head a column.
[[nodiscard]] CaribuBand caribu_band(std::string_view word);

struct CaribuSet {
  // .can or .can.gz, or another mesh whose optics are called soil, leaf, stem, leaf2, stem2, ...
  std::filesystem::path canopy;
  std::vector<CaribuBand> bands;  // at least one, no two of a name
  std::filesystem::path light;
  std::optional<std::filesystem::path> domain;
  double scale = 1.0;          // metres in a unit of the canopy and the domain, > 0
  bool allow_outside = false;  // may a glTF file's buffers lie outside its folder?
};

// What the text calls these two files, relative to where it will lie.
struct CaribuNames {
  std::string canopy, light;
};

struct CaribuScene {
  std::string text;
  bool names_light = false;  // or else all of the light is in the text
};

// Reads and checks all files, and returns a text that holds
// - the plot: the domain, repeated without end, its corner with the largest x and y moved to the scene's origin; or, without a
//   domain, an isolated stand on a plot as large as the canopy seen from above;
// - the light, the same in every band: where the file has one direction with E > 0, the sun there, `direct` = E; else a sky of
//   these directions, `diffuse` = the sum of E;
// - the soil, on the ground and where the mesh has soil, and leaves and stems of every species that the mesh uses.
// Throws Error (input), one line, for what the readers of these files refuse, a species that an .opt file lacks, optics of
// other names, two bands of a name, a plot or a canopy that is too small or too large for a scene. `files`, where given, gets
// all that was read.
[[nodiscard]] CaribuScene caribu_scene(const CaribuSet& set, const CaribuNames& names, SourceFiles* files = nullptr);

}  // namespace sunfleck
