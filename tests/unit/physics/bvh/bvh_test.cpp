#include "physics/bvh/bvh.h"

#include "physics/bvh/build.h"
#include "support/bvh_check.h"

#include <gtest/gtest.h>
#include <cstring>
#include <functional>
#include <string>

namespace sunfleck::testing_bvh {
namespace {

// Traces rays towards the triangles' middles and corners, along the axes and askew. Returns the number of hits found.
std::size_t expect_no_hit_lost(const Bvh& bvh, std::size_t rays, double size_m) {
  Random random(5);
  std::size_t found = 0;
  std::size_t lost = 0;
  for (std::size_t i = 0; i < rays; ++i) {
    const BvhTriangle& aim = bvh.triangles[random() % bvh.triangles.size()];
    const glm::dvec3 middle = (corner(aim.a) + corner(aim.b) + corner(aim.c)) / 3.0;
    glm::dvec3 direction(point(random, 1.0));
    if (i % 2 == 0) {
      direction = glm::dvec3(0.0);
      direction[static_cast<int>(i / 2 % 3)] = i % 4 == 0 ? 1.0 : -1.0;
    }
    const Line ray{(i % 3 == 0 ? corner(aim.b) : middle) - size_m * direction, direction};
    Visits visits;
    walk(bvh, ray, 0.0, 0, visits);
    std::vector<bool> visited(bvh.triangles.size());
    for (const std::size_t t : visits.triangles) visited[t] = true;
    for (std::size_t t = 0; t < bvh.triangles.size(); ++t) {
      if (!hits(ray, bvh.triangles[t])) continue;
      ++found;
      lost += visited[t] ? 0 : 1;
    }
  }
  EXPECT_EQ(lost, 0U);
  return found;
}

struct Shape {
  std::string name;
  double size_m;
  std::function<std::vector<Triangle>()> make;
};
void PrintTo(const Shape& shape, std::ostream* out) {
  *out << shape.name;
}

std::vector<Triangle> repeated(std::size_t count, const std::function<Triangle(float)>& make) {
  std::vector<Triangle> corners;
  for (std::size_t i = 0; i < count; ++i) corners.push_back(make(static_cast<float>(i)));
  return corners;
}

Triangle right_angled(glm::vec3 at, float size) {
  return {at, at + glm::vec3(size, 0, 0), at + glm::vec3(0, 0, size)};
}

std::vector<Shape> shapes() {
  return {
      {"one", 1.0, [] { return scattered(1, 1.0, 1.0, 1); }},
      {"two", 1.0, [] { return scattered(2, 1.0, 0.5, 1); }},
      {"four", 1.0, [] { return scattered(4, 1.0, 0.5, 1); }},
      {"small", 1.0, [] { return scattered(3000, 1.0, 0.03, 2); }},
      {"overlapping", 1.0, [] { return scattered(500, 1.0, 1.0, 3); }},
      {"micrometre", 1e-6, [] { return scattered(1000, 1e-6, 1e-7, 4); }},
      {"ten_thousand_km", 1e7, [] { return scattered(1000, 1e7, 1e6, 5); }},
      {"specks_far_apart", 1e7, [] { return scattered(1000, 1e7, 2.0, 6); }},
      {"level_grid", 30.0,
       [] {
         return repeated(900, [](float i) {
           return right_angled({std::floor(i / 30), 0.25F, i - 30 * std::floor(i / 30)}, 1.0F);
         });
       }},
      {"upright_row", 500.0,
       [] {
         return repeated(500, [](float i) { return Triangle{glm::vec3{i, 0, 0}, glm::vec3{i, 1, 0}, glm::vec3{i, 0, 1}}; });
       }},
      {"needles", 1.0,
       [] {
         return repeated(500, [](float i) {
           return Triangle{glm::vec3{i * 1e-3F, 0, 0}, glm::vec3{i * 1e-3F, 1, 1}, glm::vec3{i * 1e-3F + 1e-6F, 0, 0}};
         });
       }},
      {"far_from_zero", 1.0,
       [] { return repeated(500, [](float i) {
              return right_angled({1e6F + std::fmod(i, 7.0F), i * 0.01F, -1e6F}, 1.0F);
            }); }},
      {"identical", 1.0, [] { return repeated(100000, [](float) {
                                return right_angled({0.25F, 0.5F, 0.25F}, 1.0F);
                              }); }},
      {"concentric", 1.0,
       [] {
         return repeated(2000, [](float i) {
           const float s = std::pow(0.99F, i);
           return Triangle{glm::vec3{-s, 0, -s}, glm::vec3{s, 0, -s}, glm::vec3{0, 0, s}};
         });
       }},
      {"shrinking_to_a_corner", 1.0,
       [] {
         return repeated(1200, [](float i) {
           const float s = std::exp2(-std::fmod(i, 100.0F));
           return right_angled({s, s, s}, s);
         });
       }},
      {"growing_a_millionfold", 1e6,
       [] {
         return repeated(1000, [](float i) {
           const float s = std::exp2(i * 0.02F);
           return right_angled({s, 0, -s}, s);
         });
       }},
  };
}

class BvhOf : public testing::TestWithParam<Shape> {};
INSTANTIATE_TEST_SUITE_P(Shapes, BvhOf, testing::ValuesIn(shapes()), [](const auto& shape) { return shape.param.name; });

TEST_P(BvhOf, KeepsItsPromises) {
  const Canopy canopy = isolated(GetParam().make());
  for (const double share : {0.0, 1e-6}) {
    const auto padding_m = static_cast<float>(share * GetParam().size_m);
    const Inspector inspector(canopy, build_bvh(canopy, padding_m), padding_m);
  }
}

TEST_P(BvhOf, LosesNoHit) {
  const Canopy canopy = isolated(GetParam().make());
  const Bvh bvh = build_bvh(canopy, static_cast<float>(1e-6 * GetParam().size_m));
  const std::size_t rays = 200000 / std::max<std::size_t>(canopy.size(), 1000);
  EXPECT_GT(expect_no_hit_lost(bvh, rays, GetParam().size_m), 0U);
}

TEST_P(BvhOf, IsTheSameEveryTime) {
  const Canopy canopy = isolated(GetParam().make());
  const Bvh a = build_bvh(canopy, 1e-6F);
  const Bvh b = build_bvh(canopy, 1e-6F);
  ASSERT_EQ(a.nodes.size(), b.nodes.size());
  ASSERT_EQ(a.triangles.size(), b.triangles.size());
  EXPECT_EQ(std::memcmp(a.nodes.data(), b.nodes.data(), a.nodes.size() * sizeof(BvhNode)), 0);
  EXPECT_EQ(std::memcmp(a.triangles.data(), b.triangles.data(), a.triangles.size() * sizeof(BvhTriangle)), 0);
}

TEST(Bvh, OfNothingIsEmpty) {
  const Bvh bvh = build_bvh(Canopy{}, 0.0F);
  EXPECT_TRUE(bvh.nodes.empty());
  EXPECT_TRUE(bvh.triangles.empty());
  EXPECT_EQ(bvh.depth, 0);
  EXPECT_EQ(statistics(bvh).sah_cost, 0.0);
}

}  // namespace
}  // namespace sunfleck::testing_bvh
