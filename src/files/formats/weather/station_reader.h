#pragma once
// Reads the CSV file of a weather station.

#include "files/formats/weather/weather_reader.h"

#include <filesystem>
#include <string_view>

namespace sunfleck {

// Returns the intervals of the file, but not its name; weather_reader.h describes the columns. Throws Error (input), one line.
[[nodiscard]] WeatherFile read_station(const std::filesystem::path& file, std::string_view bytes);

}  // namespace sunfleck
