#pragma once
// Numbers instead of colours: a picture of the surfaces' values themselves.

#include "view/surface_image.h"

#include <cstdint>
#include <span>
#include <vector>

namespace sunfleck {

// All [row][column]. The rows of a whole picture, or of a band of it.
struct ValueImage {
  int width = 0;
  int height = 0;
  std::vector<float> value;            // mean over the samples that see a surface; 0 where none does
  std::vector<float> coverage;         // share of the samples that see a surface, 0..1
  std::vector<std::uint32_t> surface;  // the one that most samples see (the lowest number of several), or SurfaceImage::nothing
};

// values: [surface number]. Copies of the plot have the values of the plot.
[[nodiscard]] ValueImage resolve_values(const SurfaceImage& seen, std::span<const double> values);

// Puts the rows of `band` below those of `image`, which may be empty so far.
void append_rows(ValueImage& image, const ValueImage& band);

}  // namespace sunfleck
