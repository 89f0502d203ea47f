#pragma once
// Field data: sunfleck ratios by height, measured by the user.

#include <filesystem>
#include <string>
#include <vector>

namespace sunfleck {

struct MeasuredRatio {
  double height_m = 0.0;        // above the ground, >= 0
  double sunfleck_ratio = 0.0;  // 0..1
};

struct MeasuredProfile {
  std::string name;                   // name of the file without its folder
  std::vector<MeasuredRatio> points;  // at least one, in the order of the file
};

// Reads a CSV that has exactly the columns height_m and sunfleck_ratio. Throws Error (input), one line `FILE:LINE: ...`.
[[nodiscard]] MeasuredProfile read_measured(const std::filesystem::path& file);

}  // namespace sunfleck
