#pragma once
// Pictures of numbers instead of colours: the surfaces' values themselves.

#include "pictures/drawing/surface_image.h"

#include <cstdint>
#include <span>
#include <vector>

namespace sunfleck {

// Values, all [row][column], of a whole picture or a band of its rows.
struct ValueImage {
  int width = 0;
  int height = 0;
  std::vector<float> value;            // mean over the samples that see a surface; 0 if none does
  std::vector<float> coverage;         // share of the samples that see a surface, 0..1
  std::vector<std::uint32_t> surface;  // seen by most samples (the lowest number if tied), or SurfaceImage::nothing
};

// Averages the values of the surfaces seen. values: [surface number]. Copies of the plot have the plot's values.
[[nodiscard]] ValueImage resolve_values(const SurfaceImage& seen, std::span<const double> values);

// Appends the rows of `band` below those of `image`, which may still be empty.
void append_rows(ValueImage& image, const ValueImage& band);

}  // namespace sunfleck
