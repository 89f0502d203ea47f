#include "files/results/stores/result_store.h"

#include "base/file.h"
#include "base/packed_array.h"
#include "support/scene_text.h"
#include "support/temp_folder.h"

#include <gtest/gtest.h>

#include <functional>
#include <string>

namespace sunfleck {
namespace {

using nlohmann::json;

// Returns three triangles of two organs over four cells of soil, with two bands, a beam and a sky.
Scene small_scene() {
  Scene scene;
  scene.title = "A \"small\" scene, 60 × 60 cm";
  scene.digest = "0123456789abcdef";
  scene.camera = CameraPose{{3.0, 2.0, 1.0}, {0.1, 0.2, 0.3}, 0.7};
  RadiationModel& model = scene.model;
  model.plot = {1.0, 1.0, true};
  model.layers = 3;
  model.canopy.origin_m = {0.5, 0.25, 0.5};
  model.canopy.period_m = {1.0, 1.0};
  for (int k = 0; k < 3; ++k) {
    const auto shift = 0.1F * static_cast<float>(k);
    model.canopy.corners.push_back({{{shift, 0.5F, 0.0F}, {shift, 0.5F, 0.3F}, {shift + 0.3F, 0.6F, 0.0F}}});
  }
  model.canopy.organ_of = {0, 1, 1};
  model.canopy.optics_of = {1, 0, 1};
  model.canopy.organs = {{1, "leaf", 7}, {2, "stem", 0}};
  model.canopy.optics_names = {"leaf", "lamp"};
  model.optics = {{"leaf", {{0.1, 0.2}, {0.4, 0.4}}, {{0.3, 0.1}, {0.5, 0.25}}, {0.1, 0.2, 0.3}, {}},
                  {"lamp", {{0.0, 0.0}, {0.0, 0.0}}, {{0.0, 0.0}, {0.0, 0.0}}, {1.0, 1.0, 1.0}, {5.0, 0.0}}};
  model.bands = {{"PAR", 350.0, 60.0}, {"NIR", 400.0, 0.0}};
  model.soil = Soil{{0.15, 0.3}, 0.5, {0.2, 0.15, 0.1}};
  model.sun = SunPosition{0.9, 2.1};
  model.sky = SkyModel{};
  return scene;
}

RadiationResult small_result() {
  RadiationResult result;
  result.leaf_area_index = 1.0 / 3.0;
  result.ground_per_ray_m2 = 1.1e-6;
  result.w_per_quantum = {1e-9, 3e-10};
  result.direct.rays = 123456789012;
  result.direct.relative_error = 0.00123;
  result.indirect.packets = 77;
  result.indirect.sky_rays = 4000000000000;
  result.elements = {{1, 2}, {3, 4}, {5000000000, 0}};
  result.soil_cells = {9, 8, 7, 6};
  for (int k = 0; k < 12; ++k) result.side_indirect.push_back(1000000000000 * k);
  for (int k = 0; k < 8; ++k) result.cell_indirect.push_back(10 * k);
  result.side_sky.assign(12, 4);
  result.cell_sky.assign(8, 5);
  return result;
}

class ResultStore : public ::testing::Test {
 protected:
  void SetUp() override {
    RunRecord record;
    record.version = "1.2.3";
    record.seed = 42;
    record.complete = false;
    write_result_store(file_, record, small_scene(), small_result());
    bytes_ = read_file(file_);
  }
  [[nodiscard]] std::optional<std::string> refusal(const std::string& bytes) const {
    return message_of([&] { static_cast<void>(parse_result_store(bytes, file_)); });
  }
  // Returns the file with one change.
  [[nodiscard]] std::string changed(const std::function<void(json&)>& change) const {
    json store = json::from_cbor(bytes_);
    change(store);
    std::string bytes;
    json::to_cbor(store, bytes);
    return bytes;
  }

  TempFolder folder_;
  std::filesystem::path file_ = folder_ / "pictures.cbor";
  std::string bytes_;
};

TEST_F(ResultStore, GivesTheSceneBack) {
  const StoredResult stored = read_result_store(file_);
  const Scene expected = small_scene();
  EXPECT_EQ(stored.seed, 42U);
  EXPECT_FALSE(stored.complete);
  EXPECT_EQ(stored.scene.title, expected.title);
  EXPECT_EQ(stored.scene.digest, expected.digest);
  ASSERT_TRUE(stored.scene.camera);
  EXPECT_EQ(stored.scene.camera->position_m, expected.camera->position_m);
  EXPECT_EQ(stored.scene.camera->look_at_m, expected.camera->look_at_m);
  EXPECT_EQ(stored.scene.camera->fov_rad, expected.camera->fov_rad);
  const RadiationModel& model = stored.scene.model;
  EXPECT_EQ(model.plot.size_x_m, 1.0);
  EXPECT_TRUE(model.plot.periodic);
  EXPECT_EQ(model.layers, 3);
  EXPECT_EQ(model.canopy.origin_m, expected.model.canopy.origin_m);
  EXPECT_EQ(model.canopy.period_m, expected.model.canopy.period_m);
  EXPECT_EQ(model.canopy.corners, expected.model.canopy.corners);
  EXPECT_EQ(model.canopy.organ_of, expected.model.canopy.organ_of);
  EXPECT_EQ(model.canopy.optics_of, expected.model.canopy.optics_of);
  EXPECT_EQ(model.canopy.organs, expected.model.canopy.organs);
  EXPECT_EQ(model.canopy.optics_names, expected.model.canopy.optics_names);
  ASSERT_EQ(model.optics.size(), 2U);
  EXPECT_EQ(model.optics[0].lower[1].transmittance, 0.25);
  EXPECT_EQ(model.optics[0].rgb, expected.model.optics[0].rgb);
  EXPECT_EQ(model.optics[1].emission_w_m2, expected.model.optics[1].emission_w_m2);
  ASSERT_EQ(model.bands.size(), 2U);
  EXPECT_EQ(model.bands[0].name, "PAR");
  EXPECT_EQ(model.bands[0].diffuse_w_m2, 60.0);
  ASSERT_TRUE(model.soil && model.sun && model.sky);
  EXPECT_EQ(model.soil->reflectance, expected.model.soil->reflectance);
  EXPECT_EQ(model.soil->rgb, expected.model.soil->rgb);
  EXPECT_EQ(model.sun->azimuth_rad, 2.1);
}

TEST_F(ResultStore, GivesTheResultBack) {
  const RadiationResult result = read_result_store(file_).result;
  const RadiationResult expected = small_result();
  EXPECT_EQ(result.leaf_area_index, expected.leaf_area_index);
  EXPECT_EQ(result.ground_per_ray_m2, expected.ground_per_ray_m2);
  EXPECT_EQ(result.w_per_quantum, expected.w_per_quantum);
  EXPECT_EQ(result.direct.rays, expected.direct.rays);
  EXPECT_EQ(result.direct.relative_error, expected.direct.relative_error);
  EXPECT_EQ(result.indirect.packets, expected.indirect.packets);
  EXPECT_EQ(result.indirect.sky_rays, expected.indirect.sky_rays);
  EXPECT_EQ(result.indirect.relative_error, std::nullopt);
  ASSERT_EQ(result.elements.size(), 3U);
  EXPECT_EQ(result.elements[2].upper, 5000000000U);
  EXPECT_EQ(result.elements[1].lower, 4U);
  EXPECT_EQ(result.soil_cells, expected.soil_cells);
  EXPECT_EQ(result.side_indirect, expected.side_indirect);
  EXPECT_EQ(result.cell_indirect, expected.cell_indirect);
  EXPECT_EQ(result.side_sky, expected.side_sky);
  EXPECT_EQ(result.cell_sky, expected.cell_sky);
}

TEST_F(ResultStore, KeepsTheAxes) {
  EXPECT_EQ(read_result_store(file_).scene.model.plot.axes, Axes::south_up_west);
  EXPECT_FALSE(json::from_cbor(bytes_).at("model").at("plot").contains("axes"));
  Scene scene = small_scene();
  scene.model.plot.axes = Axes::east_north_up;
  write_result_store(file_, {}, scene, small_result());
  EXPECT_EQ(read_result_store(file_).scene.model.plot.axes, Axes::east_north_up);
  expect_three_parts(refusal(changed([](json& store) { store["model"]["plot"]["axes"] = 2; })).value_or(""));
}

TEST_F(ResultStore, KeepsABareScene) {
  Scene scene;
  scene.model.bands = {{"PAR", 1.0, 0.0}};
  write_result_store(file_, {}, scene, {});
  const StoredResult stored = read_result_store(file_);
  EXPECT_EQ(stored.scene.model.canopy.size(), 0U);
  EXPECT_FALSE(stored.scene.model.soil || stored.scene.model.sun || stored.scene.model.sky || stored.scene.camera);
  EXPECT_TRUE(stored.result.side_indirect.empty());
}

TEST_F(ResultStore, CutShortIsRefusedAtEveryLength) {
  for (std::size_t length = 0; length < bytes_.size(); length += length < 200 ? 1 : 7) {
    const auto message = refusal(bytes_.substr(0, length));
    ASSERT_TRUE(message) << length;
    expect_three_parts(*message);
  }
  EXPECT_FALSE(refusal(bytes_));
}

// A changed byte may be harmless, or give another valid number; nothing worse may happen.
TEST_F(ResultStore, WithAnyByteChangedIsReadOrRefused) {
  std::size_t refused = 0;
  for (const char change : {'\x01', '\x80', '\xff'}) {
    for (std::size_t at = 0; at < bytes_.size(); ++at) {
      std::string bytes = bytes_;
      bytes[at] = static_cast<char>(bytes[at] ^ change);
      const auto message = refusal(bytes);
      if (!message) continue;
      expect_three_parts(*message);
      ++refused;
    }
  }
  EXPECT_GT(refused, 2 * bytes_.size()) << "of three changes a byte";
}

TEST_F(ResultStore, OfAnotherKindOrVersionIsNamed) {
  EXPECT_NE(refusal(changed([](json& s) { s["format"] = "other"; }))->find("a different kind"), std::string::npos);
  EXPECT_NE(
      refusal(changed([](json& s) { s["version"] = 1; }))->find("it has version 1, but this program reads versions 2 to 3"),
      std::string::npos);
  EXPECT_NE(refusal("no CBOR at all")->find("damaged"), std::string::npos);
  EXPECT_TRUE(refusal(std::string(1 << 20, '\x81'))) << "a million lists within each other";
}

TEST_F(ResultStore, WithNumbersThatCannotBeDrawnIsRefused) {
  const std::vector<std::function<void(json&)>> changes = {
      [](json& s) { s["model"].erase("plot"); },
      [](json& s) { s["model"]["plot"]["size_x_m"] = 0.0; },
      [](json& s) { s["model"]["plot"]["size_x_m"] = "wide"; },
      [](json& s) { s["model"]["plot"]["size_z_m"] = std::numeric_limits<double>::quiet_NaN(); },
      [](json& s) { s["model"]["plot"]["size_z_m"] = 5.0; },  // implies another number of cells
      [](json& s) { s["model"]["soil"]["patch_m"] = 1e-300; },
      [](json& s) { s["model"]["bands"] = json::array(); },
      [](json& s) { s["model"]["layers"] = 0; },
      [](json& s) { s["model"]["triangles"] = std::uint64_t{1} << 62U; },
      [](json& s) { s["model"]["triangles"] = 2; },
      [](json& s) { s["model"]["triangles"] = -1; },
      [](json& s) {
        s["model"]["period_m"] = {0.0, 0.0};
      },
      [](json& s) {
        s["model"]["organ_of"] = pack(std::vector<std::uint32_t>{0, 1, 2});
      },
      [](json& s) {
        s["model"]["optics_of"] = pack(std::vector<std::uint16_t>{0, 1, 2});
      },
      [](json& s) { s["model"]["optics_of"] = "AAAA"; },
      [](json& s) { s["model"]["corners_m"] = pack(std::vector<float>(27, std::numeric_limits<float>::infinity())); },
      [](json& s) {
        s["model"]["optics"][0]["rgb"] = {0.1, 0.2};
      },
      [](json& s) {
        s["model"]["optics"][0]["upper"] = {{0.1, 0.2}};
      },
      [](json& s) { s["result"]["landings"] = pack(std::vector<std::uint64_t>(5)); },
      [](json& s) { s["result"]["cells"] = std::uint64_t{1} << 40U; },
      [](json& s) { s["result"]["w_per_quantum"] = {1.0}; },
      [](json& s) { s["result"]["w_per_quantum"] = json::array(); },
      [](json& s) { s["result"]["side_sky"] = pack(std::vector<std::int64_t>(13)); },
      [](json& s) { s["camera"]["look_at_m"] = s["camera"]["position_m"]; },
      [](json& s) { s["camera"]["fov_rad"] = 4.0; }};
  for (std::size_t k = 0; k < changes.size(); ++k) {
    const auto message = refusal(changed(changes[k]));
    ASSERT_TRUE(message) << k;
    expect_three_parts(*message);
  }
}

TEST_F(ResultStore, OfAnEarlierVersionIsRead) {
  const std::vector<std::int64_t> quanta = small_result().side_indirect;
  const std::string earlier = changed([&](json& s) {
    s["version"] = 2;
    const auto bytes = std::as_bytes(std::span(quanta));
    s["result"]["side_indirect"] = json::binary(deflated([&](const auto& take) { take(bytes); }, 1, bytes.size()));
  });
  EXPECT_EQ(parse_result_store(earlier, file_).result.side_indirect, quanta);
}

}  // namespace
}  // namespace sunfleck
