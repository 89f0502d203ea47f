#pragma once
// OpenEXR images whose pixels are measured values.

#include <cstdint>
#include <filesystem>
#include <string>
#include <variant>
#include <vector>

namespace sunfleck {

struct ExrChannel {
  std::string name;                                                     // 1 to 255 bytes, distinct within an image
  std::variant<std::vector<float>, std::vector<std::uint32_t>> values;  // [row from the top][column]
};

struct ExrImage {
  int width = 0;
  int height = 0;
  std::vector<ExrChannel> channels;
  std::string comments;  // attribute `comments` of the file: meaning and unit of the channels
};

// Writes a single-part scan-line image with ZIP compression and 32 bits per value: writes aside, then renames. Throws Error
// (failure).
void write_exr(const ExrImage& image, const std::filesystem::path& file);

}  // namespace sunfleck
