#pragma once
// What a camera sees, as numbers: the link between looking and colouring.

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sunfleck {

// What each sample of each pixel sees, in a whole picture or in some of its rows.
struct SurfaceImage {
  static constexpr std::uint32_t nothing = 0xffffffffU;
  int width = 0;
  int height = 0;                      // rows that are here
  int samples = 1;                     // a pixel
  std::vector<std::uint32_t> surface;  // [row][column][sample]: a surface number or `nothing`
  std::vector<float> depth_m;          // [row][column][sample]: as Appearance::depth_m of view/camera.h
  // [row][column][sample]: 0 where the plot itself is seen, 1 where a copy of it is; empty where there are no copies.
  std::vector<std::uint8_t> neighbour;
  int first_row = 0;  // the number, in the whole picture, of the first row that is here
};

struct RowBand {
  int first = 0;
  int count = 0;
};

// The rows of a picture cut into bands of some four million samples, so that the samples of a picture of any size need never be
// in memory together. Top to bottom.
[[nodiscard]] std::vector<RowBand> row_bands(int width, int height, int samples);

}  // namespace sunfleck
