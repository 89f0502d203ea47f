#include "pictures/drawing/surface_image.h"

#include "base/check.h"

#include <algorithm>

namespace sunfleck {

std::vector<RowBand> row_bands(int width, int height, int samples) {
  EXPECT(std::min({width, height, samples}), >, 0);
  const std::int64_t samples_in_row = std::int64_t{width} * samples;
  const int rows = static_cast<int>(std::clamp<std::int64_t>(samples_in_band / samples_in_row, 1, height));
  std::vector<RowBand> bands;
  for (int first = 0; first < height; first += rows) bands.push_back({first, std::min(rows, height - first)});
  return bands;
}

}  // namespace sunfleck
