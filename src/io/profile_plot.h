#pragma once
// profile.png: what the light does with height, of one result or of several beside each other, with field data.

#include "io/measured_reader.h"
#include "io/profile_table.h"

#include <optional>
#include <string>
#include <vector>

namespace sunfleck {

struct ProfileCurve {
  std::string label;  // in the legend; shown where there is more than one curve or field data
  ProfileTable profile;
};

// A gnuplot script, for draw_plot. `curves` is not empty; a curve without the band is drawn in the left panel only.
[[nodiscard]] std::string profile_plot(const std::string& title, const std::vector<ProfileCurve>& curves,
                                       const std::string& band, const std::optional<MeasuredProfile>& measured = {});

}  // namespace sunfleck
