// Tests that no face has more light than the limits of the pictures' scales allow.
#include "pictures/charts/colouring.h"
#include "pictures/charts/fields.h"
#include "support/leaf_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace sunfleck::test {
namespace {

TEST(LargestPossible, IsNotExceededByALongRun) {
  const RadiationModel model = leaves_in_the_open();
  const Prepared prepared(model);
  const RadiationResult result = simulate(model, prepared, fixed_scatter(model, {.rays = 4e6, .packets = 2e5, .bound = 1e-3}));
  for (const LightField field :
       {LightField::direct, LightField::sky, LightField::indirect, LightField::total, LightField::scattered}) {
    const FieldValues sides = field_values(model, prepared.layout, result, 0, field);
    const FieldValues leaves = leaf_values(model, sides, field);
    const auto largest = [](const FieldValues& values) { return *std::max_element(values.w_m2.begin(), values.w_m2.end()); };
    EXPECT_LE(largest(sides), 1.05 * largest_possible_w_m2(model, 0, field, 1)) << "5 % for noise";
    EXPECT_LE(largest(leaves), 1.05 * largest_possible_w_m2(model, 0, field, 2));
    const double on_soil =
        *std::max_element(sides.w_m2.begin() + static_cast<std::ptrdiff_t>(sides.first_cell), sides.w_m2.end());
    EXPECT_LE(on_soil, 1.05 * largest_on_soil_w_m2(model, 0, field));
  }
}

}  // namespace
}  // namespace sunfleck::test
