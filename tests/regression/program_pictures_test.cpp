// Tests pictures as a user gets them: `run --images`, `render` from a folder and from a scene, PNG and EXR.

#include "regression/program.h"
#include "support/picture.h"
#include "support/table.h"

#include <tinyexr.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <map>

namespace sunfleck::regression {
namespace {

using Rgb = std::array<double, 3>;
using Pixel = test::Picture::Pixel;

// A level plate and one that rises towards the south; they are black in the band but coloured for the eye, with nothing below
// them.
constexpr const char* plates_scene = R"(title = "Two plates"
[plot]
size     = [2.0, 1.0]
periodic = false
[sun]
elevation = 80.0
azimuth   = 90.0
[[band]]
name   = "PAR"
direct = 100.0
[optics.level]
reflectance = 0.0
rgb         = [0.10, 0.50, 0.05]
[optics.slope]
reflectance = 0.0
rgb         = [0.40, 0.20, 0.10]
[[geometry]]
file = "plates.obj"
)";
constexpr const char* plates_obj =
    "v 0 0.5 0\nv 0 0.5 1\nv 1 0.5 1\nv 1 0.5 0\nv 1.1 0.2 0\nv 1.1 0.2 1\nv 1.9 1 1\nv 1.9 1 0\n"
    "usemtl level\nf 1 2 3 4\nusemtl slope\nf 5 6 7 8\n";

// The same plates over bright soil, in an endless plot.
constexpr const char* bright_scene = R"(title = "Two plates over soil"
[plot]
size = [2.0, 1.0]
[sun]
elevation = 50.0
azimuth   = 120.0
[[band]]
name   = "PAR"
direct = 100.0
[[band]]
name   = "NIR"
direct = 80.0
[soil]
reflectance = 0.3
[optics.level]
reflectance   = { PAR = 0.2, NIR = 0.4 }
transmittance = { PAR = 0.1, NIR = 0.4 }
[optics.slope]
reflectance = 0.5
[[geometry]]
file = "plates.obj"
)";

const Arguments quick_picture{"--device", "cpu", "--passes", "8", "--grid", "0.02", "--size", "320x240"};

class Pictures : public ProgramTest {
 protected:
  void SetUp() override {
    folder_.write("plates.toml", plates_scene);
    folder_.write("bright.toml", bright_scene);
    folder_.write("plates.obj", plates_obj);
  }
  void draw(const Arguments& more) const {
    const Outcome outcome = run(Arguments{"render", "--device", "cpu", "--size", "320x240"} + more);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
  }
};

std::map<Pixel, int> pixels_by_colour(const std::filesystem::path& file) {
  const test::Picture picture = test::read_picture(file);
  std::map<Pixel, int> count;
  for (const Pixel& pixel : picture.pixels) ++count[pixel];
  return count;
}

unsigned char srgb(double linear) {
  const double c = std::clamp(linear, 0.0, 1.0);
  return static_cast<unsigned char>(std::lround(255.0 * (c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1 / 2.4) - 0.055)));
}

// Computes the manual's formulas (src/pictures/drawing/tone_map.h) from the table of triangles. Only upper faces are lit; each
// triangle is more than 0.5 % of the total area, so L995 is the largest luminance.
TEST_F(Pictures, OfHueMappingHaveColoursWorkedOutByHand) {
  simulate("plates.toml",
           quick_picture + Arguments{"--samples", "1", "--view", "top", "--images", "hue_direct", "--export", "csv"});
  const Table triangles(file("triangles.csv"));
  ASSERT_EQ(triangles.size(), 4U);
  std::array<double, 4> irradiance{};
  double logs = 0.0;
  double area = 0.0;
  for (std::size_t t = 0; t < 4; ++t) {
    irradiance[t] = triangles.number(t, "PAR_direct_upper");
    ASSERT_GT(irradiance[t], 50.0);
    ASSERT_EQ(triangles.number(t, "PAR_direct_lower"), 0.0);
    logs += triangles.number(t, "area_m2") * std::log(irradiance[t]);
    area += triangles.number(t, "area_m2");
  }
  const double log_mean = std::exp(logs / area);
  const auto reflectance = [](std::size_t t) { return t < 2 ? Rgb{0.10, 0.50, 0.05} : Rgb{0.40, 0.20, 0.10}; };
  const auto luminance = [&](std::size_t t) {
    const Rgb rgb = reflectance(t);
    return (0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2]) * irradiance[t] / log_mean;
  };
  double white = 0.0;
  for (std::size_t t = 0; t < 4; ++t) white = std::max(white, 1.25 * luminance(t));
  const std::map<Pixel, int> seen = pixels_by_colour(folder_ / "out" / "hue_direct.png");
  for (std::size_t t = 0; t < 4; ++t) {
    const double l = luminance(t);
    const double factor = irradiance[t] / log_mean * (1.0 + l / (white * white)) / (1.0 + l);
    Pixel expected{};
    for (std::size_t i = 0; i < 3; ++i) expected[i] = srgb(reflectance(t)[i] * factor);
    const auto found = seen.find(expected);
    EXPECT_TRUE(found != seen.end() && found->second > 1000)
        << t << ": " << int{expected[0]} << ' ' << int{expected[1]} << ' ' << int{expected[2]};
  }
}

TEST_F(Pictures, FromAFolderAreThoseOfTheRun) {
  simulate("bright.toml", quick_picture + Arguments{"--images", "all,map_absorbed,rank-interval_total", "--repeat", "3"});
  for (const char* chart : {"rank", "hue"}) {
    for (const char* field : {"direct", "indirect", "total"}) {
      draw({"out", "--chart", chart, "--field", field, "--repeat", "3", "-o", "again.png"});
      const std::string name = std::string(chart) + "_" + field + ".png";
      ASSERT_TRUE(exists(name)) << name;
      EXPECT_EQ(content(folder_ / "again.png"), file(name)) << name;
    }
  }
  draw({"out", "--chart", "map", "--field", "absorbed", "--repeat", "3", "-o", "again.png"});
  EXPECT_EQ(content(folder_ / "again.png"), file("map_absorbed.png"));
  draw({"out", "--chart", "rank-interval", "--repeat", "3", "-o", "again.png"});
  EXPECT_EQ(content(folder_ / "again.png"), file("rank-interval_total.png"));
}

// The line below a chart states its numbers of rays, packets and sky rays.
TEST_F(Pictures, OfSkyLightFromAFolderAreThoseOfTheRun) {
  std::string sky_scene = bright_scene;
  for (const char* beam : {"direct = 100.0\n", "direct = 80.0\n"}) {
    sky_scene.replace(sky_scene.find(beam), std::strlen(beam), std::string(beam) + "diffuse = 40.0\n");
  }
  folder_.write("sky.toml", sky_scene + "[sky]\nmodel = \"uniform\"\n");
  simulate("sky.toml", quick_picture + Arguments{"--images", "all,rank_sky,map_scattered,hue_absorbed"});
  EXPECT_GT(summary()["indirect"]["sky_rays"], 0);
  const std::vector<std::pair<std::string, std::string>> pictures = {
      {"rank", "direct"}, {"rank", "indirect"}, {"hue", "total"}, {"rank", "sky"}, {"map", "scattered"}, {"hue", "absorbed"}};
  for (const auto& [chart, field] : pictures) {
    draw({"out", "--chart", chart, "--field", field, "-o", "again.png"});
    const std::string name = chart + "_" + field + ".png";
    ASSERT_TRUE(exists(name)) << name;
    EXPECT_TRUE(content(folder_ / "again.png") == file(name)) << name;
  }
}

TEST_F(Pictures, FromASceneAreThoseOfTheRun) {
  simulate("bright.toml", quick_picture + Arguments{"--seed", "5", "--images", "rank_total", "--band", "NIR"});
  const Outcome outcome = run(Arguments{"render", "bright.toml", "--seed", "5", "--band", "NIR"} + quick_picture);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "bright_rank_total.png\n");
  EXPECT_EQ(content(folder_ / "bright_rank_total.png"), file("rank_total.png"));
}

TEST_F(Pictures, HaveNamesAndPlacesAsInTheManual) {
  simulate("bright.toml", quick_picture + Arguments{"--images", "none"});
  EXPECT_FALSE(exists("rank_total.png"));
  draw({"out"});
  EXPECT_TRUE(exists("rank_total.png"));
  for (const char* view : {"top", "side", "fisheye"}) draw({"out", "--chart", "map", "--field", "direct", "--view", view});
  EXPECT_TRUE(exists("map_direct.png"));
  simulate("bright.toml", quick_picture + Arguments{"--images", "none"});
  EXPECT_FALSE(exists("rank_total.png")) << "of the earlier run";
  simulate("bright.toml", quick_picture + Arguments{"--chart", "map", "--field", "absorbed"});
  EXPECT_TRUE(exists("map_absorbed.png") && exists("hue_indirect.png"));
}

TEST_F(Pictures, OfLightThatIsNotThereAreLeftOut) {
  simulate("plates.toml", quick_picture);
  EXPECT_TRUE(exists("rank_direct.png") && exists("hue_direct.png"));
  EXPECT_FALSE(exists("rank_indirect.png") || exists("hue_total.png"));
}

TEST_F(Pictures, OfPlanesThatAreNotThereAreNamed) {
  const Arguments planes{"--images", "planes", "--device", "cpu", "--passes", "8", "--grid", "0.1"};
  const Outcome outcome = run(Arguments{"run", "plates.toml", "-o", "out"} + planes);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("warning: --images planes draws nothing; give the scene a [[plane]]"), std::string::npos)
      << outcome.err;
  folder_.write("plane.toml", std::string(plates_scene) + "[[plane]]\nheight = 0.5\n");
  EXPECT_EQ(run(Arguments{"run", "plane.toml", "-o", "out"} + planes).err.find("draws nothing"), std::string::npos);
}

TEST_F(Pictures, AsExrHoldTheValuesThemselves) {
  simulate("plates.toml", quick_picture + Arguments{"--images", "none", "--export", "csv"});
  draw({"out", "--field", "direct", "--view", "top", "-o", "values.exr"});
  EXRVersion version;
  EXRHeader header;
  EXRImage image;
  InitEXRHeader(&header);
  InitEXRImage(&image);
  const std::string name = (folder_ / "values.exr").string();
  ASSERT_EQ(ParseEXRVersionFromFile(&version, name.c_str()), TINYEXR_SUCCESS);
  ASSERT_EQ(ParseEXRHeaderFromFile(&header, &version, name.c_str(), nullptr), TINYEXR_SUCCESS);
  ASSERT_EQ(LoadEXRImageFromFile(&image, &header, name.c_str(), nullptr), TINYEXR_SUCCESS);
  ASSERT_EQ(header.num_channels, 3);
  ASSERT_EQ(image.width * image.height, 320 * 240);
  const Table triangles(file("triangles.csv"));
  std::array<int, 4> whole{};
  for (int k = 0; k < image.width * image.height; ++k) {
    float coverage = 0.0F;
    float value = 0.0F;
    std::uint32_t element = 0;
    std::memcpy(&coverage, image.images[0] + 4 * k, 4);
    std::memcpy(&value, image.images[1] + 4 * k, 4);
    std::memcpy(&element, image.images[2] + 4 * k, 4);
    if (coverage == 0.0F) {
      EXPECT_EQ(value, 0.0F);
      EXPECT_EQ(element, 0xffffffffU);
      continue;
    }
    ASSERT_LT(element, 4U);
    const double expected = triangles.number(element, "PAR_direct_upper");
    if (std::abs(value - expected) < 1e-6 * expected) ++whole[element];  // otherwise the pixel lies on an edge
  }
  for (const int count : whole) EXPECT_GT(count, 1000);
  FreeEXRImage(&image);
  FreeEXRHeader(&header);
}

TEST_F(Pictures, ThatCannotBeDrawnAreRefused) {
  simulate("plates.toml", quick_picture + Arguments{"--images", "none"});
  const auto refused = [&](const Arguments& more, const std::string& names, int status = 2) {
    SCOPED_TRACE(::testing::PrintToString(more));
    expect_one_error(run(Arguments{"render", "--device", "cpu"} + more), status, names);
  };
  refused({"absent"}, "absent");
  refused({"."}, "pictures.cbor");
  refused({"out", "--seed", "3"}, "--seed");
  refused({"out", "--error", "0.1"}, "--error");
  refused({"out", "--field", "sky"}, "sky");
  refused({"out", "--field", "indirect"}, "indirect");
  refused({"out", "--band", "UV"}, "--band UV");
  refused({"out", "--repeat", "3"}, "--repeat 3");
  refused({"out", "-o", "picture.jpg"}, "picture.jpg");
  refused({"out", "-o", "values.exr", "--chart", "map"}, "--chart");
  refused({"out", "-o", "nowhere/picture.png"}, "nowhere/picture.png", 1);
  const std::string store = content(folder_ / "out" / "pictures.cbor");
  for (const std::size_t length : {std::size_t{0}, std::size_t{10}, store.size() / 2, store.size() - 1}) {
    folder_.write("out/pictures.cbor", store.substr(0, length));
    refused({"out"}, "out/pictures.cbor");
  }
}

}  // namespace
}  // namespace sunfleck::regression
