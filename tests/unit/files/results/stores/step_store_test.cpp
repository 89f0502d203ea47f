#include "files/results/stores/step_store.h"

#include "base/error.h"
#include "base/file.h"
#include "base/units.h"
#include "support/error_text.h"
#include "support/temp_folder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>

namespace sunfleck {
namespace {

using nlohmann::ordered_json;

RadiationModel two_bands() {
  RadiationModel model;
  model.plot = {1.0, 1.0, true};
  model.canopy.corners = std::vector<Triangle>(3);
  model.canopy.organ_of = {0, 0, 1};
  model.canopy.optics_of = {0, 0, 0};
  model.canopy.organs.resize(2);
  model.canopy.optics_names = {"leaf"};
  model.canopy.plants = {{1, {0.5, 0.0, 0.5}}};
  model.bands.resize(2);
  model.sky = SkyModel{};
  model.planes = {{0.5, 2, 1}};
  model.sensors = {{"line", {{0.1, 0.0, 0.1}, {0.2, 0.0, 0.1}}}};
  return model;
}

StoredStep some_step(const RadiationModel& model) {
  StoredStep step;
  step.light = no_light(model);
  step.light.bands[1].reflected = {1.0 / 3.0, no_value};
  step.light.bands[1].unshot = 1e-300;
  step.light.organ_absorbed[3] = {0.1, std::numeric_limits<double>::denorm_min()};
  step.light.sunlit_leaf_fraction = {no_value, no_value};
  step.light.plant_absorbed_w[1] = {0.7, 0.1};
  step.fields.assign(2 * 8 * 3, 0.1F);
  step.light.kind_absorbed[1] = {{0.3, 0.01}, 0.001};
  step.light.points[3].scattered = {2.0, 0.5};
  step.light.sensors[1].total = {4.0, no_value};
  step.light.plane_sunfleck[0] = {0.25, 0.01};
  step.light.plane_down[1] = {7.0, 0.7};
  step.maps.assign(2 * 5, 0.3F);
  step.maps[1] = std::numeric_limits<float>::quiet_NaN();
  step.sensor_error = 0.01;
  step.fields[7] = std::numeric_limits<float>::quiet_NaN();
  step.next_work = {1e6 / 7.0, 0.1};
  step.rays = 1ULL << 40U;
  step.packets = 3;
  step.lost_rays = 1;
  step.indirect_error = 1.0 / 7.0;
  step.reached_bound = false;
  step.seconds = 0.25;
  return step;
}

const ordered_json day_settings{{"scene_digest", "0123"}, {"seed", 1}, {"step_min", 10}};

bool same_bits(double a, double b) {
  return std::memcmp(&a, &b, sizeof a) == 0;
}

class StepStoreTest : public ::testing::Test {
 protected:
  const RadiationModel model_ = two_bands();
  TempFolder folder_;
  StepStore store_{folder_.path(), model_, day_settings, StepFields::kept};
  const std::string step_file_ = "steps/step_00007.bin";
};

TEST_F(StepStoreTest, GivesBackWhatWasWritten) {
  store_.begin();
  const StepStore& store = store_;
  EXPECT_FALSE(store.read(7));
  const StoredStep step = some_step(model_);
  store.begin_write(7, step).get();
  const std::optional<StoredStep> read = store.read(7);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->light.bands[0].incident.half_width, 0.0);
  EXPECT_TRUE(same_bits(read->light.bands[1].reflected.value, 1.0 / 3.0));
  EXPECT_TRUE(std::isnan(read->light.bands[1].reflected.half_width));
  EXPECT_EQ(read->light.bands[1].unshot, 1e-300);
  EXPECT_EQ(read->light.organ_absorbed[3].half_width, std::numeric_limits<double>::denorm_min());
  EXPECT_TRUE(std::isnan(read->light.sunlit_leaf_fraction.value));
  ASSERT_EQ(read->light.plant_absorbed_w.size(), 2U);
  EXPECT_EQ(read->light.plant_absorbed_w[1].half_width, 0.1);
  ASSERT_EQ(read->fields.size(), step.fields.size());
  EXPECT_EQ(std::memcmp(read->fields.data(), step.fields.data(), step.fields.size() * sizeof(float)), 0);
  EXPECT_EQ(read->light.kind_absorbed[1].absorbed.value, 0.3);
  EXPECT_EQ(read->light.kind_absorbed[1].unshot, 0.001);
  ASSERT_EQ(read->light.points.size(), 4U);
  EXPECT_EQ(read->light.points[3].scattered.half_width, 0.5);
  ASSERT_EQ(read->light.sensors.size(), 2U);
  EXPECT_EQ(read->light.sensors[1].total.value, 4.0);
  EXPECT_TRUE(std::isnan(read->light.sensors[1].total.half_width));
  EXPECT_EQ(read->light.plane_sunfleck[0].value, 0.25);
  EXPECT_EQ(read->light.plane_down[1].half_width, 0.7);
  ASSERT_EQ(read->maps.size(), step.maps.size());
  EXPECT_EQ(std::memcmp(read->maps.data(), step.maps.data(), step.maps.size() * sizeof(float)), 0);
  EXPECT_EQ(read->sensor_error, 0.01);
  EXPECT_TRUE(same_bits(read->next_work.rays, step.next_work.rays));
  EXPECT_TRUE(same_bits(read->next_work.packets, step.next_work.packets));
  EXPECT_EQ(read->rays, step.rays);
  EXPECT_EQ(read->packets, 3U);
  EXPECT_EQ(read->lost_rays, 1U);
  EXPECT_FALSE(read->direct_error);
  EXPECT_EQ(read->indirect_error, step.indirect_error);
  EXPECT_FALSE(read->reached_bound);
  EXPECT_EQ(read->seconds, 0.25);
}

TEST_F(StepStoreTest, LeavesOutFieldsOfTriangles) {
  const StepStore small(folder_.path(), model_, day_settings, StepFields::none);
  store_.begin();
  store_.begin_write(7, some_step(model_)).get();
  const std::optional<StoredStep> read = store_.read(7, StepFields::none);
  ASSERT_TRUE(read);
  EXPECT_TRUE(read->fields.empty());
  EXPECT_EQ(read->maps.size(), 10U);
  StoredStep without = some_step(model_);
  without.fields.clear();
  small.begin_write(8, without).get();
  EXPECT_TRUE(small.read(8));
  EXPECT_FALSE(store_.read(8)) << "it has no fields";
}

TEST_F(StepStoreTest, WritesMeanwhileWhatItWasGiven) {
  store_.begin();
  StoredStep step = some_step(model_);
  std::future<void> writing = store_.begin_write(7, step);
  step.rays += 1;
  writing.get();
  const std::optional<StoredStep> read = store_.read(7);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->rays, some_step(model_).rays);
  std::filesystem::remove_all(folder_ / "steps");
  std::future<void> failing = store_.begin_write(7, step);
  EXPECT_THROW(failing.get(), Error);
}

TEST_F(StepStoreTest, ReadsNoStepThatIsDamaged) {
  store_.begin();
  store_.begin_write(7, some_step(model_)).get();
  const std::string good = read_file(folder_ / step_file_);
  for (std::size_t length = 0; length < good.size(); length += 1 + length / 8) {
    folder_.write(step_file_, good.substr(0, length));
    EXPECT_FALSE(store_.read(7)) << length << " bytes of " << good.size();
  }
  for (std::size_t at = 0; at < good.size(); ++at) {
    std::string bad = good;
    bad[at] = static_cast<char>(bad[at] ^ (1 << (at % 8)));
    folder_.write(step_file_, bad);
    EXPECT_FALSE(store_.read(7)) << "byte " << at;
  }
  folder_.write(step_file_, std::string(100000, '\x81'));
  EXPECT_FALSE(store_.read(7));
  folder_.write(step_file_, good);
  EXPECT_TRUE(store_.read(7));
}

TEST_F(StepStoreTest, ReadsNoStepOfAnotherDayOrNumber) {
  store_.begin();
  store_.begin_write(7, some_step(model_)).get();
  ordered_json other = day_settings;
  other["seed"] = 2;
  EXPECT_FALSE(StepStore(folder_.path(), model_, other, StepFields::kept).read(7));
  RadiationModel larger = model_;
  larger.canopy.corners = std::vector<Triangle>(4);
  larger.canopy.organ_of.push_back(1);
  larger.canopy.optics_of.push_back(0);
  EXPECT_FALSE(StepStore(folder_.path(), larger, day_settings, StepFields::kept).read(7));
  std::filesystem::rename(folder_ / step_file_, folder_ / "steps/step_00008.bin");
  EXPECT_FALSE(store_.read(8));
}

TEST_F(StepStoreTest, TellsWhatAnEarlierDayLeft) {
  EXPECT_EQ(store_.find(), StepStore::Found::nothing);
  store_.begin();
  EXPECT_EQ(store_.find(), StepStore::Found::begun);
  store_.begin_write(0, some_step(model_)).get();
  folder_.write("steps/step_fields.tmp", "half a file");
  folder_.write("steps/notes.txt", "of the user");
  EXPECT_EQ(StepStore(folder_.path(), model_, day_settings, StepFields::kept).find(), StepStore::Found::begun);
  store_.finish();
  EXPECT_EQ(store_.find(), StepStore::Found::finished);
  EXPECT_FALSE(store_.read(0));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "steps/step_fields.tmp"));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "steps/notes.txt"));
  store_.begin();
  EXPECT_EQ(store_.find(), StepStore::Found::begun);
}

TEST_F(StepStoreTest, RefusesADayInAnotherFormat) {
  store_.begin();
  const auto message = [&] { return refusal_of([&] { static_cast<void>(store_.find()); }); };
  for (const char* old : {"", ", \"format\": 2", ", \"format\": \"3\""}) {
    folder_.write("steps/settings.json",
                  std::string(R"({"scene_digest": "0123", "seed": 1, "step_min": 10, "finished": true)") + old + "}");
    EXPECT_NE(message().find("another version of the program stored that day"), std::string::npos) << old << message();
    expect_three_parts(message());
  }
}

TEST_F(StepStoreTest, NamesTheFirstSettingThatDiffers) {
  store_.begin();
  ordered_json other = day_settings;
  other["seed"] = 2;
  const auto message = [&](const ordered_json& now) {
    return refusal_of([&] { static_cast<void>(StepStore(folder_.path(), model_, now, StepFields::kept).find()); });
  };
  EXPECT_NE(message(other).find("seed was 1, now 2"), std::string::npos);
  other = day_settings;
  other["max_rays"] = 5;
  EXPECT_NE(message(other).find("max_rays was not given, now 5"), std::string::npos);
  other = day_settings;
  other.erase("step_min");
  EXPECT_NE(message(other).find("step_min was 10, now not given"), std::string::npos);
  folder_.write("steps/settings.json", "{\"seed\": 1");
  EXPECT_NE(message(day_settings).find("it is damaged"), std::string::npos);
}

}  // namespace
}  // namespace sunfleck
