// Tests the memory of a run: --memory limits it, and `info` forecasts it.
#include "regression/program.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

namespace sunfleck::regression {
namespace {

using nlohmann::json;

class Memory : public ProgramTest {
 protected:
  // Prepares a stand of a thousand triangles under an overcast sky.
  void SetUp() override {
    std::mt19937 engine(1);
    const auto uniform = [&] { return static_cast<double>(engine()) / 4294967296.0; };
    std::string obj;
    for (int leaf = 0; leaf < 500; ++leaf) {
      const double x = 2.0 * uniform();
      const double y = uniform();
      const double z = 2.0 * uniform();
      const double turn = 2.0 * std::numbers::pi * uniform();
      const double c = 0.06 * std::cos(turn);
      const double s = 0.06 * std::sin(turn);
      for (const auto& [along, across] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
        obj += "v " + std::to_string(x + along * c - across * s) + " " + std::to_string(y + 0.03 * along) + " " +
               std::to_string(z + along * s + across * c) + "\n";
      }
      const std::string a = std::to_string(4 * leaf + 1) + " ";
      const std::string c3 = std::to_string(4 * leaf + 3) + " ";
      obj += "f " + a + std::to_string(4 * leaf + 2) + " " + c3 + "\nf " + a + c3 + std::to_string(4 * leaf + 4) + "\n";
    }
    folder_.write("stand.obj", obj);
    folder_.write("stand.toml", R"([plot]
size = [2.0, 2.0]
[sky]
model = "cie-overcast"
[[band]]
name    = "PAR"
diffuse = 100.0
[soil]
reflectance = 0.15
[optics.leaf]
reflectance   = 0.12
transmittance = 0.06
[[geometry]]
file   = "stand.obj"
optics = "leaf"
)");
  }

  // Returns the peaks of some runs in ascending order.
  [[nodiscard]] std::vector<double> peaks_mib(std::size_t runs, const std::filesystem::path& scene,
                                              const Arguments& more) const {
    std::vector<double> peaks(runs);
    for (double& peak_mib : peaks) peak_mib = simulate(scene, more).peak_mib;
    std::sort(peaks.begin(), peaks.end());
    return peaks;
  }

  // Returns the median peak of three runs: on a busy machine a thread may come too late to need memory of its own, or replicates
  // reach their peaks together that seldom do.
  [[nodiscard]] double usual_peak_mib(const std::filesystem::path& scene, const Arguments& more) const {
    return peaks_mib(3, scene, more)[1];
  }

  // Eight large replicates: their number is fixed, so that the test takes a few seconds.
  const Arguments tight_{"--device", "cpu", "--threads", "2", "--images", "none", "--passes", "8", "--indirect-error", "3e-4"};
};

TEST_F(Memory, OfReplicatesStaysBelowTheBound) {
  const Outcome small = simulate("stand.toml", tight_ + Arguments{"--memory", "5MB"});
  const Outcome bounded = simulate("stand.toml", tight_ + Arguments{"--memory", "40MB"});
  EXPECT_EQ(summary()["settings"]["memory_bytes"], 40'000'000);
  EXPECT_LT(bounded.peak_mib, small.peak_mib + 1.2 * 35.0) << "within a fifth of the additional memory";
  const double packets = summary()["indirect"]["first_round_packets"];
  simulate("stand.toml", tight_ + Arguments{"--memory", "20MB"});
  EXPECT_NEAR(summary()["indirect"]["first_round_packets"].get<double>() / packets, 0.5, 0.1);
}

// As long as memory holds several replicates comfortably, its size changes no result: runs can be repeated on machines with
// more memory and with less.
TEST_F(Memory, DoesNotDecideAboutResultsWhereThereIsEnough) {
  const Arguments work{"--device", "cpu", "--images", "none", "--error", "0.02"};
  simulate("stand.toml", work + Arguments{"--memory", "1GB"});
  const std::string organs = file("organs.csv");
  simulate("stand.toml", work + Arguments{"--memory", "8GB"});
  EXPECT_EQ(file("organs.csv"), organs);
}

TEST_F(Memory, BoundMakesMoreReplicatesReachTheSameError) {
  simulate("stand.toml", {"--device", "cpu", "--images", "none", "--error", "0.003"});
  const json free = summary();
  simulate("stand.toml", {"--device", "cpu", "--images", "none", "--error", "0.003", "--memory", "6MB"});
  const json bounded = summary();
  EXPECT_GT(bounded["direct"]["replicates"], free["direct"]["replicates"]);
  EXPECT_LT(bounded["indirect"]["first_round_packets"], free["indirect"]["first_round_packets"]);
  EXPECT_LE(bounded["indirect"]["relative_error"], 0.003);
}

TEST_F(Memory, IsForetoldByInfo) {
  const Arguments fixed{"--passes", "8", "--indirect-error", "3e-4", "--memory", "60MB"};
  const Arguments bounded{"--error", "0.02"};
  for (const Arguments& work :
       {fixed + Arguments{"--threads", "2"}, bounded + Arguments{"--threads", "2"}, bounded + Arguments{"--threads", "8"}}) {
    const Outcome info = run(Arguments{"info", "stand.toml", "--json", "--device", "cpu"} + work);
    ASSERT_EQ(info.status, 0) << info.err;
    for (const auto& [images, key] : {std::pair{"none", "memory_without_pictures_bytes"}, {"all", "memory_bytes"}}) {
      const double forecast_mib = json::parse(info.out)[key].get<double>() / 1048576.0;
      const double peak_mib = usual_peak_mib("stand.toml", Arguments{"--device", "cpu", "--images", images} + work);
      EXPECT_NEAR(forecast_mib / peak_mib, 1.0, 0.2) << forecast_mib << " MiB forecast, images " << images;
    }
  }
}

// Where nothing is scattered, two of the six usual pictures are drawn. A thread that comes late saves a seventh of so little memory,
// and nothing takes more than usual, so that the highest of some peaks is the one of a run on a quiet machine.
TEST_F(Memory, OfABlackSceneIsForetoldWithItsPictures) {
  const Arguments work{"--device", "cpu", "--threads", "2"};
  const Outcome info = run(Arguments{"info", scene_file("two_squares.toml"), "--json"} + work);
  ASSERT_EQ(info.status, 0) << info.err;
  const double forecast_mib = json::parse(info.out)["memory_bytes"].get<double>() / 1048576.0;
  EXPECT_NEAR(forecast_mib / peaks_mib(5, scene_file("two_squares.toml"), work).back(), 1.0, 0.15)
      << forecast_mib << " MiB forecast";
}

// 400 copies of the stand, which share its triangles. Of what 400,000 triangles take by themselves, corners and tree are saved:
// about 90 bytes each.
TEST_F(Memory, OfCopiesThatShareTrianglesIsForetoldToo) {
  std::string positions = "x,z,heading\n";
  for (int k = 0; k < 400; ++k) {
    positions += std::to_string(2 * (k / 20)) + "," + std::to_string(2 * (k % 20)) + "," + std::to_string(17 * k % 360) + "\n";
  }
  folder_.write("positions.csv", positions);
  std::string scene = content(folder_ / "stand.toml");
  scene.replace(scene.find("[2.0, 2.0]"), 10, "[40.0, 40.0]");
  scene += "positions = \"positions.csv\"\n";
  folder_.write("own.toml", scene);
  folder_.write("shared.toml", scene + "instances = true\n");
  const Arguments work{"--device", "cpu", "--threads", "2", "--error", "0.05"};
  const Outcome info = run(Arguments{"info", "shared.toml", "--json"} + work);
  ASSERT_EQ(info.status, 0) << info.err;
  const double forecast_mib = json::parse(info.out)["memory_without_pictures_bytes"].get<double>() / 1048576.0;
  const Outcome shared = simulate("shared.toml", work + Arguments{"--images", "none"});
  EXPECT_NEAR(forecast_mib / shared.peak_mib, 1.0, 0.2) << forecast_mib << " MiB forecast";
  const Outcome own = simulate("own.toml", work + Arguments{"--images", "none"});
  EXPECT_GT(own.peak_mib - shared.peak_mib, 60.0 * 400e3 / 1048576.0) << shared.peak_mib << " MiB";
}

// Light lands on a few of the four million cells of the soil's map. Only counters and the result have all of them: 36 bytes a
// cell, and sums of all cells would take as much again for the run and for each replicate in the making.
TEST_F(Memory, OfAWideMapIsThatOfWhereLightLands) {
  std::string scene = content(folder_ / "stand.toml");
  scene.replace(scene.find("[2.0, 2.0]"), 10, "[100.0, 100.0]");
  folder_.write("wide.toml", scene);
  const Outcome wide =
      simulate("wide.toml", {"--device", "cpu", "--threads", "2", "--images", "none", "--passes", "8", "--grid", "2"});
  EXPECT_LT(wide.peak_mib, 56.0 * 4e6 / 1048576.0);
}

TEST_F(Memory, BoundIsChecked) {
  expect_one_error(run({"run", "stand.toml", "--memory", "1kB"}), 2, "--memory");
  expect_one_error(run({"run", "stand.toml", "--memory", "much"}), 2, "--memory");
}

}  // namespace
}  // namespace sunfleck::regression
