// Tests how views fit a scene into the picture.
#include "pictures/charts/pictures.h"

#include "support/box_views.h"
#include "support/leaf_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <glm/common.hpp>

namespace sunfleck::test {
namespace {

constexpr std::array views = {ViewKind::camera, ViewKind::top, ViewKind::side};

struct Stand {
  double width_m, height_m;
};

// Returns leaves of a stand in the north-east corner of a plot.
Scene leaves_on(const Plot& plot, const Stand& stand) {
  const Plot corner{.size_x_m = stand.width_m, .size_z_m = stand.width_m};
  Scene scene;
  scene.model = paper_model(random_leaves(2000, 1e-4, corner, stand.height_m, 3), plot, sun_at(30.0, 120.0));
  return scene;
}

// Returns the larger of the parts of the picture's width and height that the leaves fill, and checks that they are inside.
double filled_share(const Scene& scene, const Camera& camera) {
  glm::dvec2 lo(1.0), hi(0.0);
  for (const Triangle& corners : scene.model.canopy.corners) {
    for (const glm::vec3& corner : corners) {
      const auto seen = project(camera, glm::dvec3(corner) + scene.model.canopy.origin_m);
      EXPECT_TRUE(seen);
      if (!seen) continue;
      lo = glm::min(lo, seen->at);
      hi = glm::max(hi, seen->at);
    }
  }
  EXPECT_GT(std::min(lo.x, lo.y), 0.0);
  EXPECT_LT(std::max(hi.x, hi.y), 1.0);
  return std::max(hi.x - lo.x, hi.y - lo.y);
}

TEST(PictureCamera, ComesCloserToPlantsOnAWideFloor) {
  const Scene scene = leaves_on({.size_x_m = 6.0, .size_z_m = 6.0, .periodic = false}, {0.3, 0.3});
  const CounterLayout layout = make_counter_layout(scene.model);
  for (const ViewKind view : views) {
    PictureOptions options;
    options.view = view;
    EXPECT_GE(filled_share(scene, picture_camera(scene, layout, options)), 0.6);
  }
}

TEST(PictureCamera, ShowsThePlotAndItsAxesAroundPlantsThatFillThePicture) {
  const Scene scene = leaves_on(unit_plot, {1.0, 1.5});
  const CounterLayout layout = make_counter_layout(scene.model);
  const ShownBox box = shown_box(scene.model, layout);
  const Camera camera = picture_camera(scene, layout, {});
  EXPECT_EQ(camera.position_m, three_quarter_view(box.lo_m, box.hi_m, camera.aspect).position_m);
}

// The leaves reach nearly to the plot's borders.
TEST(PictureCamera, ComesNoCloserThanPlantsNeed) {
  const Scene scene = leaves_on(unit_plot, {0.9, 0.3});
  const CounterLayout layout = make_counter_layout(scene.model);
  for (const ViewKind view : views) {
    PictureOptions options;
    options.view = view;
    const Camera camera = picture_camera(scene, layout, options);
    const double share = filled_share(scene, camera);
    EXPECT_GE(share, 0.6);
    const ShownBox box = shown_box(scene.model, layout);
    for (const glm::dvec3& corner : box_with_axes(box.lo_m, box.hi_m, Axes::south_up_west)) {
      const auto seen = project(camera, corner);
      ASSERT_TRUE(seen);
      EXPECT_GT(std::min(seen->at.x, seen->at.y), 0.0);
      EXPECT_LT(std::max(seen->at.x, seen->at.y), 1.0);
    }
  }
}

TEST(PictureCamera, ShowsAPlotWithoutPlants) {
  Scene scene;
  scene.model = paper_model({}, unit_plot, sun_at(30.0, 120.0));
  const CounterLayout layout = make_counter_layout(scene.model);
  for (const ViewKind view : views) {
    PictureOptions options;
    options.view = view;
    const Camera camera = picture_camera(scene, layout, options);
    const auto corner = project(camera, {1.0, 0.0, 1.0});
    ASSERT_TRUE(corner);
    EXPECT_GT(std::min(corner->at.x, corner->at.y), 0.0);
    EXPECT_LT(std::max(corner->at.x, corner->at.y), 1.0);
  }
}

TEST(PlotsShown, AreOneUnlessAPeriodicPlotIsSeenFromBelow) {
  Scene scene = leaves_on(unit_plot, {1.0, 0.5});
  const auto shown = [&](ViewKind view, std::optional<int> repeat, double height_m) {
    CounterLayout layout = make_counter_layout(scene.model);
    layout.layers.height_m = height_m;
    PictureOptions options;
    options.view = view;
    options.repeat = repeat;
    return plots_shown(scene.model, layout, options);
  };
  EXPECT_EQ(shown(ViewKind::camera, {}, 1.0), 1);
  EXPECT_EQ(shown(ViewKind::fisheye, {}, 0.2), 1);
  EXPECT_EQ(shown(ViewKind::fisheye, {}, 1.0), 5) << "the plots beside reach 2.5 m far";
  EXPECT_EQ(shown(ViewKind::fisheye, {}, 20.0), 9);
  EXPECT_EQ(shown(ViewKind::fisheye, 1, 1.0), 1);
  EXPECT_EQ(shown(ViewKind::top, 3, 1.0), 3);
  scene.model.plot.periodic = false;
  EXPECT_EQ(shown(ViewKind::fisheye, {}, 1.0), 1);
}

}  // namespace
}  // namespace sunfleck::test
