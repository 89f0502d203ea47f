#pragma once
// What the readers of weather share. Only they use it.

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

// Throws Error (input) `FILE:LINE: what (why); cure`; line 0: the place has no line.
[[noreturn]] void refuse(const WeatherSource& source, std::size_t line, std::string_view what, std::string_view why,
                         std::string_view cure);

// A line cut at its commas, blanks and double quotes about each cell taken off. The views are into `line`.
void split_cells(std::string_view line, std::vector<std::string_view>& cells);

}  // namespace sunfleck
