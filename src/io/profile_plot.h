#pragma once
// profile.png: light against height, for one result or several side by side, with field data.

#include "io/measured_reader.h"
#include "io/profile_table.h"

#include <optional>
#include <string>
#include <vector>

namespace sunfleck {

struct ProfileCurve {
  std::string label;  // shown in the legend if there is more than one curve or field data
  ProfileTable profile;
};

// Returns a gnuplot script for draw_plot. `curves` must not be empty; a curve without the band is drawn only in the left panel.
[[nodiscard]] std::string profile_plot(const std::string& title, const std::vector<ProfileCurve>& curves,
                                       const std::string& band, const std::optional<MeasuredProfile>& measured = {});

}  // namespace sunfleck
