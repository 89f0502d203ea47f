#include "pictures/drawing/value_image.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace sunfleck {
namespace {

constexpr std::uint32_t none = SurfaceImage::nothing;

// Returns two rows of two pixels with four samples each.
SurfaceImage four_pixels() {
  return {2, 2, 4, {none, none, none, none, 0, 1, none, 1, 2, 2, 0, 0, 1, 1, 1, 1}, std::vector<float>(16, 1.0F), {}, 0};
}

TEST(ResolveValues, AveragesTheSamplesThatSeeASurface) {
  const std::vector<double> values = {3.0, 6.0, 10.0};
  const ValueImage image = resolve_values(four_pixels(), values);
  EXPECT_EQ(image.width, 2);
  EXPECT_EQ(image.height, 2);
  EXPECT_EQ(image.value, (std::vector<float>{0.0F, 5.0F, 6.5F, 6.0F}));
  EXPECT_EQ(image.coverage, (std::vector<float>{0.0F, 0.75F, 1.0F, 1.0F}));
  EXPECT_EQ(image.surface, (std::vector<std::uint32_t>{none, 1, 0, 1}));
}

TEST(ResolveValues, RefusesASurfaceWithoutAValue) {
  EXPECT_THROW(static_cast<void>(resolve_values(four_pixels(), std::vector<double>{1.0, 2.0})), std::logic_error);
}

TEST(AppendRows, PutsBandsBelowEachOther) {
  const std::vector<double> values = {3.0, 6.0, 10.0};
  const SurfaceImage whole = four_pixels();
  ValueImage image;
  for (int row = 0; row < 2; ++row) {
    SurfaceImage band{2, 1, 4, {whole.surface.begin() + 8 * row, whole.surface.begin() + 8 * row + 8}, {}, {}, row};
    append_rows(image, resolve_values(band, values));
  }
  const ValueImage expected = resolve_values(whole, values);
  EXPECT_EQ(image.height, 2);
  EXPECT_EQ(image.value, expected.value);
  EXPECT_EQ(image.coverage, expected.coverage);
  EXPECT_EQ(image.surface, expected.surface);
  EXPECT_THROW(append_rows(image, ValueImage{3, 1, {}, {}, {}}), std::logic_error);
}

}  // namespace
}  // namespace sunfleck
