#pragma once
// The command line as plain values; the defaults stand beside the names.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace sunfleck {

struct RunOptions {
  std::filesystem::path scene;
  std::filesystem::path output;        // empty: results/<stem of the scene>
  std::string device = "auto";         // auto | gpu | lavapipe | cpu | INDEX | NAME
  std::optional<double> direct_error;  // replace the scene's bounds
  std::optional<double> indirect_error;
  std::optional<double> grid_m;
  std::optional<int> passes;
  std::optional<double> max_seconds;
  std::optional<std::uint64_t> max_rays;
  std::uint64_t seed = 1;
  int threads = 0;                         // 0: as many as there are cores
  std::vector<std::string> exports;        // of: csv
  std::vector<std::string> images{"all"};  // file stems, all or none
  std::string band;                        // of the pictures; empty: the scene's first
  int width = 1600, height = 1200;         // of the pictures
  int samples = 4;                         // a pixel
  bool allow_outside = false;
  bool quiet = false;
  bool json = false;
};

struct MaizeOptions {
  std::filesystem::path output = "maize.glb";
  int rows = 4, per_row = 3;
  std::vector<double> spacing_m{0.6, 0.6};  // along the row, between rows
  std::uint64_t seed = 1;
};

struct InfoOptions {
  std::filesystem::path scene;  // may be empty: devices only
  bool allow_outside = false;
  bool json = false;
};

// The command and its options; or, for --help and --version, what to print.
struct TextToPrint {
  std::string text;
};
using Command = std::variant<TextToPrint, RunOptions, MaizeOptions, InfoOptions>;

// Throws Error (input) on bad usage.
[[nodiscard]] Command parse_command_line(int argc, const char* const* argv);

[[nodiscard]] std::string version();  // e.g. "0.1.0"
[[nodiscard]] std::string commit();   // as built; "unknown" outside a repository

}  // namespace sunfleck
