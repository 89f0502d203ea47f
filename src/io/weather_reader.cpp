#include "io/weather_reader.h"

#include "base/error.h"
#include "base/text.h"
#include "io/file.h"
#include "io/mesh_formats.h"
#include "io/weather_formats.h"

#include <fmt/format.h>

namespace sunfleck {

namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t most_bytes = std::uintmax_t{64} << 20U;  // three years of minutes

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
  return lower_extension(file) == ".epw" ? read_epw(source) : read_station(source);
}

void refuse(const WeatherSource& source, std::size_t line, std::string_view what, std::string_view why, std::string_view cure) {
  const std::string place = line == 0 ? source.file.string() : fmt::format("{}:{}", source.file.string(), line);
  throw_input(printable(fmt::format("{}: {}", place, what)), printable(why), cure);
}

void split_cells(std::string_view line, std::vector<std::string_view>& cells) {
  cells.clear();
  while (true) {
    const std::size_t comma = line.find(',');
    cells.push_back(unquoted(line.substr(0, comma)));
    if (comma == line.npos) return;
    line.remove_prefix(comma + 1);
  }
}

}  // namespace sunfleck
