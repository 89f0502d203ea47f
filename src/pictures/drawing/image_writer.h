#pragma once
// Writes PNG files.

#include "pictures/drawing/image.h"

#include <filesystem>
#include <string>

namespace sunfleck {

// Returns the bytes of a PNG file; none if memory is too short.
[[nodiscard]] std::string encoded_png(const Image& image);

// Writes what encoded_png() returned aside and renames it. Throws Error (failure), also if there are no bytes.
void write_encoded_png(const std::string& bytes, const std::filesystem::path& file);

// Does both.
void write_png(const Image& image, const std::filesystem::path& file);

}  // namespace sunfleck
