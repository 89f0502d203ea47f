#include "physics/transport/model/counters.h"

#include "support/bvh_check.h"
#include "support/models.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <set>
#include <vector>

namespace sunfleck::test {
namespace {

// Returns ten layers of 0.1 m with a leaf in one of them, one across three, one from the ground to the top, and one below the
// ground.
RadiationModel layered_model() {
  MeshMaker maker;
  maker.triangle({0.1, 0.55, 0.1}, {0.1, 0.55, 0.2}, {0.2, 0.56, 0.1});
  maker.triangle({0.3, 0.25, 0.1}, {0.3, 0.3, 0.2}, {0.4, 0.45, 0.1});
  maker.triangle({0.5, 0.0, 0.1}, {0.5, 0.0, 0.2}, {0.6, 1.0, 0.1});
  maker.triangle({0.7, -0.2, 0.1}, {0.7, -0.1, 0.2}, {0.8, -0.2, 0.1});
  RadiationModel model = black_model(maker.mesh(), {1.0, 0.5, true}, beijing_sun());
  model.layers = 10;
  return model;
}

TEST(CounterLayout, GivesAnElementOneBinALayer) {
  const RadiationModel model = layered_model();
  const CounterLayout layout = make_counter_layout(model);
  EXPECT_NEAR(layout.layers.height_m, 1.0, 1e-7);
  EXPECT_EQ(layout.cells_x, 20U);
  EXPECT_EQ(layout.cells_z, 10U);
  EXPECT_EQ(layout.first_bin, (std::vector<std::uint32_t>{0, 1, 4, 14, 15}));
  EXPECT_EQ(layout.first_bin_word, shared::counter_first_cell + 200U);
  EXPECT_EQ(layout.words(), layout.first_bin_word + 30U);
  EXPECT_EQ(first_layer(layout, model.canopy.corners[0]), 5U);
  EXPECT_EQ(first_layer(layout, model.canopy.corners[1]), 2U);
  EXPECT_EQ(first_layer(layout, model.canopy.corners[3]), 0U);
}

TEST(CounterLayout, OfAnEmptyOrFlatScene) {
  RadiationModel empty = black_model({}, {1.0, 1.0, true}, beijing_sun());
  EXPECT_EQ(make_counter_layout(empty).words(), shared::counter_first_cell + 400U);
  empty.soil.reset();
  EXPECT_EQ(make_counter_layout(empty).words(), shared::counter_first_cell);
  MeshMaker maker;
  maker.level(0.0, 0.5, 0.0, 0.5, 0.0);
  const CounterLayout flat = make_counter_layout(black_model(maker.mesh(), {1.0, 1.0, true}, beijing_sun()));
  EXPECT_EQ(flat.layers.per_metre, 0.0F);
  EXPECT_EQ(flat.first_bin, (std::vector<std::uint32_t>{0, 1, 2}));
}

// The words that a tracer can reach from an element's counter and its layers are exactly the element's bins.
TEST(NumberCounters, LeadsToTheElementsBins) {
  const RadiationModel model = layered_model();
  const Prepared prepared(model);
  std::set<std::uint32_t> reached;
  for (const BvhTriangle& triangle : prepared.bvh.triangles) {
    const auto bins = prepared.layout.first_bin[triangle.element + 1] - prepared.layout.first_bin[triangle.element];
    const std::uint32_t first = first_layer(prepared.layout, model.canopy.corners[triangle.element]);
    for (std::uint32_t layer = first; layer < first + bins; ++layer) {
      for (std::uint32_t side = 0; side < 2; ++side) {
        const std::uint32_t word = triangle.counter + 2 * layer + side;
        EXPECT_EQ(word,
                  prepared.layout.first_bin_word + 2 * (prepared.layout.first_bin[triangle.element] + layer - first) + side);
        reached.insert(word);
      }
    }
  }
  EXPECT_EQ(reached.size(), 30U);
  EXPECT_EQ(*reached.begin(), prepared.layout.first_bin_word);
  EXPECT_EQ(*reached.rbegin(), prepared.layout.words() - 1);
}

Layers layers_of(int count, double height_m) {
  return {count, 0.0F, static_cast<float>(count / height_m), height_m};
}

TEST(AddAreaByLayer, SplitsARightTriangleInOddParts) {
  std::vector<double> areas(4);
  add_area_by_layer(layers_of(4, 1.0), {glm::vec3(0, 1, 0), glm::vec3(0, 0, 0), glm::vec3(2, 0, 0)}, areas);
  for (std::size_t layer = 0; layer < 4; ++layer)
    EXPECT_NEAR(areas[layer], (7.0 - 2.0 * static_cast<double>(layer)) / 16.0, 1e-12);
}

// Returns the part of a polygon on one side of a height (Sutherland & Hodgman 1974).
std::vector<glm::dvec3> clipped(const std::vector<glm::dvec3>& polygon, double y, bool above) {
  std::vector<glm::dvec3> kept;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const glm::dvec3& from = polygon[k];
    const glm::dvec3& to = polygon[(k + 1) % polygon.size()];
    const bool from_in = above ? from.y >= y : from.y <= y;
    const bool to_in = above ? to.y >= y : to.y <= y;
    if (from_in) kept.push_back(from);
    if (from_in != to_in) kept.push_back(from + (to - from) * ((y - from.y) / (to.y - from.y)));
  }
  return kept;
}

double polygon_area(const std::vector<glm::dvec3>& polygon) {
  glm::dvec3 sum(0.0);
  for (std::size_t k = 2; k < polygon.size(); ++k) sum += glm::cross(polygon[k - 1] - polygon[0], polygon[k] - polygon[0]);
  return 0.5 * glm::length(sum);
}

TEST(AddAreaByLayer, AgreesWithCuttingPolygons) {
  testing_bvh::Random random(1);
  const Layers layers = layers_of(7, 2.0);
  for (int k = 0; k < 2'000; ++k) {
    Triangle corners{testing_bvh::point(random, 1.5), testing_bvh::point(random, 1.5), testing_bvh::point(random, 1.5)};
    for (glm::vec3& corner : corners) corner.y += 1.0F;  // spans -0.5..2.5, beyond the layers on both sides
    if (k % 5 == 0) corners[1].y = corners[0].y;
    if (k % 10 == 0) corners[2].y = corners[0].y;
    std::vector<double> areas(7);
    add_area_by_layer(layers, corners, areas);
    EXPECT_NEAR(std::accumulate(areas.begin(), areas.end(), 0.0), area_m2(corners), 1e-12 + 1e-12 * area_m2(corners));
    if (k % 10 == 0) continue;
    for (int layer = 0; layer < 7; ++layer) {
      std::vector<glm::dvec3> part(corners.begin(), corners.end());
      if (layer > 0) part = clipped(part, layer / double{layers.per_metre}, true);
      if (layer < 6) part = clipped(part, (layer + 1) / double{layers.per_metre}, false);
      EXPECT_NEAR(areas[static_cast<std::size_t>(layer)], polygon_area(part), 1e-9) << k << " layer " << layer;
    }
  }
}

TEST(AddAreaByLayer, PutsALevelTriangleIntoOneLayer) {
  for (const float y : {-1.0F, 0.1F, 0.26F, 0.5F, 9.0F}) {
    std::vector<double> areas(4);
    const Layers layers = layers_of(4, 1.0);
    add_area_by_layer(layers, {glm::vec3(0, y, 0), glm::vec3(0, y, 1), glm::vec3(1, y, 0)}, areas);
    const int expected = std::clamp(static_cast<int>(std::floor(4.0F * y)), 0, 3);
    for (int layer = 0; layer < 4; ++layer) EXPECT_EQ(areas[static_cast<std::size_t>(layer)], layer == expected ? 0.5 : 0.0);
  }
}

}  // namespace
}  // namespace sunfleck::test
