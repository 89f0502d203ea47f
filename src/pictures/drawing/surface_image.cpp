#include "pictures/drawing/surface_image.h"

#include "base/check.h"

#include <algorithm>

namespace sunfleck {
namespace {

// Returns as many rows or a few less. Viewers follow the samples of squares of 4 x 4 or 2 x 2 pixels together.
int in_whole_squares(int rows) {
  return rows >= 4 ? rows - rows % 4 : rows >= 2 ? 2 : rows;
}

}  // namespace

std::vector<RowBand> row_bands(int width, int height, int samples, std::int64_t most_samples) {
  EXPECT(std::min({width, height, samples}), >, 0);
  const std::int64_t samples_in_row = std::int64_t{width} * samples;
  const int rows = in_whole_squares(static_cast<int>(std::clamp<std::int64_t>(most_samples / samples_in_row, 1, height)));
  std::vector<RowBand> bands;
  for (int first = 0; first < height; first += rows) bands.push_back({first, std::min(rows, height - first)});
  return bands;
}

}  // namespace sunfleck
