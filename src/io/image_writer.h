#pragma once
// PNG files.

#include "view/image.h"

#include <filesystem>

namespace sunfleck {

// Written aside and renamed. Throws Error (failure).
void write_png(const Image& image, const std::filesystem::path& file);

}  // namespace sunfleck
