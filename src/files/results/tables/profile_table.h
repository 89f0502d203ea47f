#pragma once
// Profiles of light by height, from this run or from the profile.csv of an earlier one, and their agreement with field data.

#include "files/formats/measured/measured_reader.h"
#include "files/results/tables/agreement.h"
#include "physics/transport/model/model.h"
#include "physics/transport/model/result.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace sunfleck {

// The columns of profile.csv used in plots.
struct ProfileTable {
  struct Row {
    double height_m = 0.0;           // lower edge of the layer; in the last row the top plane
    Estimate sunfleck_ratio;         // of the plane at that height; NaN without a beam
    std::vector<Estimate> absorbed;  // [band], W m-2 of ground in the layer; empty in the last row
  };
  std::string title;
  std::optional<double> confidence;  // empty if the file does not state it
  std::vector<std::string> bands;
  std::vector<Row> rows;  // at least two, from the bottom up
};

[[nodiscard]] ProfileTable profile_table(const std::string& title, double confidence, const RadiationModel& model,
                                         const RadiationResult& result);

// Reads the profile.csv of another result. Throws Error (input).
[[nodiscard]] ProfileTable read_profile_csv(const std::filesystem::path& file);

// Returns the simulated ratio, interpolated linearly between the planes of the profile; 1 above the canopy and the value of the
// lowest plane below it.
[[nodiscard]] double sunfleck_ratio_at(const ProfileTable& profile, double height_m);

// Compares simulated with measured ratios. Throws Error (input) if the profile has no beam.
[[nodiscard]] Agreement agreement(const ProfileTable& profile, const MeasuredProfile& measured);

}  // namespace sunfleck
