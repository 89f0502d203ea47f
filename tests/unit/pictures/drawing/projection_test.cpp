#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <vector>

#include "pictures/drawing/camera.h"
#include "support/box_views.h"
#include "support/viewed_box.h"

namespace sunfleck {
namespace {

// Covers about twenty operations in double precision on numbers of order ten: 20 x 10 x 2^-53 is 2e-14. The other two digits
// allow for differences of coordinates that are larger than the result.
constexpr double projection_tolerance = 1e-11;
constexpr double quarter_turn = 0.5 * std::numbers::pi;

void expect_close(glm::dvec3 a, glm::dvec3 b) {
  EXPECT_LT(glm::distance(a, b), projection_tolerance);
}

const std::vector<test::ViewedBox> projection_boxes = {{{0.0, 0.0, 0.0}, {1.8, 2.4, 2.4}},
                                                       {{-4.0, -1.0, 5.0}, {1.0, 2.0, 9.0}},
                                                       {{0.0, 0.0, 0.0}, {30.0, 0.3, 2.0}},
                                                       {{0.0, 0.0, 0.0}, {1.0, 0.0, 1.0}}};
const std::vector<double> aspects = {0.5, 1.0, 4.0 / 3.0, 2.4};

glm::dvec2 place(const Camera& camera, glm::dvec3 point_m) {
  const auto appearance = project(camera, point_m);
  EXPECT_TRUE(appearance);
  return appearance ? appearance->at : glm::dvec2(-1.0);
}

// Returns whether the camera has a ray through the point of the picture; a fisheye has none outside its circle.
bool in_view(const Camera& camera, glm::dvec2 at) {
  const glm::dvec2 beside((at.x - camera.circle_centre.x) * camera.aspect, at.y - camera.circle_centre.y);
  return camera.kind != Projection::fisheye || glm::length(beside) <= camera.circle_radius;
}

std::vector<Camera> cameras(double aspect) {
  return {look_at({3.0, 2.5, 3.0}, {0.9, 1.0, 1.2}, 0.7, aspect),
          top_view(projection_boxes[0].lo_m, projection_boxes[0].hi_m, aspect),
          side_view(projection_boxes[0].lo_m, projection_boxes[0].hi_m, aspect), fisheye_view({0.9, 0.1, 1.2}, aspect)};
}

TEST(Projection, OfAPointOnARayIsWhereTheRayBegan) {
  for (const double aspect : aspects) {
    for (const Camera& camera : cameras(aspect)) {
      expect_close(glm::cross(camera.right, camera.up), -camera.forward);
      for (double y = 0.0625; y < 1.0; y += 0.125) {
        for (double x = 0.0625; x < 1.0; x += 0.125) {
          if (!in_view(camera, {x, y})) continue;
          const glm::dvec3 direction = ray_direction(camera, {x, y});
          EXPECT_NEAR(glm::length(direction), 1.0, projection_tolerance);
          const auto appearance = project(camera, ray_origin(camera, {x, y}) + 3.0 * direction);
          ASSERT_TRUE(appearance);
          EXPECT_NEAR(appearance->at.x, x, projection_tolerance);
          EXPECT_NEAR(appearance->at.y, y, projection_tolerance);
          const bool fisheye = camera.kind == Projection::fisheye;
          EXPECT_NEAR(appearance->depth_m, fisheye ? 3.0 : 3.0 * glm::dot(direction, camera.forward),
                      3.0 * projection_tolerance);
        }
      }
    }
  }
}

TEST(Projection, GivesAPixelItsSize) {
  for (const Camera& camera : cameras(4.0 / 3.0)) {
    constexpr int height = 100'000;  // so large that the picture is flat between neighbouring pixels
    const glm::dvec2 here = camera.circle_centre;
    const auto at_depth = [&](glm::dvec2 at) {
      const glm::dvec3 direction = ray_direction(camera, at);
      return ray_origin(camera, at) + direction * (5.0 / glm::dot(direction, camera.forward));
    };
    const double size_m = glm::distance(at_depth(here), at_depth(here + glm::dvec2(0.0, 1.0 / height)));
    EXPECT_NEAR(pixel_size_m(camera, height, 5.0) / size_m, 1.0, 1e-4);
  }
}

TEST(TopView, HasNorthUpAndEastRight) {
  const Camera camera = top_view({0.0, 0.0, 0.0}, {1.8, 2.4, 2.4}, 1.0);
  const glm::dvec3 middle(0.9, 1.0, 1.2);
  const glm::dvec2 at = place(camera, middle);
  const glm::dvec2 north = place(camera, middle - glm::dvec3(0.5, 0.0, 0.0)) - at;
  const glm::dvec2 east = place(camera, middle - glm::dvec3(0.0, 0.0, 0.5)) - at;
  EXPECT_NEAR(north.x, 0.0, projection_tolerance);
  EXPECT_NEAR(north.y, -0.25 / camera.half_height_m, projection_tolerance);  // 0.5 m in a picture 2 half heights high
  EXPECT_NEAR(east.x, 0.25 / camera.half_height_m, projection_tolerance);
  EXPECT_NEAR(east.y, 0.0, projection_tolerance);
  EXPECT_NEAR(glm::distance(place(camera, middle + glm::dvec3(0.0, 1.0, 0.0)), at), 0.0, projection_tolerance);
}

TEST(SideView, ShowsTheRowsSideBySideWithEastRight) {
  const Camera camera = side_view({0.0, 0.0, 0.0}, {1.8, 2.4, 2.4}, 1.0);
  const glm::dvec3 middle(0.9, 1.0, 1.2);
  const glm::dvec2 at = place(camera, middle);
  EXPECT_LT(glm::distance(place(camera, middle + glm::dvec3(0.7, 0.0, 0.0)), at), projection_tolerance);  // along the row
  const glm::dvec2 east = place(camera, middle - glm::dvec3(0.0, 0.0, 0.5)) - at;
  const glm::dvec2 above = place(camera, middle + glm::dvec3(0.0, 0.5, 0.0)) - at;
  EXPECT_NEAR(east.x, 0.25 / camera.half_height_m, projection_tolerance);
  EXPECT_NEAR(above.y, -0.25 / camera.half_height_m, projection_tolerance);
  EXPECT_LT(project(camera, {1.8, 1.0, 1.2})->depth_m, project(camera, {0.0, 1.0, 1.2})->depth_m);  // seen from the south
}

TEST(OrthographicViews, ShowTheWholeBoxAndItsAxesWithAMargin) {
  for (const test::ViewedBox& box : projection_boxes) {
    const glm::dvec3 extent_m = box.hi_m - box.lo_m;
    const double overhang_m = axis_overhang * std::max({extent_m.x, extent_m.y, extent_m.z});
    for (const double aspect : aspects) {
      for (const Camera& camera : {top_view(box.lo_m, box.hi_m, aspect), side_view(box.lo_m, box.hi_m, aspect)}) {
        EXPECT_EQ(camera.kind, Projection::orthographic);
        EXPECT_EQ(camera.aspect, aspect);
        for (unsigned i = 0; i < 11; ++i) {
          glm::dvec3 point_m = box.lo_m;
          for (unsigned axis = 0; axis < 3; ++axis) {
            if (i < 8 && (i >> axis & 1U) != 0) point_m[static_cast<int>(axis)] = box.hi_m[static_cast<int>(axis)];
            if (i == 8 + axis) point_m[static_cast<int>(axis)] = box.hi_m[static_cast<int>(axis)] + overhang_m;
          }
          const glm::dvec2 at = place(camera, point_m);
          EXPECT_GT(at.x, 0.025);
          EXPECT_LT(at.x, 1.0 - 0.14);
          EXPECT_GT(at.y, 0.149);
          EXPECT_LT(at.y, 1.0 - 0.084);
        }
      }
    }
  }
}

// The axes of the user begin at the south-west corner.
TEST(Views, ShowTheAxesOfTheUser) {
  constexpr Axes axes = Axes::east_north_up;
  for (const test::ViewedBox& box : projection_boxes) {
    const glm::dvec3 extent_m = box.hi_m - box.lo_m;
    const double overhang_m = axis_overhang * std::max({extent_m.x, extent_m.y, extent_m.z});
    const glm::dvec3 tips_m[] = {{box.hi_m.x, box.lo_m.y, box.lo_m.z - overhang_m},
                                 {box.lo_m.x - overhang_m, box.lo_m.y, box.hi_m.z},
                                 {box.hi_m.x, box.hi_m.y + overhang_m, box.hi_m.z}};
    for (const double aspect : aspects) {
      for (const Camera& camera : {top_view(box.lo_m, box.hi_m, aspect, axes), side_view(box.lo_m, box.hi_m, aspect, axes),
                                   three_quarter_view(box.lo_m, box.hi_m, aspect, axes)}) {
        for (const glm::dvec3& tip_m : tips_m) {
          const glm::dvec2 at = place(camera, tip_m);
          EXPECT_GT(at.x, 0.025);
          EXPECT_LT(at.x, 1.0 - 0.14);
          EXPECT_GT(at.y, 0.149);
          EXPECT_LT(at.y, 1.0 - 0.084);
        }
      }
    }
  }
}

// Returns the point of the hemisphere at this zenith angle and azimuth (clockwise from north), 2 m away.
glm::dvec3 on_hemisphere(const Camera& camera, double zenith_rad, double azimuth_rad) {
  const glm::dvec3 direction(-std::sin(zenith_rad) * std::cos(azimuth_rad), std::cos(zenith_rad),
                             -std::sin(zenith_rad) * std::sin(azimuth_rad));
  return camera.position_m + 2.0 * direction;
}

TEST(Fisheye, IsEquidistantWithNorthUpAndEastLeft) {
  for (const double aspect : aspects) {
    const Camera camera = fisheye_view({0.9, 0.1, 1.2}, aspect);
    EXPECT_LT(glm::distance(place(camera, {0.9, 7.0, 1.2}), camera.circle_centre), projection_tolerance);
    for (const double share : {0.25, 0.5, 0.999999999999}) {
      const double zenith_rad = share * quarter_turn;
      const double out = share * camera.circle_radius;  // in picture heights
      const glm::dvec2 across(out / aspect, 0.0);
      const glm::dvec2 down(0.0, out);
      const glm::dvec2 centre = camera.circle_centre;
      EXPECT_LT(glm::distance(place(camera, on_hemisphere(camera, zenith_rad, 0.0)), centre - down), projection_tolerance);
      EXPECT_LT(glm::distance(place(camera, on_hemisphere(camera, zenith_rad, quarter_turn)), centre - across),
                projection_tolerance);
      EXPECT_LT(glm::distance(place(camera, on_hemisphere(camera, zenith_rad, 2 * quarter_turn)), centre + down),
                projection_tolerance);
      EXPECT_LT(glm::distance(place(camera, on_hemisphere(camera, zenith_rad, 3 * quarter_turn)), centre + across),
                projection_tolerance);
      const glm::dvec2 north_east = place(camera, on_hemisphere(camera, zenith_rad, 0.5 * quarter_turn));
      EXPECT_LT(glm::distance(north_east, centre - std::sqrt(0.5) * (across + down)), projection_tolerance);
    }
    EXPECT_FALSE(project(camera, {5.0, 0.0, 1.2}));  // below the horizon
    EXPECT_FALSE(project(camera, camera.position_m));
  }
}

TEST(Fisheye, SeesNothingOutsideItsCircle) {
  const Camera camera = fisheye_view({0.9, 0.1, 1.2}, 4.0 / 3.0);
  const glm::dvec2 radius(camera.circle_radius / camera.aspect, 0.0);
  EXPECT_NEAR(ray_direction(camera, camera.circle_centre + radius).y, 0.0, projection_tolerance);
}

TEST(Fisheye, HasItsCircleInThePictureBesideTheLegend) {
  for (const double aspect : aspects) {
    const Camera camera = fisheye_view({0.0, 0.0, 0.0}, aspect);
    EXPECT_GT(camera.circle_radius, 0.05);
    EXPECT_GT(camera.circle_centre.x - camera.circle_radius / aspect, 0.0);
    EXPECT_LT(camera.circle_centre.x + camera.circle_radius / aspect, 1.0 - 0.14);
    EXPECT_GT(camera.circle_centre.y - camera.circle_radius, 0.149);
    EXPECT_LT(camera.circle_centre.y + camera.circle_radius, 1.0 - 0.084);
  }
}

}  // namespace
}  // namespace sunfleck
