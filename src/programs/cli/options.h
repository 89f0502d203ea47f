#pragma once
// The command line as plain values; the defaults stand next to the names.

#include "pictures/charts/picture.h"
#include "simulate/requests.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <variant>
#include <vector>

namespace sunfleck {

struct RunOptions : SceneRequest, DeviceRequest, WorkRequest, ResultRequest {
  bool quiet = false;
  bool json = false;
  std::vector<std::string> without_effect;  // a warning for each given option that changes nothing beside the others
};

// Options of `day`.
struct DayOptions : DayRequest {
  RunOptions run;  // images: all, none, day, season or planes
};

struct RenderOptions {
  // `scene` is a scene file or the folder of a finished run; the other options say how to simulate it and how to view it.
  RunOptions run;
  std::filesystem::path file;  // .png or .exr; empty: <chart>_<field>.png in the folder, or <scene>_<chart>_<field>.png
  Picture picture;
  bool chart_given = false;
  std::string simulating;  // the first given option that only a simulation needs; empty: none
};

struct ViewOptions {
  // `output` is the folder for saved pictures and results; `json` prints one line on standard output per event.
  RunOptions run;
  Picture picture;
};

struct ValidateOptions {
  std::filesystem::path output;    // empty: results/validate
  std::vector<std::string> cases;  // parts of the names of the cases to run; empty: all cases
  std::string device = "auto";
  int threads = 0;
  bool quiet = false;
  bool json = false;
};

struct TradeoffOptions {
  // Only scene, stand, output, device, threads, seed, grid_m (an additional grid, marked in the plot), max_seconds,
  // allow_outside, quiet and json are used.
  RunOptions run;
  double finest_rays = 8e6;        // approximate number of rays of the finest grid; all other work is derived from it
  int seeds = 8;                   // runs per setting, with the seeds run.seed, run.seed + 1, ...
  std::vector<double> meshes;      // shares of the triangles kept in the coarser meshes that are measured too
  double requested_error = 0.01;   // relative error for which a setting is recommended
  std::string quantity = "organ";  // quantity the error applies to: canopy, layer, organ or triangle
};

struct MaizeOptions {
  std::filesystem::path output = "maize.glb";
  int rows = 4, per_row = 3;
  std::vector<double> spacing_m{0.6, 0.6};  // along the row, between rows
  std::uint64_t seed = 1;
};

struct ConvertOptions {
  std::filesystem::path input, output;
  StandFiles stand;
  bool z_up = false;  // the input's z axis points up, as it always does in a .can
  std::string split;  // names, materials or parts; empty: not given
  bool allow_outside = false;
};

struct InfoOptions {
  RunOptions run;                             // the run whose memory is forecast; without a scene only the devices are listed
  std::vector<std::filesystem::path> meshes;  // described instead; only run.allow_outside and run.json matter then
};

// Options of `new`.
struct NewOptions {
  std::vector<std::filesystem::path> meshes;
  std::filesystem::path output;  // empty: standard output
  bool force = false;            // the output may exist
  bool allow_outside = false;    // the buffers of a glTF file may lie outside its folder
};

// The parsed command with its options, or the text to print for --help and --version.
struct TextToPrint {
  std::string text;
};
using Command = std::variant<TextToPrint, RunOptions, DayOptions, RenderOptions, ViewOptions, ValidateOptions, TradeoffOptions,
                             MaizeOptions, ConvertOptions, InfoOptions, NewOptions>;

// Parses the command line. Throws Error (input) on bad usage.
[[nodiscard]] Command parse_command_line(int argc, const char* const* argv);

}  // namespace sunfleck
