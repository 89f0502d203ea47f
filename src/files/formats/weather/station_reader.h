#pragma once
// Reads the CSV file of a weather station.

#include "files/formats/weather/weather_reader.h"

#include <filesystem>
#include <optional>
#include <string_view>

namespace sunfleck {

// Returns the intervals of the file, but not its name; see weather_reader.h. Throws Error (input), one line.
[[nodiscard]] WeatherFile read_station(const std::filesystem::path& file, std::string_view bytes,
                                       std::optional<int> offset_minutes);

// Returns the minutes of an offset from UTC written as Z, +08, +0800 or +08:00, positive to the east; nothing for other texts.
[[nodiscard]] std::optional<int> parse_utc_offset(std::string_view text);

}  // namespace sunfleck
