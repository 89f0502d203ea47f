#include "files/formats/weather/epw_reader.h"

#include "base/text_reader.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sunfleck {

namespace {

constexpr std::size_t header_lines = 8;
// Fields are numbered from 1, as in the data dictionary.
constexpr std::size_t ghi_field = 14, dni_field = 15, dhi_field = 16;
constexpr double missing_from = 9999.0;  // the dictionary's code for a missing value of all three
constexpr std::size_t ordinary_hours = 8760, leap_hours = 8784;
constexpr int ordinary_year = 2001, leap_year = 2000;  // stand for every ordinary and every leap year
constexpr std::string_view again = "download the file again, or use another one";

class EpwReader {
 public:
  EpwReader(const std::filesystem::path& file, std::string_view bytes) : file_(file), lines_(bytes) {}

  WeatherFile read() {
    read_header();
    while (lines_.next()) {
      if (trimmed(lines_.line()).empty()) continue;
      split_cells(lines_.line(), cells_);
      read_hour();
    }
    const std::size_t hours = result_.weather.intervals.size();
    if (hours != ordinary_hours && hours != leap_hours) {
      refuse_line(file_, 0, fmt::format("{} rows found", hours),
                  fmt::format("a year has {} or {} hours", ordinary_hours, leap_hours), again);
    }
    result_.weather.source = Weather::Source::intervals;
    result_.weather.every_year = true;
    result_.years = years_;
    const UtcTime first{.year = hours == leap_hours ? leap_year : ordinary_year};
    for (std::size_t i = 0; i < hours; ++i) {
      result_.weather.intervals[i].start =
          plus_seconds(first, 3600.0 * static_cast<double>(i) - 60.0 * result_.weather.zone_minutes);
    }
    return std::move(result_);
  }

 private:
  [[nodiscard]] double number(std::size_t field, std::string_view name) const {
    const std::string_view cell = field <= cells_.size() ? cells_[field - 1] : std::string_view();
    const std::optional<double> value = parse_number(cell);
    if (!value) {
      refuse_line(file_, lines_.number(), fmt::format("{} {}", name, in_quotes(cell)),
                  fmt::format("field {} must be a number", field), again);
    }
    return *value;
  }
  [[nodiscard]] double number(std::size_t field, std::string_view name, double lo, double hi) const {
    const double value = number(field, name);
    if (value < lo || value > hi) {
      refuse_line(file_, lines_.number(), fmt::format("{} = {}", name, value), fmt::format("must lie in {}..{}", lo, hi),
                  "correct it");
    }
    return value;
  }

  void read_header() {
    for (std::size_t i = 0; i < header_lines; ++i) {
      if (!lines_.next())
        refuse_line(file_, 0, fmt::format("ends after {} lines", i), "an EPW file begins with eight header lines", again);
      split_cells(lines_.line(), cells_);
      if (i == 0) read_location();
      if (cells_.front() == "DATA PERIODS" && number(3, "records per hour") != 1.0) {
        refuse_line(file_, lines_.number(), fmt::format("{} records per hour", cells_[2]), "only one is supported",
                    "use hourly values, or a CSV");
      }
    }
  }

  void read_location() {
    if (cells_.front() != "LOCATION") {
      refuse_line(file_, 1, fmt::format("begins with {}", in_quotes(cells_.front())), "an EPW file begins with LOCATION",
                  again);
    }
    Place place;
    place.latitude_rad = glm::radians(number(7, "latitude", -90.0, 90.0));
    place.longitude_rad = glm::radians(number(8, "longitude", -180.0, 180.0));
    result_.weather.zone_minutes = static_cast<int>(std::lround(60.0 * number(9, "time zone", -12.0, 14.0)));
    place.altitude_m = number(10, "elevation", -1000.0, 9999.9);
    result_.place = place;
  }

  // Checks that month, day and hour follow those of the row before. A leap year is recognised by its 29 February.
  void expect_next(int month, int day, int hour) {
    if (month == 2 && day == 29 && hour == 1 && month_ == 2 && day_ == 28 && hour_ == 24) days_in_[1] = 29;
    if (++hour_ > 24) {
      hour_ = 1;
      if (++day_ > days_in_[month_ - 1]) {
        day_ = 1;
        ++month_;
      }
    }
    if (month == month_ && day == day_ && hour == hour_) return;
    refuse_line(
        file_, lines_.number(), fmt::format("month {}, day {}, hour {}", month, day, hour),
        month_ > 12 ? std::string("the year is over") : fmt::format("hour {} of {}/{} is expected", hour_, month_, day_),
        again);
  }

  [[nodiscard]] double irradiance(std::size_t field, std::string_view name) const {
    const double value = number(field, name);
    if (value >= missing_from) return -1.0;
    if (value < 0.0 || value > most_broadband_w_m2) {
      refuse_line(file_, lines_.number(), fmt::format("{} = {}", name, value),
                  fmt::format("must lie in 0..{} Wh m-2, or be {}", most_broadband_w_m2, missing_from), "correct it");
    }
    return value;
  }

  void read_hour() {
    const int year = static_cast<int>(number(1, "year", 1.0, 9999.0));
    const int month = static_cast<int>(number(2, "month", 1.0, 12.0));
    const int day = static_cast<int>(number(3, "day", 1.0, 31.0));
    const int hour = static_cast<int>(number(4, "hour", 1.0, 24.0));
    expect_next(month, day, hour);
    years_[static_cast<std::size_t>(month - 1)] = year;
    WeatherInterval interval;
    interval.line = lines_.number();
    interval.length_s = 3600.0;
    interval.ghi_w_m2 = irradiance(ghi_field, "global horizontal radiation");
    interval.dni_w_m2 = irradiance(dni_field, "direct normal radiation");
    interval.dhi_w_m2 = irradiance(dhi_field, "diffuse horizontal radiation");
    result_.weather.intervals.push_back(interval);
  }

  const std::filesystem::path& file_;
  LineReader lines_;
  std::vector<std::string_view> cells_;
  WeatherFile result_;
  std::array<int, 12> years_{};
  std::array<int, 12> days_in_{31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
  int month_ = 1, day_ = 1, hour_ = 0;
};

}  // namespace

WeatherFile read_epw(const std::filesystem::path& file, std::string_view bytes) {
  return EpwReader(file, bytes).read();
}

}  // namespace sunfleck
