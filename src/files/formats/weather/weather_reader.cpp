#include "files/formats/weather/weather_reader.h"

#include "base/file.h"
#include "base/text.h"
#include "base/text_reader.h"
#include "files/formats/weather/epw_reader.h"
#include "files/formats/weather/station_reader.h"

#include <cstdint>
#include <string>
#include <string_view>

namespace sunfleck {

namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t most_bytes = std::uintmax_t{64} << 20U;  // three years of minutes
constexpr std::size_t longest_name = 40;                          // bytes of a file's name in results

// Returns the text without the end-of-file marks of DOS at its end.
std::string_view without_dos_end(std::string_view text) {
  constexpr char dos_end = '\x1a';
  return text.substr(0, text.find_last_not_of(dos_end) + 1);
}

std::string lower_extension(const fs::path& file) {
  return lower_case(file.extension().string());
}

}  // namespace

bool is_weather_file(const fs::path& file) {
  const std::string extension = lower_extension(file);
  return extension == ".csv" || extension == ".epw";
}

WeatherFile read_weather(const fs::path& file, SourceFiles* files, std::optional<int> offset_minutes) {
  if (!is_weather_file(file)) refuse_line(file, 0, "unknown format", "weather files are .csv or .epw", "use one of these");
  const std::string bytes = read_source(file, files, most_bytes);
  const std::string_view text = without_dos_end(without_mark(bytes));
  if (text.empty()) refuse_line(file, 0, "the file is empty", "a weather file needs at least one row", "export it again");
  if (text.find('\0') != text.npos)
    refuse_line(file, 0, "contains a zero byte", "a weather file is plain text", "save it as UTF-8 text");
  const bool is_epw = lower_extension(file) == ".epw";
  if (is_epw && offset_minutes) {
    refuse_line(file, 0, "an offset from UTC is given", "an EPW file states its own", "remove utc_offset");
  }
  WeatherFile weather = is_epw ? read_epw(file, text) : read_station(file, text, offset_minutes);
  weather.weather.name = printable(shortened(file.filename().string(), longest_name));
  return weather;
}

}  // namespace sunfleck
