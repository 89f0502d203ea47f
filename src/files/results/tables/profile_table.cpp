#include "files/results/tables/profile_table.h"

#include "base/check.h"
#include "base/error.h"
#include "base/text_reader.h"
#include "files/formats/measured/number_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

namespace sunfleck {
namespace {

constexpr std::string_view absorbed_suffix = "_absorbed";

// Returns the bands in a header, found by their columns of absorbed flux.
std::vector<std::string> bands_of(const NumberTable& table) {
  std::vector<std::string> bands;
  for (const std::string& column : table.columns) {
    if (column.size() > absorbed_suffix.size() && column.ends_with(absorbed_suffix))
      bands.push_back(column.substr(0, column.size() - absorbed_suffix.size()));
  }
  return bands;
}

// Reads the confidence from the head line "seed 1, confidence 0.95".
std::optional<double> confidence_of(const NumberTable& table) {
  constexpr std::string_view key = ", confidence ";
  for (const std::string& comment : table.comments) {
    const std::size_t at = comment.find(key);
    if (comment.starts_with("seed ") && at != std::string::npos)
      return parse_number(std::string_view(comment).substr(at + key.size()));
  }
  return {};
}

void check_heights(const NumberTable& table, std::size_t height) {
  if (table.rows.size() < 2)
    refuse_line(table.file, table.rows.back().line, "only one row", "a profile needs at least one layer and the top plane",
                "use a file as written by this program");
  double below = -std::numeric_limits<double>::infinity();
  for (const NumberTable::Row& row : table.rows) {
    const double here = row.cells[height];
    if (std::isnan(here)) refuse_line(table.file, row.line, "height_m is empty", "every plane needs a height", "fill it in");
    if (here <= below) {
      refuse_line(table.file, row.line, fmt::format("height_m = {:g}", here), "heights must ascend from the ground",
                  "use a file as written by this program");
    }
    below = here;
  }
}

}  // namespace

ProfileTable profile_table(const std::string& title, double confidence, const RadiationModel& model,
                           const RadiationResult& result) {
  ProfileTable profile{title, confidence, {}, {}};
  for (const Waveband& band : model.bands) profile.bands.push_back(band.name);
  for (const LayerResult& layer : result.layers) profile.rows.push_back({layer.height_m, layer.sunfleck_ratio, layer.absorbed});
  return profile;
}

ProfileTable read_profile_csv(const std::filesystem::path& file) {
  const NumberTable table = read_number_table(file);
  const std::size_t height = table.column("height_m");
  const std::size_t ratio = table.column("sunfleck_ratio");
  const std::size_t ratio_error = table.column("sunfleck_ratio_error");
  ProfileTable profile;
  profile.title = table.comments.empty() ? "" : table.comments.front();
  profile.confidence = confidence_of(table);
  profile.bands = bands_of(table);
  std::vector<std::size_t> values, errors;
  for (const std::string& band : profile.bands) {
    values.push_back(table.column(band + std::string(absorbed_suffix)));
    errors.push_back(table.column(band + std::string(absorbed_suffix) + "_error"));
  }
  check_heights(table, height);
  for (const NumberTable::Row& row : table.rows) {
    ProfileTable::Row& to =
        profile.rows.emplace_back(ProfileTable::Row{row.cells[height], {row.cells[ratio], row.cells[ratio_error]}, {}});
    if (&row == &table.rows.back()) break;
    for (std::size_t b = 0; b < values.size(); ++b) to.absorbed.push_back({row.cells[values[b]], row.cells[errors[b]]});
  }
  return profile;
}

double sunfleck_ratio_at(const ProfileTable& profile, double height_m) {
  const std::vector<ProfileTable::Row>& rows = profile.rows;
  EXPECT(rows.size(), >, std::size_t{1});
  if (height_m > rows.back().height_m) return 1.0;
  const auto above = std::find_if(rows.begin(), rows.end(), [&](const auto& row) { return row.height_m >= height_m; });
  if (above == rows.begin()) return rows.front().sunfleck_ratio.value;
  const auto below = above - 1;
  const double share = (height_m - below->height_m) / (above->height_m - below->height_m);
  return below->sunfleck_ratio.value + share * (above->sunfleck_ratio.value - below->sunfleck_ratio.value);
}

Agreement agreement(const ProfileTable& profile, const MeasuredProfile& measured) {
  std::vector<double> simulated, seen;
  for (const MeasuredRatio& point : measured.points) {
    simulated.push_back(sunfleck_ratio_at(profile, point.height_m));
    seen.push_back(point.sunfleck_ratio);
  }
  if (std::any_of(simulated.begin(), simulated.end(), [](double ratio) { return std::isnan(ratio); })) {
    throw_input(fmt::format("{}: nothing to compare with", measured.name), "the scene has no direct beam, so no sunflecks",
                "add [sun] and a direct irradiance, or omit --measured");
  }
  return agreement(simulated, seen);
}

}  // namespace sunfleck
