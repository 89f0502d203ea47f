#pragma once
// The command line as plain values; the defaults stand next to the names.

#include "app/picture.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace sunfleck {

// CARIBU's files for a mesh that is given instead of a scene file.
struct StandFiles {
  std::vector<std::string> optics;      // FILE or NAME=FILE, one per band
  std::filesystem::path light, domain;  // may be empty
  std::optional<double> scale;          // metres per unit of the mesh and the domain; default 1

  // Returns the first of these options that was given, in this order, for messages; empty if none was.
  [[nodiscard]] std::string first_given() const;
};

struct RunOptions {
  std::filesystem::path scene;  // scene file, or a mesh that is completed by `stand`
  StandFiles stand;
  std::filesystem::path output;        // empty: results/<stem of the scene>
  std::string device = "auto";         // auto | gpu | lavapipe | cpu | INDEX | NAME
  int device_turn = 0;                 // see DeviceWish::turn; not on the command line
  std::optional<double> direct_error;  // replace the scene's bounds
  std::optional<double> indirect_error;
  std::optional<double> grid_m;
  std::optional<int> passes;
  std::optional<double> max_seconds;
  std::optional<std::uint64_t> max_rays;
  std::optional<std::uint64_t> memory_bytes;  // for replicates in progress; none: a quarter of the free memory
  std::uint64_t seed = 1;
  int threads = 0;                             // 0: all cores
  std::vector<std::string> exports;            // export names, see io/exports.h
  std::filesystem::path measured;              // empty: no field data
  std::vector<std::filesystem::path> compare;  // folders of earlier results
  std::vector<std::string> images{"all"};      // file stems, `all` or `none`
  std::optional<Picture> extra_picture;        // an additional picture if --chart or --field was given
  PictureOptions pictures;
  bool resume = false;
  bool allow_outside = false;
  bool quiet = false;
  bool json = false;
};

// Options of `day`. With several dates, each has the same local hours.
struct DayOptions {
  RunOptions run;        // images: all, none or day
  std::string from, to;  // HH:MM; empty: sunrise and sunset
  std::string date;      // YYYY-MM-DD; empty: the scene's own
  std::string to_date;   // empty: one date
  int step_min = 60;     // the last step ends at `to`
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
  // Only scene, output, device, threads, seed, grid_m (an additional grid, marked in the plot), max_seconds, allow_outside, quiet
  // and json are used.
  RunOptions run;
  double finest_rays = 8e6;        // approximate number of rays of the finest grid; all other work is derived from it
  int seeds = 8;                   // runs per setting, with the seeds run.seed, run.seed + 1, ...
  std::vector<double> meshes;      // shares of the triangles kept in the coarser meshes that are measured too
  double asked_error = 0.01;       // relative error for which a setting is recommended
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
  bool allow_outside = false;
};

struct InfoOptions {
  RunOptions run;  // the run whose memory is forecast; without a scene only the devices are listed
};

// The parsed command with its options, or the text to print for --help and --version.
struct TextToPrint {
  std::string text;
};
using Command = std::variant<TextToPrint, RunOptions, DayOptions, RenderOptions, ViewOptions, ValidateOptions, TradeoffOptions,
                             MaizeOptions, ConvertOptions, InfoOptions>;

// Parses the command line. Throws Error (input) on bad usage.
[[nodiscard]] Command parse_command_line(int argc, const char* const* argv);

[[nodiscard]] std::string version();  // e.g. "0.1.0"
[[nodiscard]] std::string commit();   // of the build; "unknown" outside a repository

}  // namespace sunfleck
