#pragma once
// Writes PNG files.

#include "pictures/drawing/image.h"

#include <filesystem>

namespace sunfleck {

// Writes the file aside and renames it. Throws Error (failure).
void write_png(const Image& image, const std::filesystem::path& file);

}  // namespace sunfleck
