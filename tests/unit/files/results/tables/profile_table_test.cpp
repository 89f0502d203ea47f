#include "files/results/tables/profile_table.h"

#include "base/error.h"
#include "base/units.h"
#include "files/results/tables/result_tables.h"
#include "files/results/tables/table_text.h"
#include "support/error_text.h"
#include "support/temp_folder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace sunfleck {
namespace {

// Returns planes at 0, 1 and 2 m, of which 0.2, 0.6 and 1 are in the sun.
RadiationModel model_of_two_bands() {
  RadiationModel model;
  model.bands = {{"PAR", 100.0, 0.0}, {"NIR_1", 200.0, 0.0}};
  return model;
}

RadiationResult two_layers() {
  const std::vector<Estimate> through{{1.0, 0.1}, {2.0, 0.2}};
  RadiationResult result;
  result.layers = {{0.0,
                    1.0,
                    {0.2, 0.01},
                    {no_value, no_value},
                    through,
                    through,
                    {{10.0, 1.0}, {20.0, no_value}},
                    {{0.5, 0.1}, {1.5, 0.2}}},
                   {1.0, 2.0, {0.6, 0.02}, {0.5, 0.1}, through, through, {{30.0, 3.0}, {40.0, 4.0}}, {{0.0, 0.0}, {0.0, 0.0}}},
                   {2.0, 0.0, {1.0, 0.0}, {no_value, no_value}, through, through, {}, {}}};
  return result;
}

class Profile : public testing::Test {
 protected:
  [[nodiscard]] std::string message(const std::string& text) const {
    const std::string what = refusal_of([&] { static_cast<void>(read_profile_csv(folder_.write("profile.csv", text))); });
    return what.substr(what.find("profile.csv"));
  }
  TempFolder folder_;
};

void expect_equal(const Estimate& got, const Estimate& expected) {
  EXPECT_EQ(got.value, expected.value);
  EXPECT_TRUE(got.half_width == expected.half_width || (std::isnan(got.half_width) && std::isnan(expected.half_width)));
}

TEST_F(Profile, IsReadAsItWasWritten) {
  RunRecord record;
  record.title = "Stand, dense";
  const RadiationModel model = model_of_two_bands();
  const ProfileTable expected = profile_table(record.title, 0.95, model, two_layers());
  const std::string text = csv_text(record, layers_table(model, two_layers()));
  const ProfileTable got = read_profile_csv(folder_.write("profile.csv", text));
  EXPECT_EQ(got.title, expected.title);
  EXPECT_EQ(got.confidence, expected.confidence);
  EXPECT_EQ(got.bands, expected.bands);
  ASSERT_EQ(got.rows.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(got.rows[i].height_m, expected.rows[i].height_m);
    expect_equal(got.rows[i].sunfleck_ratio, expected.rows[i].sunfleck_ratio);
    ASSERT_EQ(got.rows[i].absorbed.size(), expected.rows[i].absorbed.size());
    for (std::size_t b = 0; b < got.rows[i].absorbed.size(); ++b)
      expect_equal(got.rows[i].absorbed[b], expected.rows[i].absorbed[b]);
  }
}

TEST_F(Profile, OfAnotherKindIsRefused) {
  const std::string head = "height_m,sunfleck_ratio,sunfleck_ratio_error,PAR_absorbed,PAR_absorbed_error\n";
  EXPECT_EQ(message("height_m,ratio\n0,1\n"),
            "profile.csv:1: no column sunfleck_ratio (it is required); use a file as written by this program");
  EXPECT_EQ(message("# x\nheight_m,sunfleck_ratio,sunfleck_ratio_error,PAR_absorbed\n0,1,0,1\n1,1,0,1\n"),
            "profile.csv:2: no column PAR_absorbed_error (it is required); use a file as written by this program");
  EXPECT_EQ(message(head + "0,1,0,1,1\n").substr(0, 27), "profile.csv:2: only one row");
  EXPECT_EQ(message(head + "1,1,0,1,1\n1,1,0,,\n"),
            "profile.csv:3: height_m = 1 (heights must ascend from the ground); use a file as written by this program");
  EXPECT_EQ(message(head + ",1,0,1,1\n1,1,0,,\n").substr(0, 32), "profile.csv:2: height_m is empty");
  EXPECT_THROW(static_cast<void>(read_profile_csv(folder_ / "missing" / "profile.csv")), Error);
}

TEST(SunfleckRatioAt, IsLinearBetweenPlanes) {
  const ProfileTable profile = profile_table("", 0.95, model_of_two_bands(), two_layers());
  EXPECT_DOUBLE_EQ(sunfleck_ratio_at(profile, 0.0), 0.2);
  EXPECT_DOUBLE_EQ(sunfleck_ratio_at(profile, 0.25), 0.3);
  EXPECT_DOUBLE_EQ(sunfleck_ratio_at(profile, 1.0), 0.6);
  EXPECT_DOUBLE_EQ(sunfleck_ratio_at(profile, 1.5), 0.8);
  EXPECT_DOUBLE_EQ(sunfleck_ratio_at(profile, 2.0), 1.0);
  EXPECT_DOUBLE_EQ(sunfleck_ratio_at(profile, 50.0), 1.0);
  EXPECT_DOUBLE_EQ(sunfleck_ratio_at(profile, -1.0), 0.2);
}

TEST(SunfleckRatioAt, ComparesWithFieldData) {
  ProfileTable profile = profile_table("", 0.95, model_of_two_bands(), two_layers());
  MeasuredProfile measured{"field.csv", {{0.25, 0.3}, {1.5, 0.8}, {9.0, 1.0}}};
  const Agreement exact = agreement(profile, measured);
  EXPECT_EQ(exact.n, 3U);
  EXPECT_NEAR(exact.r2, 1.0, 1e-12);
  EXPECT_NEAR(exact.slope, 1.0, 1e-12);
  EXPECT_NEAR(exact.rmse, 0.0, 1e-12);
  for (ProfileTable::Row& row : profile.rows) row.sunfleck_ratio.value = no_value;
  EXPECT_THROW(static_cast<void>(agreement(profile, measured)), Error);
}

}  // namespace
}  // namespace sunfleck
