#include "pictures/drawing/surface_image.h"

#include "base/check.h"

#include <algorithm>

namespace sunfleck {
namespace {

// Viewers follow the samples of squares of pixels together, the largest of which have this many rows.
constexpr int whole_blocks = 4;

}  // namespace

std::vector<RowBand> row_bands(int width, int height, int samples) {
  EXPECT(std::min({width, height, samples}), >, 0);
  const std::int64_t samples_in_row = std::int64_t{width} * samples;
  int rows = static_cast<int>(std::clamp<std::int64_t>(samples_in_band / samples_in_row, 1, height));
  if (rows > whole_blocks) rows -= rows % whole_blocks;
  std::vector<RowBand> bands;
  for (int first = 0; first < height; first += rows) bands.push_back({first, std::min(rows, height - first)});
  return bands;
}

}  // namespace sunfleck
