#pragma once
// Reads EnergyPlus weather as specified by its data dictionary ("Auxiliary Programs", EnergyPlus 24.1).

#include "files/formats/weather/weather_reader.h"

#include <filesystem>
#include <string_view>

namespace sunfleck {

// Returns the hours of the file with its place and years, but not its name; see weather_reader.h. Throws Error (input), one
// line.
[[nodiscard]] WeatherFile read_epw(const std::filesystem::path& file, std::string_view bytes);

}  // namespace sunfleck
