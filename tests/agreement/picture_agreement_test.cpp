// Tests what cameras of every kind see, for a single plot and among its copies: known pixels, and the same pixels on CPU and
// device.

#include "agreement/scenes.h"
#include "devices/tracers/canopy_view.h"
#include "devices/tracers/gpu_tree.h"
#include "pictures/drawing/chart.h"
#include "pictures/drawing/view_block.h"
#include "support/box_views.h"
#include "support/copies.h"
#include "support/device.h"

#include <cstring>
#include <string>

namespace sunfleck::test {
namespace {

using Seen = std::vector<shared::SeenSurface>;

const Plot square_stand{2.0, 2.0, false};

CanopyLook look_of(const RadiationModel& model, const CounterLayout& layout, const Camera& camera, const PictureSize& size,
                   int repeat = 1) {
  CanopyLook look;
  look.view = make_view_block(camera, size, model.canopy.origin_m);
  look.view.elements = static_cast<std::uint32_t>(model.canopy.size());
  look.view.ground = make_ground_map(layout);
  look.offsets = sample_offsets(size.samples);
  look.copies = {repeat, {model.plot.size_x_m, model.plot.size_z_m}};
  return look;
}

std::size_t surfaces_apart(const Seen& a, const Seen& b) {
  EXPECT_EQ(a.size(), b.size());
  std::size_t count = 0;
  for (std::size_t k = 0; k < std::min(a.size(), b.size()); ++k) count += std::memcmp(&a[k], &b[k], sizeof a[k]) == 0 ? 0 : 1;
  return count;
}

Seen see_whole(CanopyViewer& viewer, const PictureSize& size) {
  return viewer.see(0, static_cast<std::uint32_t>(size.height), {});
}

Seen see_on_cpu(const Prepared& prepared, const CanopyLook& look) {
  return view_with_cpu(prepared.bvh, look)->see(0, look.view.height, {});
}

// Returns a camera that looks straight down on a square of 2 m, north up.
Camera above(glm::dvec3 position_m, double half_height_m) {
  Camera camera = top_view({0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}, 1.0);
  camera.position_m = position_m;
  camera.half_height_m = half_height_m;
  return camera;
}

// Two level squares of 1 m: one lies 0.25 m below the other and half a metre south and west of it. Pixels measure 0.25 m;
// samples lie off their diagonals. Row r sees x = r/4 - 3/16, column c sees z = 13/8 - c/4. Digits are elements, all seen from
// above; the first triangle of a square is its half with z > x.
TEST(Picture, OfTwoSquaresIsExact) {
  MeshMaker maker;
  maker.level(0.0, 1.0, 0.0, 1.0, 0.5);
  maker.level(0.5, 1.5, 0.5, 1.5, 0.25);
  const RadiationModel model = without_soil(black_model(maker.mesh(), square_stand, beijing_sun()));
  const Prepared prepared(model);
  CanopyLook look = look_of(model, prepared.layout, above({0.75, 3.0, 0.75}, 1.0), {8, 8, 1});
  look.offsets = {{0.5F, 0.25F}};
  const std::string expected =
      "........"
      "...0000."
      "...0001."
      ".220011."
      ".220111."
      ".2233..."
      ".2333..."
      "........";
  const Seen seen = see_on_cpu(prepared, look);
  ASSERT_EQ(seen.size(), expected.size());
  for (std::size_t pixel = 0; pixel < seen.size(); ++pixel) {
    if (expected[pixel] == '.') {
      EXPECT_EQ(seen[pixel].surface, shared::seen_nothing) << pixel;
      continue;
    }
    const auto element = static_cast<std::uint32_t>(expected[pixel] - '0');
    EXPECT_EQ(seen[pixel].surface, 2 * element) << pixel;  // the upper side
    // The camera is 3 m above the ground; the tolerance covers coordinates of a few units in 24 bits.
    EXPECT_NEAR(seen[pixel].depth, element < 2 ? 2.5 : 2.75, 4.0 * 0x1p-23) << pixel;
    EXPECT_EQ(seen[pixel].copy, 0U) << pixel;
  }
}

// A fisheye camera below a level square sees its lower side up to the angle of its edges.
TEST(Picture, OfASquareAboveAFisheyeIsAsWideAsItsAngle) {
  MeshMaker maker;
  maker.level(0.0, 2.0, 0.0, 2.0, 2.0);
  const RadiationModel model = black_model(maker.mesh(), square_stand, beijing_sun());
  const Prepared prepared(model);
  Camera camera = fisheye_view({1.0, 1.0, 1.0}, 1.0);
  camera.circle_centre = {0.5, 0.5};
  camera.circle_radius = 0.5;
  constexpr int size = 101;
  const Seen seen = see_on_cpu(prepared, look_of(model, prepared.layout, camera, {size, size, 1}));
  const auto at = [&](int column, int row) { return seen[static_cast<std::size_t>(row) * size + column]; };
  // An angle of 45 degrees from the zenith is half a radius: 25.25 pixels from the middle of pixel 50.
  for (int away = 0; away <= 50; ++away) {
    for (const auto& sample : {at(50 - away, 50), at(50 + away, 50), at(50, 50 - away), at(50, 50 + away)}) {
      EXPECT_EQ(sample.surface != shared::seen_nothing, away <= 25) << away;
      EXPECT_TRUE(sample.surface == shared::seen_nothing || sample.surface % 2 == 1);
    }
  }
  EXPECT_NEAR(at(50, 50).depth, 1.0, 4.0 * 0x1p-23);
  EXPECT_EQ(at(0, 0).surface, shared::seen_nothing);
}

// A leaf lies in the middle of its plot, with 64 pixels to a metre: every copy is the plot's own picture moved by exactly 64
// pixels, since all lengths are short binary fractions.
TEST(Picture, HasEachNeighbourExactlyOnePeriodAway) {
  MeshMaker maker;
  maker.level(0.25, 0.6875, 0.3125, 0.75, 0.5);
  const RadiationModel model = black_model(maker.mesh(), unit_plot, beijing_sun());
  const Prepared prepared(model);
  const CanopyLook look = look_of(model, prepared.layout, above({0.5, 4.0, 0.5}, 2.0), {256, 256, 1}, 3);
  const Seen seen = see_on_cpu(prepared, look);
  std::size_t leaf = 0;
  for (int row = 0; row < 256; ++row) {
    for (int column = 0; column < 256; ++column) {
      const auto& here = seen[static_cast<std::size_t>(row) * 256 + column];
      const bool in_copies = row >= 32 && row < 224 && column >= 32 && column < 224;
      const bool in_plot = row >= 96 && row < 160 && column >= 96 && column < 160;
      ASSERT_EQ(here.surface == shared::seen_nothing, !in_copies) << row << ' ' << column;
      if (!in_copies) continue;
      const std::size_t own =
          (96 + static_cast<std::size_t>(row + 32) % 64) * 256 + 96 + static_cast<std::size_t>(column + 32) % 64;
      ASSERT_EQ(here.surface, seen[own].surface) << row << ' ' << column;
      ASSERT_EQ(here.depth, seen[own].depth);
      ASSERT_EQ(here.copy == 0, in_plot);
      leaf += here.surface < 4 ? 1 : 0;
    }
  }
  EXPECT_EQ(leaf, 9U * 28U * 28U);
}

// However the plot is wrapped, a leaf that reaches over the border is whole, and each copy shows one.
TEST(Picture, ShowsLeavesWholeAcrossTheBorder) {
  MeshMaker maker;
  maker.level(0.75, 1.25, 0.25, 0.75, 0.5);
  const RadiationModel model = black_model(maker.mesh(), unit_plot, beijing_sun());
  const Prepared prepared(model);
  for (const int repeat : {1, 3}) {
    const CanopyLook look = look_of(model, prepared.layout, above({0.5, 4.0, 0.5}, 4.0), {256, 256, 1}, repeat);
    std::size_t own = 0;
    std::size_t all = 0;
    for (const auto& sample : see_on_cpu(prepared, look)) {
      if (sample.surface >= 4) continue;
      ++all;
      own += sample.copy == 0 ? 1 : 0;
    }
    EXPECT_EQ(own, 16U * 16U);
    EXPECT_EQ(all, own * static_cast<std::size_t>(repeat * repeat));
  }
}

// Seen from the side, the southern copies would hide the plot; without them it looks as if it stood alone.
TEST(Picture, LeavesOutTheCopiesBeforeThePlot) {
  const RadiationModel model = maize_model({1, 2, 0.6, 0.6, 3}, beijing_sun());
  const Prepared prepared(model);
  const glm::dvec3 hi(model.plot.size_x_m, 2.2, model.plot.size_z_m);
  CanopyLook look = look_of(model, prepared.layout, side_view({0.0, 0.0, 0.0}, hi, 1.0), {100, 100, 1});
  const Seen alone = see_on_cpu(prepared, look);
  look.copies.repeat = 3;
  const Seen all = see_on_cpu(prepared, look);
  look.copies.which = SeenCopies::Which::not_before_plot;
  const Seen cut = see_on_cpu(prepared, look);
  std::size_t plot = 0;
  std::size_t hidden = 0;
  std::size_t beside = 0;
  for (std::size_t k = 0; k < alone.size(); ++k) {
    if (alone[k].surface == shared::seen_nothing) {
      beside += cut[k].surface != shared::seen_nothing ? 1 : 0;
      continue;
    }
    ++plot;
    hidden += all[k].copy != 0 ? 1 : 0;
    // Leaves of the neighbouring copies reach into the rows of the plot, in front of its own leaves or behind them.
    EXPECT_TRUE(cut[k].copy == 0 ? cut[k].surface == alone[k].surface : cut[k].depth < alone[k].depth) << k;
  }
  EXPECT_GT(hidden, plot * 9 / 10);
  EXPECT_GT(beside, plot / 2);
}

// A leaf that lies in the ground of the neighbouring plot is visible there instead of the ground.
TEST(Picture, ShowsALeafThatLiesInTheNeighboursGround) {
  MeshMaker maker;
  maker.level(0.75, 1.25, 0.25, 0.75, 0.0);
  const RadiationModel model = black_model(maker.mesh(), unit_plot, beijing_sun());
  const Prepared prepared(model);
  const Camera camera = look_at({4.0, 3.0, 5.0}, {1.0, 0.0, 0.5}, 0.6, 1.0);
  Seen seen = see_on_cpu(prepared, look_of(model, prepared.layout, camera, {200, 200, 1}, 3));
  CanopyLook without_ground = look_of(model, prepared.layout, camera, {200, 200, 1}, 3);
  without_ground.view.ground.cells_x = 0;
  const Seen leaves = see_on_cpu(prepared, without_ground);
  std::size_t leaf = 0;
  for (std::size_t k = 0; k < seen.size(); ++k) {
    if (leaves[k].surface == shared::seen_nothing) continue;
    ++leaf;
    EXPECT_EQ(seen[k].surface, leaves[k].surface) << k;
  }
  EXPECT_GT(leaf, 100U);
}

std::vector<Camera> cameras(const RadiationModel& model, double height_m) {
  const glm::dvec3 hi(model.plot.size_x_m, height_m, model.plot.size_z_m);
  return {three_quarter_view({0.0, 0.0, 0.0}, hi, 4.0 / 3.0), top_view({0.0, 0.0, 0.0}, hi, 4.0 / 3.0),
          side_view({0.0, 0.0, 0.0}, hi, 4.0 / 3.0), fisheye_view({0.5 * hi.x, 0.02 * height_m, 0.5 * hi.z}, 4.0 / 3.0),
          look_at({0.5 * hi.x, 0.3 * height_m, 0.5 * hi.z}, {5.0, 0.5, 4.0}, 1.0, 4.0 / 3.0)};
}

TEST(Picture, IsTheSameHoweverItIsCutIntoRows) {
  const RadiationModel model = maize_model({1, 2, 0.6, 0.6, 3}, beijing_sun());
  const Prepared prepared(model);
  const PictureSize size{80, 60, 3};
  for (const Camera& camera : cameras(model, 2.2)) {
    const auto viewer = view_with_cpu(prepared.bvh, look_of(model, prepared.layout, camera, size, 3));
    const Seen whole = see_whole(*viewer, size);
    Seen pieces;
    for (const auto& [first, rows] : {std::pair{0U, 1U}, std::pair{1U, 32U}, std::pair{33U, 7U}, std::pair{40U, 20U}}) {
      const Seen piece = viewer->see(first, rows, {});
      pieces.insert(pieces.end(), piece.begin(), piece.end());
    }
    EXPECT_EQ(surfaces_apart(whole, pieces), 0U);
  }
}

// However many samples of however many pixels are followed together, each sees what it sees alone in its pixel.
TEST(Picture, HasTheSamplesOfPicturesWithOneSample) {
  const RadiationModel model = maize_model({1, 2, 0.6, 0.6, 3}, beijing_sun());
  const Prepared prepared(model);
  for (const Camera& camera : cameras(model, 2.2)) {
    for (const int samples : {2, 3, 4, 8, 16, 21}) {
      const CanopyLook look = look_of(model, prepared.layout, camera, {37, 23, samples}, 3);
      const Seen seen = see_on_cpu(prepared, look);
      for (int sample = 0; sample < samples; ++sample) {
        CanopyLook alone = look_of(model, prepared.layout, camera, {37, 23, 1}, 3);
        alone.offsets = {look.offsets[static_cast<std::size_t>(sample)]};
        Seen of_sample;
        for (std::size_t k = static_cast<std::size_t>(sample); k < seen.size(); k += static_cast<std::size_t>(samples)) {
          of_sample.push_back(seen[k]);
        }
        EXPECT_EQ(surfaces_apart(see_on_cpu(prepared, alone), of_sample), 0U) << samples;
      }
    }
  }
}

class PictureAgreement : public DeviceTest {
 protected:
  void expect_same_pictures(const RadiationModel& model, double height_m, int repeat) const {
    const Prepared prepared(model);
    const PictureSize size{120, 90, 3};
    const GpuTree texels(context(), prepared.bvh, BufferUse::uniform_texel);
    const GpuTree storage(context(), prepared.bvh, BufferUse::storage);
    for (const Camera& camera : cameras(model, height_m)) {
      const CanopyLook look = look_of(model, prepared.layout, camera, size, repeat);
      const Seen expected = see_on_cpu(prepared, look);
      for (const GpuTree* tree : {&texels, &storage}) {
        const auto viewer = view_with_gpu(context(), *tree, prepared.bvh, look);
        EXPECT_EQ(surfaces_apart(see_whole(*viewer, size), expected), 0U);
        const Seen some = viewer->see(31, 17, {});
        const auto from = expected.begin() + 31 * 120 * 3;
        EXPECT_EQ(surfaces_apart(some, Seen(from, from + 17 * 120 * 3)), 0U);
      }
    }
  }
};

TEST_F(PictureAgreement, OfAMaizePlot) {
  const RadiationModel model = maize_model({1, 2, 0.6, 0.6, 3}, beijing_sun());
  expect_same_pictures(model, 2.2, 1);
  expect_same_pictures(without_soil(model), 2.2, 1);
}

TEST_F(PictureAgreement, OfAMaizePlotAmidstItsCopies) {
  expect_same_pictures(maize_model({1, 2, 0.6, 0.6, 3}, beijing_sun()), 2.2, 3);
}

TEST_F(PictureAgreement, OfManyCopiesOfLeavesThatOverlap) {
  expect_same_pictures(black_model(coplanar_leaves(), unit_plot, beijing_sun()), 1.0, 9);
  expect_same_pictures(black_model(random_leaves(300, 0.2, 5), unit_plot, beijing_sun()), 1.0, 5);
}

TEST_F(PictureAgreement, OfPlantsThatShareATree) {
  expect_same_pictures(stand_of_copies({unit_plot, 12, true, 2}, true), 1.0, 3);
  expect_same_pictures(stand_of_copies({unit_stand, 12, false, 2}, true), 1.0, 1);
}

// Plants stay whole however they are stored; leaves that share a tree are not wrapped into the plot one by one.
TEST(Picture, ShowsPlantsWholeThatShareATree) {
  MeshMaker maker;
  maker.level(-0.25, 0.0, 0.0, 0.25, 0.5);
  maker.level(0.0, 0.25, 0.0, 0.25, 0.5);
  const PlacedMesh part{maker.mesh(), {Placement{}, {{0.5, 0.0, 0.5}}}, {}, true};
  RadiationModel model = black_model({}, unit_plot, beijing_sun());
  model.canopy = assemble_canopy(std::span(&part, 1), unit_plot);
  const Prepared prepared(model);
  const Seen seen = see_on_cpu(prepared, look_of(model, prepared.layout, above({0.5, 4.0, 0.5}, 4.0), {256, 256, 1}));
  std::array<int, 8> pixels{};
  for (const auto& sample : seen) {
    if (sample.surface < 16) ++pixels[sample.surface / 2];
  }
  for (const int count : pixels) EXPECT_NEAR(count, 32, 6);  // half of 8 x 8 pixels
}

TEST_F(PictureAgreement, OfAnEmptyStand) {
  expect_same_pictures(black_model(MeshMaker().mesh(), square_stand, beijing_sun()), 1.0, 1);
  expect_same_pictures(without_soil(black_model(MeshMaker().mesh(), square_stand, beijing_sun())), 1.0, 1);
}

// The host repeats the search, over all copies, where the device ran out of steps.
TEST_F(PictureAgreement, OfAPileTooHighForOneDispatchAmidstItsCopies) {
  MeshMaker maker;
  add_pile(maker, 10'000, 0.2, 0.5);
  expect_same_pictures(black_model(maker.mesh(), unit_plot, beijing_sun()), 1.0, 3);
}

TEST_F(PictureAgreement, StopsWhenAsked) {
  const RadiationModel model = maize_model({1, 1, 0.6, 0.6, 3}, beijing_sun());
  const Prepared prepared(model);
  const GpuTree tree(context(), prepared.bvh, BufferUse::uniform_texel);
  const CanopyLook look = look_of(model, prepared.layout, cameras(model, 2.2)[0], {40, 30, 1}, 3);
  EXPECT_TRUE(view_with_gpu(context(), tree, prepared.bvh, look)->see(0, 30, [] { return true; }).empty());
  EXPECT_TRUE(view_with_cpu(prepared.bvh, look)->see(0, 30, [] { return true; }).empty());
}

}  // namespace
}  // namespace sunfleck::test
