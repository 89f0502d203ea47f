#pragma once
// Time series of broadband irradiance: a station's CSV and EnergyPlus weather (EPW).

#include "io/source_files.h"
#include "light/weather.h"

#include <array>
#include <filesystem>
#include <optional>

namespace sunfleck {

struct WeatherFile {
  Weather weather;             // of Source::intervals, with at least one
  std::optional<Place> place;  // where an EPW says it was measured
  // [month - 1], the year that an EPW's month stems from (months of typical years are of different ones).
  std::optional<std::array<int, 12>> years;
};

// True for .csv and .epw, in either case of letters.
[[nodiscard]] bool is_weather_file(const std::filesystem::path& file);

// Throws Error (input), one line `FILE:LINE: what (why); cure`. Values are W m-2 in 0..most_broadband_w_m2.
//
// CSV: a line of column names, then a row per interval in ascending order. `time` is ISO 8601 with an offset and marks the
// start of its interval, which lasts to the next row's, the last one as long as the one before; a step longer than the most
// common one is a gap behind an interval of that length. Irradiance in `ghi`, or `dni` and `dhi`; where all three are given
// ghi is not used. Other columns are not looked at, lines that begin with # and blank lines are skipped. A missing value is
// refused.
//
// EPW: eight header lines, then 8760 hours (8784 in a leap year) of local standard time. An hour's number, 1 to 24, marks its
// end. They hold in every year (Weather::every_year): a date is found by month, day and hour. Values marked as missing (from
// 9999) are kept as such and refused when they are used.
//
// `files`, where given, gets it.
[[nodiscard]] WeatherFile read_weather(const std::filesystem::path& file, SourceFiles* files = nullptr);

// More is no irradiance on earth but another unit (kJ, or a sum over the interval).
inline constexpr double most_broadband_w_m2 = 3000.0;

}  // namespace sunfleck
