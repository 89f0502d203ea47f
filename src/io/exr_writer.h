#pragma once
// OpenEXR files: pictures whose pixels are measured values.

#include <cstdint>
#include <filesystem>
#include <string>
#include <variant>
#include <vector>

namespace sunfleck {

struct ExrChannel {
  std::string name;                                                     // 1 to 255 bytes, no two of an image equal
  std::variant<std::vector<float>, std::vector<std::uint32_t>> values;  // [row from the top][column]
};

struct ExrImage {
  int width = 0;
  int height = 0;
  std::vector<ExrChannel> channels;
  std::string comments;  // the file's attribute of that name: what the channels hold, and in which unit
};

// One part of scan lines with ZIP compression, 32 bits a value. Written aside and renamed. Throws Error (failure).
void write_exr(const ExrImage& image, const std::filesystem::path& file);

}  // namespace sunfleck
