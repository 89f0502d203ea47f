// Tests the tree of a canopy in which copies share the triangles of their mesh.

#include "devices/tracers/cpu_walk.h"
#include "physics/bvh/build.h"
#include "physics/bvh/decode.h"
#include "support/copies.h"
#include "support/error_text.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <set>
#include <string>
#include <tuple>
#include <utility>

namespace sunfleck::test {
namespace {

// Checks the triangles below a node: they lie in its children's boxes, padded. Returns the box around them.
Box inspect(const Bvh& bvh, std::uint32_t number, float padding_m, std::multiset<std::uint32_t>& triangles) {
  const BvhNode& node = bvh.nodes[number];
  Box all{glm::vec3(1e9F), glm::vec3(-1e9F)};
  std::uint32_t next = node.child_base;
  for (int slot = 0; slot < 8; ++slot) {
    const unsigned meta = node.meta[static_cast<std::size_t>(slot)];
    if (meta == 0) continue;
    Box held{glm::vec3(1e9F), glm::vec3(-1e9F)};
    if ((node.inner_mask >> slot & 1) != 0) {
      held = inspect(bvh, next++, padding_m, triangles);
    } else {
      const std::uint32_t first = node.triangle_base + (meta & 31U);
      for (std::uint32_t k = first; k < first + static_cast<std::uint32_t>(std::popcount(meta >> 5U)); ++k) {
        triangles.insert(k);
        for (const auto& at : {bvh.triangles[k].a, bvh.triangles[k].b, bvh.triangles[k].c}) {
          held.lo = glm::min(held.lo, glm::vec3(at[0], at[1], at[2]));
          held.hi = glm::max(held.hi, glm::vec3(at[0], at[1], at[2]));
        }
      }
    }
    const Box box = child_box(node, slot);
    EXPECT_EQ(glm::min(box.lo, held.lo - padding_m), box.lo);
    EXPECT_EQ(glm::max(box.hi, held.hi + padding_m), box.hi);
    all.lo = glm::min(all.lo, held.lo);
    all.hi = glm::max(all.hi, held.hi);
  }
  return all;
}

// Checks that the copies of every mesh hold each of its triangles once in every period into which their piece reaches.
void expect_all_copies(const RadiationModel& model, const Bvh& bvh) {
  std::set<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>> copies;  // element, image, first triangle
  std::uint64_t order = 0;
  for (const std::uint32_t node : bvh.copies) {
    ASSERT_TRUE(is_copy(bvh.nodes[node]));
    const BvhCopy copy = copy_at(bvh, node);
    EXPECT_EQ(static_cast<std::uint32_t>(copy.order_offset + copy.first_triangle), order);
    order += copy.triangles;
    EXPECT_TRUE(copies.emplace(copy.first_element, copy.image, copy.first_triangle).second);
  }
  std::size_t expected = 0;
  for (const std::uint32_t node : bvh.copies) {
    const BvhCopy copy = copy_at(bvh, node);
    if (copy.image != 0 || bvh.parts[copy.part].mesh == own_corners) {
      expected += bvh.parts[copy.part].mesh == own_corners ? 1 : 0;
      continue;
    }
    Box box{glm::vec3(1e9F), glm::vec3(-1e9F)};
    for (std::uint32_t k = copy.first_triangle; k < copy.first_triangle + copy.triangles; ++k) {
      for (const glm::vec3& corner : model.canopy.corners[copy.first_element + bvh.triangles[k].element]) {
        box.lo = glm::min(box.lo, corner);
        box.hi = glm::max(box.hi, corner);
      }
    }
    for (int dx = -4; dx <= 4; ++dx) {
      for (int dz = -4; dz <= 4; ++dz) {
        const bool reaches = box.lo.x + dx <= 1.0F && box.hi.x + dx >= 0.0F && box.lo.z + dz <= 1.0F && box.hi.z + dz >= 0.0F;
        EXPECT_EQ(copies.contains({copy.first_element, pack_image(dx, dz), copy.first_triangle}), reaches);
        expected += reaches ? 1 : 0;
      }
    }
  }
  EXPECT_EQ(copies.size(), expected);
}

// The origins of all plants lie in the plot, but not all of their pieces do: those of the larger plants may be seen from other
// periods alone.
TEST(TwoLevels, HoldEachMeshOnceAndEachCopyInEveryPeriod) {
  for (const int leaves : {30, 400}) {
    CopiesStand stand{unit_plot, 12, true, 6};
    stand.leaves = leaves;
    const RadiationModel model = stand_of_copies(stand, true);
    constexpr float padding_m = 1e-4F;
    const Bvh bvh = build_bvh(model.canopy, padding_m);
    ASSERT_EQ(bvh.parts.size(), 3U);
    EXPECT_EQ(bvh.parts[0].mesh, own_corners);
    EXPECT_EQ(bvh.parts[1].triangles, model.canopy.corners.meshes()[0].corners.size());
    EXPECT_EQ(bvh.parts[2].triangles, model.canopy.corners.meshes()[1].corners.size());
    EXPECT_LE(bvh.depth, max_bvh_depth);
    std::multiset<std::uint32_t> triangles;
    // Copies are scaled by at least 0.5 here, which doubles the padding at most, and by 1.6, which makes it smaller.
    for (const BvhPart& part : bvh.parts) {
      inspect(bvh, part.root, part.mesh == own_corners ? padding_m : 0.5F * padding_m, triangles);
    }
    EXPECT_EQ(triangles.size(), bvh.triangles.size());
    EXPECT_EQ(std::set(triangles.begin(), triangles.end()).size(), bvh.triangles.size());
    const std::size_t of_one_plant =
        static_cast<std::size_t>(std::count_if(bvh.copies.begin(), bvh.copies.end(), [&](std::uint32_t node) {
          const BvhCopy copy = copy_at(bvh, node);
          return copy.part == 1 && copy.first_element == model.canopy.corners.copies()[0].first_element && copy.image == 0;
        }));
    if (leaves < 256) {
      EXPECT_EQ(of_one_plant, 1U);
      expect_all_copies(model, bvh);
    } else {
      EXPECT_GT(of_one_plant, 1U);
    }
  }
}

TEST(TwoLevels, AreWalkedToTheHitsOfATestOfEveryTriangle) {
  for (const auto& [plot, leaves] : {std::pair{unit_plot, 30}, std::pair{unit_stand, 30}, std::pair{unit_plot, 300}}) {
    const RadiationModel model = stand_of_copies({plot, 12, true, 8, leaves}, true);
    const Prepared prepared(model);
    Random random(3);
    int hits = 0;
    for (int k = 0; k < 3000; ++k) {
      const glm::vec3 origin(random.uniform(), random.uniform(0.0, 1.0), random.uniform());
      const glm::vec3 direction = inclined(std::acos(random.uniform(-1.0, 1.0)), random.uniform(0.0, 6.28));
      const shared::Ray ray = shared::make_ray(origin, direction);
      const CpuHit walked = nearest_hit(prepared.bvh, ray, 2.0F);
      const CpuHit tested = nearest_hit_of_all(prepared.bvh, ray, 2.0F);
      ASSERT_EQ(walked.found, tested.found);
      if (!walked.found) continue;
      ++hits;
      EXPECT_EQ(walked.element, tested.element);
      EXPECT_EQ(walked.triangle, tested.triangle);
      EXPECT_EQ(walked.copy, tested.copy);
      EXPECT_EQ(walked.t, tested.t);
      const OwnElement own{walked.element,
                           copy_at(prepared.bvh, walked.copy).image | prepared.bvh.triangles[walked.reference].image};
      const CpuHit beyond = nearest_hit(prepared.bvh, ray, 2.0F, Images::all, own);
      EXPECT_TRUE(!beyond.found || beyond.element != walked.element || beyond.triangle != walked.triangle);
    }
    EXPECT_GT(hits, 1000);
  }
}

// The plant reaches over some 100 million periods, whose copies would take 10 GB.
TEST(TwoLevels, RefuseMoreTrianglesThanATreeHoldsBeforeTheyTakeMemory) {
  const Plot plot{5e-5, 5e-5, true};
  const std::vector<PlacedMesh> parts = {{leafy_plant(30, 1), {Placement{}}, {}, true}};
  const Canopy canopy = assemble_canopy(parts, plot);
  expect_refusal([&] { static_cast<void>(build_bvh(canopy, 1e-6F)); }, "a tree holds at most 2147483648");
}

}  // namespace
}  // namespace sunfleck::test
