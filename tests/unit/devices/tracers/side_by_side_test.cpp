// Tests that searches side by side find, bit for bit, the hits of searches one after the other.
#include "devices/tracers/side_by_side.h"

#include "physics/bvh/build.h"
#include "support/bvh_check.h"
#include "support/copies.h"
#include "support/models.h"
#include "support/processor_kinds.h"
#include "support/walks.h"

#include <gtest/gtest.h>

#include <array>
#include <optional>
#include <utility>
#include <vector>

namespace sunfleck {
namespace {

using testing_bvh::isolated;
using testing_bvh::Random;
using testing_bvh::scattered;
using testing_bvh::uniform;

// Hands out searches in their order and keeps their hits.
class ListedSearches final : public SearchSource {
 public:
  explicit ListedSearches(std::vector<Search> searches) : searches_(std::move(searches)), hits_(searches_.size()) {}

  bool begin(std::size_t slot, Search& search) override {
    if (begun_ == searches_.size()) return false;
    number_[slot] = begun_;
    search = searches_[begun_++];
    return true;
  }

  bool next(std::size_t slot, const CpuHit& hit, Search& search) override {
    EXPECT_FALSE(hits_[number_[slot]]) << "each search has one hit";
    hits_[number_[slot]] = hit;
    return begin(slot, search);
  }

  void expect_hits_of_single_searches(const Bvh& bvh) const {
    std::vector<CpuHit> expected;
    for (const Search& search : searches_) {
      expected.push_back(nearest_hit(bvh, search.ray, search.limit, Images::all, search.own));
    }
    expect_hits(expected);
  }

  void expect_hits(const std::vector<CpuHit>& expected) const {
    for (std::size_t k = 0; k < searches_.size(); ++k) {
      SCOPED_TRACE(k);
      ASSERT_TRUE(hits_[k]);
      test::expect_same_hit(*hits_[k], expected[k]);
    }
  }

  [[nodiscard]] std::size_t found() const {
    std::size_t count = 0;
    for (const auto& hit : hits_) count += hit && hit->found ? 1 : 0;
    return count;
  }

 private:
  std::vector<Search> searches_;
  std::vector<std::optional<CpuHit>> hits_;
  std::size_t begun_ = 0;
  std::array<std::size_t, searches_at_once> number_{};
};

std::vector<Search> random_searches(std::size_t count, std::uint32_t elements, unsigned seed) {
  Random random(seed);
  std::vector<Search> searches;
  for (std::size_t k = 0; k < count; ++k) {
    const glm::vec3 direction = testing_bvh::point(random, 1.0);
    const auto limit = static_cast<float>(k % 3 == 0 ? 0.5 * uniform(random) : 1e30);
    const OwnElement own{static_cast<std::uint32_t>(uniform(random) * elements), 0};
    searches.push_back({shared::make_ray(testing_bvh::point(random, 0.5), direction), limit, own});
  }
  return searches;
}

TEST(SideBySide, AnyNumberOfSearchesFindsTheHitsOfSingleOnes) {
  constexpr std::uint32_t triangles = 3000;
  const Bvh bvh = build_bvh(isolated(scattered(triangles, 0.5, 0.05, 1)), 1e-5F);
  for (const std::size_t count : {std::size_t{0}, std::size_t{1}, searches_at_once - 1, searches_at_once, std::size_t{5000}}) {
    ListedSearches searches(random_searches(count, triangles, 2));
    search_side_by_side(bvh, searches);
    searches.expect_hits_of_single_searches(bvh);
    if (count < 1000) continue;
    EXPECT_GT(searches.found(), count / 4);
    EXPECT_LT(searches.found(), count) << "some rays must miss";
  }
}

// Expects that searches in vectors of every width find what a test of every triangle finds.
void expect_nearest_on_each_processor(const Bvh& bvh, std::uint32_t elements) {
  constexpr std::size_t count = 400;
  const std::vector<Search> searches = random_searches(count, elements, 5);
  std::vector<CpuHit> expected;
  for (const Search& search : searches) {
    expected.push_back(nearest_hit_of_all(bvh, search.ray, search.limit, search.own));
  }
  test::for_each_processor_kind([&] {
    ListedSearches listed(searches);
    search_side_by_side(bvh, listed);
    listed.expect_hits_of_single_searches(bvh);
    listed.expect_hits(expected);
    EXPECT_GT(listed.found(), count / 4);
    EXPECT_LT(listed.found(), count) << "some rays must miss";
  });
}

TEST(SideBySide, OnEachKindOfProcessorFindsTheHitsOfATestOfEveryTriangle) {
  constexpr std::uint32_t triangles = 600;
  expect_nearest_on_each_processor(build_bvh(isolated(scattered(triangles, 0.5, 0.1, 4)), 1e-5F), triangles);
}

TEST(SideBySide, AmongCopiesOnEachKindOfProcessorFindsTheHitsOfATestOfEveryTriangle) {
  const RadiationModel model = test::stand_of_copies({test::unit_plot, 12, true, 3}, true);
  const test::Prepared prepared(model);
  ASSERT_FALSE(prepared.bvh.copies.empty());
  expect_nearest_on_each_processor(prepared.bvh, static_cast<std::uint32_t>(model.canopy.size()));
}

TEST(SideBySide, WithoutTrianglesNothingIsFound) {
  ListedSearches searches(random_searches(20, 1, 3));
  search_side_by_side(Bvh(), searches);
  searches.expect_hits_of_single_searches(Bvh());
  EXPECT_EQ(searches.found(), 0U);
}

}  // namespace
}  // namespace sunfleck
