#pragma once
// The command line as plain values; the defaults stand beside the names.

#include "app/picture.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace sunfleck {

// CARIBU's files beside a mesh that stands in a scene's place.
struct StandFiles {
  std::vector<std::string> optics;      // FILE or NAME=FILE, one for each band
  std::filesystem::path light, domain;  // may be empty
  std::optional<double> scale;          // metres in a unit of the mesh and the domain; default 1

  // The option given first in this order, for messages; empty without any.
  [[nodiscard]] std::string first_given() const;
};

struct RunOptions {
  std::filesystem::path scene;  // or a mesh, with `stand`
  StandFiles stand;
  std::filesystem::path output;        // empty: results/<stem of the scene>
  std::string device = "auto";         // auto | gpu | lavapipe | cpu | INDEX | NAME
  int device_turn = 0;                 // see DeviceAsked; not on the command line
  std::optional<double> direct_error;  // replace the scene's bounds
  std::optional<double> indirect_error;
  std::optional<double> grid_m;
  std::optional<int> passes;
  std::optional<double> max_seconds;
  std::optional<std::uint64_t> max_rays;
  std::optional<std::uint64_t> memory_bytes;  // for replicates in the making; none: a quarter of what is free
  std::uint64_t seed = 1;
  int threads = 0;                             // 0: as many as there are cores
  std::vector<std::string> exports;            // of the names of io/exports.h
  std::filesystem::path measured;              // empty: no field data
  std::vector<std::filesystem::path> compare;  // folders of earlier results
  std::vector<std::string> images{"all"};      // file stems, all or none
  std::optional<Picture> extra_picture;        // beside them, where --chart or --field asks for it
  PictureOptions pictures;
  bool resume = false;
  bool allow_outside = false;
  bool quiet = false;
  bool json = false;
};

// Of several dates, each has the same local hours.
struct DayOptions {
  RunOptions run;        // images: all, none or day
  std::string from, to;  // HH:MM; empty: sunrise and sunset
  std::string date;      // YYYY-MM-DD; empty: the scene's own
  std::string to_date;   // empty: one date
  int step_min = 60;     // the last step ends at `to`
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

[[nodiscard]] std::string version();  // e.g. "0.1.0"
[[nodiscard]] std::string commit();   // as built; "unknown" outside a repository

}  // namespace sunfleck
