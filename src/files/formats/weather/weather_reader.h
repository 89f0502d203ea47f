#pragma once
// Reads time series of broadband irradiance: CSV files of a station and EnergyPlus weather (EPW).

#include "base/source_files.h"
#include "physics/light/weather.h"

#include <array>
#include <filesystem>
#include <optional>

namespace sunfleck {

struct WeatherFile {
  Weather weather;             // its source is Source::intervals; at least one interval
  std::optional<Place> place;  // the location stated by an EPW file
  // [month - 1], the year each month of an EPW file comes from; in typical years the months come from different years.
  std::optional<std::array<int, 12>> years;
};

// Returns true for .csv and .epw, in upper or lower case.
[[nodiscard]] bool is_weather_file(const std::filesystem::path& file);

// Reads a weather file; values are W m-2 in 0..most_broadband_w_m2. Ctrl-Z at its end, by which DOS ended a text, is ignored.
// Throws Error (input), one line `FILE:LINE: what (why); cure`. Adds the file to `files` if that is given.
//
// CSV: a line of column names, then one row per interval in ascending order. Commas separate the cells, or semicolons or tabs
// if the first line has any; a comma may then be the decimal mark. `time` is ISO 8601 and marks the start of the interval. All
// times state their offsets from UTC, or none does and `offset_minutes` is given. An interval lasts until the next row; the
// last one is as long as the one before. A step longer than the most common one is an interval of the common length followed by
// a gap. Irradiance is in `ghi`, in `ghi` and `dhi`, or in `dni` and `dhi`; if all three are present, ghi is not read. Other
// columns are ignored, and so are blank lines and lines that begin with #. A missing value is refused.
//
// EPW: eight header lines, then 8760 hours (8784 in a leap year) of local standard time. The number of an hour, 1 to 24, marks
// its end. The data hold for every year (Weather::every_year): a date is looked up by month, day and hour. Values marked as
// missing (9999 and above) are kept as such and refused only when used. `offset_minutes` is not for them.
[[nodiscard]] WeatherFile read_weather(const std::filesystem::path& file, SourceFiles* files = nullptr,
                                       std::optional<int> offset_minutes = {});

// Larger values are not irradiance on earth but are in another unit (kJ, or a sum over the interval).
inline constexpr double most_broadband_w_m2 = 3000.0;

}  // namespace sunfleck
