#pragma once
// Holds what a camera sees as numbers: the link between viewing and colouring.

#include <cstdint>
#include <vector>

namespace sunfleck {

// The surface that each sample of each pixel sees, for a whole picture or some of its rows.
struct SurfaceImage {
  static constexpr std::uint32_t nothing = 0xffffffffU;
  int width = 0;
  int height = 0;                      // number of rows held
  int samples = 1;                     // per pixel
  std::vector<std::uint32_t> surface;  // [row][column][sample]: a surface number or `nothing`
  std::vector<float> depth_m;          // [row][column][sample]: as Appearance::depth_m of pictures/drawing/camera.h
  // [row][column][sample]: 0 where the plot itself is seen, 1 where a copy is seen; empty if there are no copies.
  std::vector<std::uint8_t> neighbour;
  int first_row = 0;  // number of the first row held, within the whole picture
};

struct RowBand {
  int first = 0;
  int count = 0;
};

// Divides the rows of a picture into bands of at most `most_samples` samples, or of one row if that has more, from top to bottom:
// the samples of a large picture never need to be in memory together.
[[nodiscard]] std::vector<RowBand> row_bands(int width, int height, int samples, std::int64_t most_samples);

}  // namespace sunfleck
