// Runs every scene of scenes/ quickly, and tests whether the files contain what the manual promises and agree with each other.

#include "regression/program.h"
#include "support/table.h"

#include <regex>

namespace sunfleck::regression {
namespace {

using nlohmann::json;

// Cells hold nine significant digits, so a sum of products of two cells is off by at most 1e-8 of its terms.
constexpr double table_rounding = 1e-8;

constexpr int width = 160;
constexpr int height = 120;

std::vector<std::string> scene_names() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(SUNFLECK_SOURCE_DIR) / "scenes")) {
    if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

void expect_keys(const json& object, const std::vector<std::string>& keys) {
  for (const std::string& key : keys) EXPECT_TRUE(object.contains(key)) << key;
}

// Returns the big-endian four-byte number at a place of a PNG's header.
int big_endian(const std::string& bytes, std::size_t at) {
  int value = 0;
  for (std::size_t i = at; i < at + 4; ++i) value = value * 256 + static_cast<unsigned char>(bytes.at(i));
  return value;
}

class Scenes : public ProgramTest, public ::testing::WithParamInterface<std::string> {
 protected:
  void SetUp() override {
    text_ = content(scene_file(GetParam() + ".toml"));
    simulate(scene_file(GetParam() + ".toml"), {"--device", "cpu", "--passes", "8", "--grid", "0.01", "--export", "csv",
                                                "--size", std::to_string(width) + "x" + std::to_string(height)});
    summary_ = summary();
    ASSERT_TRUE(summary_.is_object());
    for (const json& band : summary_["bands"]) bands_.push_back(band["name"]);
    ASSERT_FALSE(bands_.empty());
  }

  void expect_what_the_manual_promises() const;
  void expect_what_receivers_saw() const;  // the maps and sensors of scenes that have them
  void expect_agreement() const;           // of the tables with each other

  [[nodiscard]] std::string header(std::string common, const std::vector<std::string>& of_band) const {
    for (const std::string& band : bands_)
      for (const std::string& column : of_band) common += "," + band + column;
    return common;
  }
  // Returns the columns of the sunlit and the shaded class, whose areas end in `area`.
  [[nodiscard]] std::string class_columns(const std::string& area) const {
    std::string columns;
    const auto add = [&](const std::string& name) { columns += "," + name + "," + name + "_error"; };
    for (const char* part : {"sunlit_", "shaded_"}) add(part + area);
    for (const json& band : summary_["bands"]) {
      for (const char* part : {"_absorbed_sunlit", "_absorbed_sunlit_sd", "_absorbed_shaded", "_absorbed_shaded_sd"}) {
        add(band["name"].get<std::string>() + part);
        if (band.contains("umol_m2_s")) add(band["name"].get<std::string>() + part + "_umol_m2_s");
      }
    }
    return columns;
  }
  [[nodiscard]] int layers() const {
    std::smatch found;
    return std::regex_search(text_, found, std::regex("layers *= *([0-9]+)")) ? std::stoi(found[1]) : 20;
  }
  [[nodiscard]] bool has_sky() const { return text_.find("[sky]") != std::string::npos; }
  [[nodiscard]] bool periodic() const { return std::regex_search(text_, std::regex("periodic *= *true")); }

  std::string text_;
  json summary_;
  std::vector<std::string> bands_;
};

void expect_summary_keys(const json& summary) {
  expect_keys(summary, {"sunfleck",
                        "commit",
                        "scene",
                        "scene_digest",
                        "settings",
                        "complete",
                        "seed",
                        "device",
                        "triangles",
                        "organs",
                        "plants",
                        "plot_area_m2",
                        "leaf_area_index",
                        "sun",
                        "bands",
                        "sunlit_leaf_fraction",
                        "ground_sunfleck_ratio",
                        "lost_rays",
                        "direct",
                        "indirect",
                        "seconds"});
  expect_keys(summary["device"], {"kind", "name", "driver"});
  if (!summary["sun"].is_null()) expect_keys(summary["sun"], {"elevation_deg", "azimuth_deg"});
  expect_keys(summary["direct"], {"rays", "replicates", "grid_m", "relative_error", "bound", "seconds"});
  expect_keys(summary["indirect"], {"packets", "rounds", "relative_error", "bound", "seconds"});
  expect_keys(summary["seconds"], {"load", "bvh", "device", "direct", "indirect", "write", "total"});
  for (const json& band : summary["bands"]) {
    expect_keys(band, {"name", "incident", "absorbed_vegetation", "absorbed_structure", "absorbed_soil", "reflected",
                       "transmitted", "unshot", "residual", "error"});
    expect_keys(band["error"], {"absorbed_vegetation", "absorbed_structure", "absorbed_soil", "reflected", "transmitted"});
  }
}

void Scenes::expect_what_the_manual_promises() const {
  expect_summary_keys(summary_);
  EXPECT_EQ(summary_["complete"], true);
  EXPECT_EQ(summary_["device"]["kind"], "cpu");
  EXPECT_EQ(summary_["lost_rays"], 0);
  for (const json& band : summary_["bands"]) {
    EXPECT_EQ(band["residual"], 0);
    double sum = 0.0;
    for (const char* key :
         {"absorbed_vegetation", "absorbed_structure", "absorbed_soil", "reflected", "transmitted", "unshot"}) {
      EXPECT_GE(band[key], 0.0) << key;
      sum += band[key].get<double>();
    }
    EXPECT_NEAR(sum, band["incident"], 1e-9 * band["incident"].get<double>());
  }

  const Table profile(file("profile.csv"));
  EXPECT_EQ(
      profile.header(),
      header("height_m,leaf_area_index,sunfleck_ratio,sunfleck_ratio_error,sunlit_leaf_fraction,sunlit_leaf_fraction_error",
             {"_down", "_down_error", "_up", "_up_error", "_absorbed", "_absorbed_error", "_absorbed_structure",
              "_absorbed_structure_error"}) +
          class_columns("leaf_area_index"));
  EXPECT_EQ(profile.size(), static_cast<std::size_t>(layers()) + 1);
  const Table organs(file("organs.csv"));
  std::string organ_columns = "plant,organ,rank,area_m2,sunlit_fraction,sunlit_fraction_error";
  for (const json& band : summary_["bands"]) {
    const std::string name = band["name"];
    for (const char* figure : {"_direct", "_indirect", "_absorbed", "_absorbed_umol_m2_s"}) {
      const bool has_figure = band.contains("umol_m2_s") || std::string(figure) != "_absorbed_umol_m2_s";
      if (has_figure) organ_columns += "," + name + figure + "," + name + figure + "_error";
    }
  }
  EXPECT_EQ(organs.header(), organ_columns + class_columns("area_m2") + ",role");
  EXPECT_EQ(organs.size(), summary_["organs"]);
  const Table triangles(file("triangles.csv"));
  std::vector<std::string> of_band{"_direct_upper", "_direct_lower"};
  if (has_sky()) of_band.insert(of_band.end(), {"_sky_upper", "_sky_lower"});
  of_band.insert(of_band.end(), {"_indirect_upper", "_indirect_lower", "_absorbed", "_absorbed_error"});
  EXPECT_EQ(triangles.header(), header("triangle,plant,rank,organ,optics,area_m2,x,y,z", of_band));
  EXPECT_EQ(triangles.size(), summary_["triangles"]);
  for (const Table* table : {&profile, &organs, &triangles}) {
    ASSERT_GE(table->comments().size(), 3U);
    EXPECT_EQ(table->comments()[0], "# " + summary_["scene"].get<std::string>());
    for (std::size_t row = 0; row < table->size(); ++row) {
      for (const std::string& column : table->columns()) {
        if (column != "organ" && column != "role" && column != "optics") static_cast<void>(table->number(row, column));
      }
    }
  }

  const std::string picture = file(summary_["sun"].is_null() ? "rank_indirect.png" : "rank_direct.png");
  ASSERT_GT(picture.size(), 24U);
  EXPECT_EQ(picture.substr(1, 3), "PNG");
  EXPECT_EQ(big_endian(picture, 16), width);
  EXPECT_EQ(big_endian(picture, 20), height);
}

void Scenes::expect_what_receivers_saw() const {
  const json& planes = summary_["planes"];
  EXPECT_EQ(planes.empty(), text_.find("[[plane]]") == std::string::npos);
  for (const json& plane : planes) {
    char stem[32];
    std::snprintf(stem, sizeof stem, "plane_%.3f", plane["height_m"].get<double>());
    const Table map(file(std::string(stem) + ".csv"));
    EXPECT_EQ(map.header(), header("x_m,z_m,sunfleck", {"_direct", "_total"}));
    EXPECT_GT(file(std::string(stem) + ".png").size(), 1000U);
    for (std::size_t b = 0; b < bands_.size(); ++b) {
      double sum = 0.0;
      for (std::size_t cell = 0; cell < map.size(); ++cell) sum += map.number(cell, bands_[b] + "_total");
      if (!periodic()) continue;
      const double down = plane["down"][b];
      EXPECT_NEAR(sum / static_cast<double>(map.size()), down, 10.0 * table_rounding * down);
    }
  }
  if (text_.find("[[sensor]]") == std::string::npos) return;
  const Table sensors(file("sensors.csv"));
  std::string columns;
  for (const json& band : summary_["bands"]) {
    for (const std::string figure : {"_direct", "_sky", "_scattered", "_total", "_total_umol_m2_s"}) {
      if (figure == "_total_umol_m2_s" && !band.contains("umol_m2_s")) continue;
      columns += "," + band["name"].get<std::string>() + figure + "," + band["name"].get<std::string>() + figure + "_error";
    }
  }
  EXPECT_EQ(sensors.header(), "sensor,point,x,y,z" + columns);
  EXPECT_EQ(Table(file("sensor_means.csv")).header(), "sensor,points" + columns);
  for (std::size_t row = 0; row < sensors.size(); ++row) {
    for (const std::string& band : bands_) EXPECT_GE(sensors.number(row, band + "_sky"), 0.0);
  }
}

void Scenes::expect_agreement() const {
  const Table profile(file("profile.csv"));
  const Table organs(file("organs.csv"));
  const Table triangles(file("triangles.csv"));
  const double plot_m2 = summary_["plot_area_m2"];
  for (std::size_t b = 0; b < bands_.size(); ++b) {
    const std::string& band = bands_[b];
    double absorbed = 0.0;
    double absorbed_by_structures = 0.0;
    double direct = 0.0;
    for (std::size_t o = 0; o < organs.size(); ++o) {
      const double area_m2 = organs.number(o, "area_m2");
      direct += area_m2 * organs.number(o, band + "_direct") / plot_m2;
      const std::string role = organs.cell(o, "role");
      if (role == "soil") continue;
      (role == "structure" || role == "lamp" ? absorbed_by_structures : absorbed) +=
          area_m2 * organs.number(o, band + "_absorbed") / plot_m2;
    }
    double direct_of_triangles = 0.0;
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      direct_of_triangles += triangles.number(t, "area_m2") / plot_m2 *
                             (triangles.number(t, band + "_direct_upper") + triangles.number(t, band + "_direct_lower"));
    }
    double absorbed_in_layers = 0.0;
    double by_structures_in_layers = 0.0;
    for (std::size_t k = 0; k + 1 < profile.size(); ++k) {
      absorbed_in_layers += profile.number(k, band + "_absorbed");
      by_structures_in_layers += profile.number(k, band + "_absorbed_structure");
    }
    const json& balance = summary_["bands"][b];
    const double incident = balance["incident"];
    EXPECT_NEAR(absorbed, balance["absorbed_vegetation"], table_rounding * incident);
    EXPECT_NEAR(absorbed_in_layers, balance["absorbed_vegetation"], table_rounding * incident);
    EXPECT_NEAR(absorbed_by_structures, balance["absorbed_structure"], table_rounding * incident);
    EXPECT_NEAR(by_structures_in_layers, balance["absorbed_structure"], table_rounding * incident);
    EXPECT_NEAR(direct, direct_of_triangles, table_rounding * incident);
    if (periodic()) {
      if (!has_sky()) {
        const double on_ground = summary_["ground_sunfleck_ratio"];
        EXPECT_NEAR(direct, incident * (1.0 - on_ground), table_rounding * incident);
        EXPECT_GE(profile.number(0, band + "_down"), incident * on_ground * (1.0 - table_rounding));
      }
      // The flux that goes down through a plane and does not come up again is absorbed below it, leaves the stand there, or is
      // unshot.
      double below = double{balance["absorbed_soil"]} + double{balance["transmitted"]};
      for (std::size_t k = 0; k < profile.size(); ++k) {
        const double net = profile.number(k, band + "_down") - profile.number(k, band + "_up");
        EXPECT_NEAR(net, below, double{balance["unshot"]} + table_rounding * incident) << k;
        if (k + 1 < profile.size()) {
          below += profile.number(k, band + "_absorbed") + profile.number(k, band + "_absorbed_structure");
        }
      }
    }
  }
  double leaf_area_index = 0.0;
  for (std::size_t k = 0; k < profile.size(); ++k) {
    if (summary_["sun"].is_null()) {
      EXPECT_EQ(profile.cell(k, "sunfleck_ratio"), "") << "no beam, no share of it";
    }
    const double ratio = summary_["sun"].is_null() ? 1.0 : profile.number(k, "sunfleck_ratio");
    EXPECT_TRUE(ratio >= 0.0 && ratio <= 1.0) << k;
    // Under an endless canopy no light enters from the side; beside an isolated stand it does.
    if (periodic() && k > 0 && !summary_["sun"].is_null()) {
      EXPECT_GE(ratio, profile.number(k - 1, "sunfleck_ratio")) << k;
    }
    if (k + 1 < profile.size()) leaf_area_index += profile.number(k, "leaf_area_index");
  }
  EXPECT_NEAR(leaf_area_index, summary_["leaf_area_index"], table_rounding * leaf_area_index);
  if (summary_["sun"].is_null()) return;
  EXPECT_NEAR(profile.number(0, "sunfleck_ratio"), summary_["ground_sunfleck_ratio"], periodic() ? table_rounding : 1.0);
}

// One run of each scene serves all three.
TEST_P(Scenes, GiveWhatTheManualPromises) {
  expect_what_the_manual_promises();
  expect_what_receivers_saw();
  expect_agreement();
}

INSTANTIATE_TEST_SUITE_P(All, Scenes, ::testing::ValuesIn(scene_names()),
                         [](const ::testing::TestParamInfo<std::string>& scene) { return scene.param; });

}  // namespace
}  // namespace sunfleck::regression
