#pragma once
// Profiles of light by height, from this run or from the profile.csv of an earlier one, and how field data agree with them.

#include "io/agreement.h"
#include "io/measured_reader.h"
#include "transport/model.h"
#include "transport/result.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace sunfleck {

// The columns of profile.csv that are drawn.
struct ProfileTable {
  struct Row {
    double height_m = 0.0;           // the layer's lower edge; of the last row: the top plane
    Estimate sunfleck_ratio;         // of the plane at that height; value NaN without a beam
    std::vector<Estimate> absorbed;  // [band], W m-2 of ground in the layer; empty in the last row
  };
  std::string title;
  std::optional<double> confidence;  // none: the file does not say
  std::vector<std::string> bands;
  std::vector<Row> rows;  // at least two, bottom first
};

[[nodiscard]] ProfileTable profile_table(const std::string& title, double confidence, const RadiationModel& model,
                                         const RadiationResult& result);

// The profile.csv of another result. Throws Error (input).
[[nodiscard]] ProfileTable read_profile_csv(const std::filesystem::path& file);

// The simulated ratio between the profile's planes, linearly; 1 above the canopy, the lowest plane's below it.
[[nodiscard]] double sunfleck_ratio_at(const ProfileTable& profile, double height_m);

// Simulated against measured ratios. Throws Error (input) if the profile is without a beam.
[[nodiscard]] Agreement agreement(const ProfileTable& profile, const MeasuredProfile& measured);

}  // namespace sunfleck
