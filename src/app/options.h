#pragma once
// The command line as plain values; the defaults stand beside the names.

#include "pictures/picture.h"
#include "simulate/requests.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace sunfleck {

struct RunOptions : SceneRequest, DeviceRequest, WorkRequest, ResultRequest {
  bool quiet = false;
  bool json = false;
};

struct DayOptions : DayRequest {
  RunOptions run;  // images: all, none or day
};

struct RenderOptions {
  RunOptions run;              // scene: that, or the folder of a finished run; what simulates it; how it is looked at
  std::filesystem::path file;  // .png or .exr; empty: <chart>_<field>.png in the folder, or <scene>_<chart>_<field>.png
  Picture picture;
  bool chart_given = false;
  std::string simulating;  // the first option given that only a simulation needs; empty: none
};

struct ViewOptions {
  RunOptions run;  // output: where pictures and results are saved; json: a line on standard output for each event
  Picture picture;
};

struct ValidateOptions {
  std::filesystem::path output;    // empty: results/validate
  std::vector<std::string> cases;  // parts of names: only those; empty: all
  std::string device = "auto";
  int threads = 0;
  bool quiet = false;
  bool json = false;
};

struct TradeoffOptions {
  RunOptions run;                  // of it scene, output, device, threads, seed, grid_m (one more, marked in the plot),
                                   // max_seconds, allow_outside, quiet, json
  double finest_rays = 8e6;        // about as many as the finest grid has; all other work follows from it
  int seeds = 8;                   // runs of each setting, with the seeds run.seed, run.seed + 1, ...
  std::vector<double> meshes;      // coarser ones too: shares of the triangles that are kept
  double asked_error = 0.01;       // what a setting is recommended for,
  std::string quantity = "organ";  // of canopy, layer, organ or triangle
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
  bool z_up = false;  // the input's z axis points up, which a .can's does anyway
  bool allow_outside = false;
};

struct InfoOptions {
  RunOptions run;  // whose memory is foretold; without a scene: devices only
};

// The command and its options; or, for --help and --version, what to print.
struct TextToPrint {
  std::string text;
};
using Command = std::variant<TextToPrint, RunOptions, DayOptions, RenderOptions, ViewOptions, ValidateOptions, TradeoffOptions,
                             MaizeOptions, ConvertOptions, InfoOptions>;

// Throws Error (input) on bad usage.
[[nodiscard]] Command parse_command_line(int argc, const char* const* argv);

}  // namespace sunfleck
