#pragma once
// Turns a set of CARIBU files into the text of a scene file, which `convert` writes and `run` runs.

#include "base/source_files.h"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sunfleck {

// A waveband and the .opt file with its optical properties.
struct CaribuBand {
  std::string name;
  std::filesystem::path file;
};

// Parses an argument of the command line, `FILE` or `NAME=FILE`. The default name is that of the file in capitals, without its
// ending: PAR for par.opt. Throws Error (input) for a name that cannot head a column.
[[nodiscard]] CaribuBand caribu_band(std::string_view word);

struct CaribuSet {
  // A .can or .can.gz file, or another mesh whose optics are named soil, leaf, stem, leaf2, stem2, ...
  std::filesystem::path canopy;
  std::vector<CaribuBand> bands;  // at least one; their names differ
  std::filesystem::path light;
  std::optional<std::filesystem::path> domain;
  double scale = 1.0;          // metres per unit of the canopy and the domain, > 0
  bool allow_outside = false;  // true if the buffers of a glTF file may lie outside its folder
};

// The names by which the text refers to these two files, relative to the text's future location.
struct CaribuNames {
  std::string canopy, light;
};

struct CaribuScene {
  std::string text;
  bool names_light = false;  // false if the text itself holds all of the light
};

// Reads and checks all files, and returns a text that holds
// - the plot: the periodic domain, its corner with the largest x and y moved to the origin of the scene; without a domain, an
//   isolated stand on a plot as large as the canopy seen from above;
// - the light, the same in every band: a sun with `direct` = E if the file has only one direction with E > 0, otherwise a sky
//   of these directions with `diffuse` = the sum of E;
// - the optics of the soil, which hold for the ground and for soil in the mesh, and of the leaves and stems of every species in
//   the mesh.
// Throws Error (input), one line, if a file is refused by its reader, an .opt file lacks a species, optics have other names,
// two bands have the same name, or the plot or the canopy is too small or too large for a scene. Adds every file read to
// `files` if that is given.
[[nodiscard]] CaribuScene caribu_scene(const CaribuSet& set, const CaribuNames& names, SourceFiles* files = nullptr);

}  // namespace sunfleck
