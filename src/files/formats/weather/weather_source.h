#pragma once
// The file that a weather reader reads, with messages about it.

#include <cstddef>
#include <filesystem>
#include <string_view>

namespace sunfleck {

struct WeatherSource {
  std::filesystem::path file;
  std::string_view bytes;
};

// Throws Error (input) `FILE:LINE: what (why); cure`. Line 0 leaves the line out.
[[noreturn]] void refuse(const WeatherSource& source, std::size_t line, std::string_view what, std::string_view why,
                         std::string_view cure);

}  // namespace sunfleck
