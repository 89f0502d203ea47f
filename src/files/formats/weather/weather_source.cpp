#include "files/formats/weather/weather_source.h"

#include "base/text_reader.h"

namespace sunfleck {

void refuse(const WeatherSource& source, std::size_t line, std::string_view what, std::string_view why, std::string_view cure) {
  refuse_line(source.file, line, what, why, cure);
}

}  // namespace sunfleck
