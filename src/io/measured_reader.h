#pragma once
// Field data: sunfleck ratios by height, as a user measured them.

#include <filesystem>
#include <string>
#include <vector>

namespace sunfleck {

struct MeasuredRatio {
  double height_m = 0.0;        // above the ground, not negative
  double sunfleck_ratio = 0.0;  // 0..1
};

struct MeasuredProfile {
  std::string name;                   // of the file, without its folder
  std::vector<MeasuredRatio> points;  // at least one, in the order of the file
};

// A CSV with the columns height_m and sunfleck_ratio and no other. Throws Error (input), one line `FILE:LINE: ...`.
[[nodiscard]] MeasuredProfile read_measured(const std::filesystem::path& file);

}  // namespace sunfleck
