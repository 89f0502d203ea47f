// Tests ten million triangles: the run needs as much memory as the program forecasts, the numbers are right, and messages
// name the limits.
#include "regression/program.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <cstring>

namespace sunfleck::regression {
namespace {

// Returns level triangles, each half of its own cell of a grid of 1000 x 100 over 1 m x 0.1 m.
std::string level_triangles() {
  constexpr std::uint32_t count = 100'000;
  std::string stl(80, ' ');
  const auto add = [&](const auto& value) { stl.append(reinterpret_cast<const char*>(&value), sizeof value); };
  add(count);
  for (std::uint32_t k = 0; k < count; ++k) {
    const std::uint32_t row = k / 1000;
    const float x = static_cast<float>(k % 1000) * 1e-3F;
    const float z = static_cast<float>(row) * 1e-3F;
    const float y = 0.1F + static_cast<float>(k % 7) * 0.1F;
    for (const float value : {0.0F, 1.0F, 0.0F, x, y, z, x, y, z + 1e-3F, x + 1e-3F, y, z}) add(value);
    add(std::uint16_t{0});
  }
  return stl;
}

class LargeScenes : public ProgramTest {
 protected:
  void SetUp() override {
    folder_.write("level.stl", level_triangles());
    std::string at;
    for (int k = 0; k < 100; ++k) {
      const int row = k / 10;
      at += fmt::format("{}[{}.0, 0.0, {:.1f}]", k > 0 ? ", " : "", k % 10, 0.1 * row);
    }
    folder_.write("scene.toml",
                  "[plot]\nsize = [10.0, 1.0]\n[sun]\nelevation = 90.0\nazimuth = 0.0\n[[band]]\nname = \"PAR\"\n"
                  "direct = 1.0\n[soil]\nreflectance = 0.0\n[optics.leaf]\nreflectance = 0.0\n[[geometry]]\n"
                  "file = \"level.stl\"\noptics = \"leaf\"\ninstances = false\nat = [" +
                      at + "]\n");
  }
};

TEST_F(LargeScenes, TenMillionTriangles) {
  for (const char* device : {"cpu", "lavapipe"}) {
    const Arguments work{"--device", device, "--grid", "0.005", "--passes", "8"};
    const Outcome info = run(Arguments{"info", "--json", "scene.toml"} + work);
    ASSERT_EQ(info.status, 0) << info.err;
    const auto told = nlohmann::json::parse(info.out);
    EXPECT_EQ(told["triangles"], 10'000'000);
    EXPECT_NEAR(told["area_m2"].get<double>(), 5.0, 1e-3);
    const Outcome ran = simulate("scene.toml", work + Arguments{"--images", "none"});
    EXPECT_EQ(summary()["triangles"], 10'000'000);
    EXPECT_NEAR(summary()["bands"][0]["absorbed_vegetation"].get<double>(), 0.5, 0.01) << device;
    EXPECT_EQ(summary()["lost_rays"], 0);
    const double said_mib = told["memory_without_pictures_bytes"].get<double>() / 1048576.0;
    std::printf("%s: %.0f MiB, %.0f MiB said\n", device, ran.peak_mib, said_mib);
    EXPECT_LT(ran.peak_mib, 1.15 * said_mib) << device;
    EXPECT_GT(ran.peak_mib, 0.7 * said_mib) << device;
  }
}

// If there is less memory than needed, one line reports it.
TEST_F(LargeScenes, TooLittleMemoryIsSaid) {
  const rlim_t before = [] {
    rlimit limit{};
    EXPECT_EQ(::getrlimit(RLIMIT_AS, &limit), 0);
    const rlim_t soft = limit.rlim_cur;
    limit.rlim_cur = rlim_t{1} << 30U;
    EXPECT_EQ(::setrlimit(RLIMIT_AS, &limit), 0);
    return soft;
  }();
  const Outcome outcome = run({"run", "scene.toml", "-o", "out", "--device", "cpu", "--images", "none"});
  rlimit limit{};
  EXPECT_EQ(::getrlimit(RLIMIT_AS, &limit), 0);
  limit.rlim_cur = before;
  EXPECT_EQ(::setrlimit(RLIMIT_AS, &limit), 0);
  expect_one_error(outcome, 1, "memory");
}

}  // namespace
}  // namespace sunfleck::regression
