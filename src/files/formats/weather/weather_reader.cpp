#include "files/formats/weather/weather_reader.h"

#include "base/file.h"
#include "base/text.h"
#include "files/formats/weather/epw_reader.h"
#include "files/formats/weather/station_reader.h"
#include "files/formats/weather/weather_source.h"

#include <fmt/format.h>

#include <cstdint>
#include <string>
#include <system_error>

namespace sunfleck {

namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t most_bytes = std::uintmax_t{64} << 20U;  // three years of minutes
constexpr std::size_t longest_name = 40;                          // bytes of a file's name in results

std::string lower_extension(const fs::path& file) {
  return lower_case(file.extension().string());
}

}  // namespace

bool is_weather_file(const fs::path& file) {
  const std::string extension = lower_extension(file);
  return extension == ".csv" || extension == ".epw";
}

WeatherFile read_weather(const fs::path& file, SourceFiles* files) {
  WeatherSource source{file, {}};
  if (!is_weather_file(file)) refuse(source, 0, "unknown format", "weather files are .csv or .epw", "use one of these");
  std::error_code code;
  const std::uintmax_t size = fs::file_size(file, code);
  if (!code && size > most_bytes) {
    refuse(source, 0, fmt::format("has {} bytes", size), fmt::format("at most {} are allowed", most_bytes),
           "cut out the days of interest");
  }
  const std::string bytes = read_source(file, files);
  source.bytes = without_mark(bytes);
  if (source.bytes.empty()) refuse(source, 0, "the file is empty", "a weather file needs at least one row", "export it again");
  if (bytes.find('\0') != std::string::npos) {
    refuse(source, 0, "contains a zero byte", "a weather file is plain text", "save it as UTF-8 text");
  }
  WeatherFile weather = lower_extension(file) == ".epw" ? read_epw(source) : read_station(source);
  weather.weather.name = printable(shortened(file.filename().string(), longest_name));
  return weather;
}

}  // namespace sunfleck
