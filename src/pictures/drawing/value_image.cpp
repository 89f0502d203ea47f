#include "pictures/drawing/value_image.h"

#include "base/check.h"

#include <algorithm>

namespace sunfleck {
namespace {

// Returns the most frequent of sorted numbers, the lowest if tied.
std::uint32_t most_frequent(std::span<const std::uint32_t> sorted) {
  std::uint32_t best = SurfaceImage::nothing;
  std::ptrdiff_t most = 0;
  for (auto first = sorted.begin(); first != sorted.end();) {
    const auto last = std::upper_bound(first, sorted.end(), *first);
    if (last - first > most) {
      most = last - first;
      best = *first;
    }
    first = last;
  }
  return best;
}

}  // namespace

ValueImage resolve_values(const SurfaceImage& seen, std::span<const double> values) {
  EXPECT(std::min({seen.width, seen.height, seen.samples}), >, 0);
  const std::size_t pixels = static_cast<std::size_t>(seen.width) * seen.height;
  EXPECT(seen.surface.size(), ==, pixels * seen.samples);
  ValueImage image{seen.width, seen.height, {}, {}, {}};
  image.value.reserve(pixels);
  image.coverage.reserve(pixels);
  image.surface.reserve(pixels);
  std::vector<std::uint32_t> met;
  for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
    met.clear();
    double sum = 0.0;
    for (int sample = 0; sample < seen.samples; ++sample) {
      const std::uint32_t surface = seen.surface[pixel * seen.samples + sample];
      if (surface == SurfaceImage::nothing) continue;
      EXPECT(surface, <, values.size());
      sum += values[surface];
      met.push_back(surface);
    }
    std::sort(met.begin(), met.end());
    image.value.push_back(met.empty() ? 0.0F : static_cast<float>(sum / static_cast<double>(met.size())));
    image.coverage.push_back(static_cast<float>(met.size()) / static_cast<float>(seen.samples));
    image.surface.push_back(most_frequent(met));
  }
  return image;
}

void append_rows(ValueImage& image, const ValueImage& band) {
  EXPECT(image.height == 0 || image.width == band.width, ==, true);
  image.width = band.width;
  image.height += band.height;
  image.value.insert(image.value.end(), band.value.begin(), band.value.end());
  image.coverage.insert(image.coverage.end(), band.coverage.begin(), band.coverage.end());
  image.surface.insert(image.surface.end(), band.surface.begin(), band.surface.end());
}

}  // namespace sunfleck
