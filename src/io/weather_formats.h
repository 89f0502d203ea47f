#pragma once
// Declarations shared by the weather readers, and used only by them.

#include "io/weather_reader.h"

#include <string>
#include <string_view>
#include <vector>

namespace sunfleck {

struct WeatherSource {
  std::filesystem::path file;
  std::string_view bytes;
};

[[nodiscard]] WeatherFile read_station(const WeatherSource& source);
[[nodiscard]] WeatherFile read_epw(const WeatherSource& source);

// Throws Error (input) `FILE:LINE: what (why); cure`. Line 0 leaves the line out.
[[noreturn]] void refuse(const WeatherSource& source, std::size_t line, std::string_view what, std::string_view why,
                         std::string_view cure);

// Splits a line at its commas and strips blanks and double quotes from each cell. The views point into `line`.
void split_cells(std::string_view line, std::vector<std::string_view>& cells);

}  // namespace sunfleck
