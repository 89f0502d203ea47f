#include "files/formats/weather/station_reader.h"

#include "base/text.h"
#include "base/text_reader.h"
#include "physics/light/years.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <chrono>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sunfleck {

namespace {

constexpr std::size_t not_there = static_cast<std::size_t>(-1);
constexpr double missing_w_m2 = -90.0;  // from here down a value marks one that is missing, as -99.9 or -9999 do
constexpr std::string_view time_cure = "write it as 2002-08-08T10:10:00+08:00";

struct Columns {
  std::size_t count = 0;
  std::size_t time = not_there, ghi = not_there, dni = not_there, dhi = not_there;
};

// Removes exactly `count` digits from the front of `rest` and returns their value; nothing if there are other characters.
std::optional<int> take_digits(std::string_view& rest, std::size_t count) {
  if (rest.size() < count) return std::nullopt;
  int value = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (rest[i] < '0' || rest[i] > '9') return std::nullopt;
    value = 10 * value + (rest[i] - '0');
  }
  rest.remove_prefix(count);
  return value;
}
bool take(std::string_view& rest, std::string_view any_of) {
  if (rest.empty() || any_of.find(rest.front()) == any_of.npos) return false;
  rest.remove_prefix(1);
  return true;
}
// Removes one of the separators and two digits.
std::optional<int> take_part(std::string_view& rest, std::string_view separators) {
  return take(rest, separators) ? take_digits(rest, 2) : std::nullopt;
}

// Removes a colon and seconds with decimals; returns 0 if there are none.
std::optional<double> take_seconds(std::string_view& rest) {
  if (rest.empty() || rest.front() != ':') return 0.0;
  const std::optional<int> whole = take_part(rest, ":");
  if (!whole) return std::nullopt;
  double second = *whole;
  if (!take(rest, ".,")) return second;
  std::size_t digits = 0;
  for (double unit = 0.1; !rest.empty() && std::isdigit(static_cast<unsigned char>(rest.front())) != 0; unit /= 10.0) {
    second += unit * (rest.front() - '0');
    rest.remove_prefix(1);
    ++digits;
  }
  return digits > 0 ? std::optional<double>(second) : std::nullopt;
}

class StationReader {
 public:
  StationReader(const std::filesystem::path& file, std::string_view bytes, std::optional<int> offset_minutes)
      : file_(file), bytes_(bytes), offset_minutes_(offset_minutes) {}

  WeatherFile read() {
    LineReader lines(bytes_);
    while (lines.next()) {
      const std::string_view line = trimmed(lines.line());
      if (line.empty() || line.front() == '#') continue;
      line_ = lines.number();
      if (columns_.count == 0) separator_ = separator_of(line);
      split_cells(line, cells_, separator_);
      if (columns_.count == 0) {
        read_header();
      } else {
        read_row();
      }
    }
    if (columns_.count == 0)
      refuse_line(file_, 0, "no line of column names found", "the file has no rows", "begin with time,ghi");
    if (intervals_.size() < 2) {
      refuse_line(file_, 0, fmt::format("{} row found", intervals_.empty() ? "no" : "one"),
                  "an interval lasts until the next one starts, so at least two are needed", "add rows");
    }
    set_lengths();
    WeatherFile result;
    result.weather.source = Weather::Source::intervals;
    result.weather.intervals = std::move(intervals_);
    result.weather.zone_minutes = zone_minutes_;
    return result;
  }

 private:
  void read_header() {
    columns_.count = cells_.size();
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      const std::string name = lower_case(cells_[i]);
      for (const auto& [known, column] :
           {std::pair{"time", &columns_.time}, {"ghi", &columns_.ghi}, {"dni", &columns_.dni}, {"dhi", &columns_.dhi}}) {
        if (name != known) continue;
        if (*column != not_there) refuse_line(file_, line_, fmt::format("column {}", known), "appears twice", "keep one");
        *column = i;
      }
    }
    if (columns_.time == not_there) {
      refuse_line(file_, line_, fmt::format("the line of column names is {}", in_quotes(cells_.front())),
                  "no column is named time", "begin with a line such as time,ghi or time,dni,dhi");
    }
    const bool has_ghi = columns_.ghi != not_there, has_dni = columns_.dni != not_there, has_dhi = columns_.dhi != not_there;
    if (has_dni && !has_dhi) {
      refuse_line(file_, line_, "column dhi is missing", "direct normal irradiance needs the diffuse one beside it",
                  "add it, or give only ghi");
    }
    if (has_dhi && !has_ghi && !has_dni) {
      refuse_line(file_, line_, "columns ghi and dni are missing", "diffuse irradiance needs one of them beside it",
                  "add ghi or dni");
    }
    if (!has_ghi && !has_dni) {
      refuse_line(file_, line_, "no irradiance", "no columns are named ghi, or dni and dhi", "add such columns, in W m-2");
    }
  }

  void read_row() {
    if (cells_.size() != columns_.count) {
      refuse_line(file_, line_, fmt::format("{} cells", cells_.size()), fmt::format("there are {} columns", columns_.count),
                  fmt::format("give every column a value, separated by {}", name_of_separator(separator_)));
    }
    WeatherInterval interval;
    interval.line = line_;
    interval.start = read_time(cells_[columns_.time]);
    if (columns_.dni == not_there) {
      interval.ghi_w_m2 = read_value("ghi", cells_[columns_.ghi]);
    } else {
      interval.dni_w_m2 = read_value("dni", cells_[columns_.dni]);
    }
    if (columns_.dhi != not_there) interval.dhi_w_m2 = read_value("dhi", cells_[columns_.dhi]);
    if (!intervals_.empty() && seconds_between(intervals_.back().start, interval.start) <= 0.0) {
      refuse_line(file_, line_, fmt::format("time {}", in_quotes(cells_[columns_.time])),
                  fmt::format("it is not later than that of line {}", intervals_.back().line), "sort the rows by time");
    }
    intervals_.push_back(interval);
  }

  double read_value(std::string_view column, std::string_view cell) const {
    const std::optional<double> value = parse_number(cell, separator_);
    if (!value) {
      refuse_line(file_, line_, fmt::format("{} {}", column, in_quotes(cell)),
                  "must be a number; missing values are not interpolated", "fill it in, or remove the row to leave a gap");
    }
    if (*value < 0.0 || *value > most_broadband_w_m2) {
      refuse_line(file_, line_, fmt::format("{} = {}", column, *value),
                  fmt::format("must lie in 0..{} W m-2", most_broadband_w_m2),
                  *value > 0.0            ? "give the mean over the interval in W m-2"
                  : *value > missing_w_m2 ? "set the night offset of the pyranometer to 0"
                                          : "if it marks a missing value, remove the row to leave a gap");
    }
    return *value;
  }

  // Returns the offset of a time whose end is `text`.
  int offset_of(std::string_view text, const std::string& shown) const {
    if (text.empty() && offset_minutes_) return *offset_minutes_;
    if (text.empty()) {
      refuse_line(file_, line_, shown, "has no offset from UTC, so the time is ambiguous",
                  fmt::format("{}, or give utc_offset in [weather]", time_cure));
    }
    if (offset_minutes_) {
      refuse_line(file_, line_, shown, "states its offset from UTC, although one is given for all times", "remove utc_offset");
    }
    const std::optional<int> offset = parse_utc_offset(text);
    if (!offset) refuse_line(file_, line_, shown, "its offset from UTC cannot be read", time_cure);
    return *offset;
  }

  UtcTime read_time(std::string_view cell) {
    const std::string shown = fmt::format("time {}", in_quotes(cell));
    std::string_view rest = cell;
    const auto year = take_digits(rest, 4);
    const auto month = take_part(rest, "-"), day = take_part(rest, "-"), hour = take_part(rest, "Tt "),
               minute = take_part(rest, ":");
    const auto second = take_seconds(rest);
    if (!year || !month || !day || !hour || !minute || !second)
      refuse_line(file_, line_, shown, "is not an ISO 8601 date and time", time_cure);
    rest = trimmed(rest);
    const int offset = offset_of(rest, shown);
    const std::chrono::year_month_day date{std::chrono::year(*year), std::chrono::month(static_cast<unsigned>(*month)),
                                           std::chrono::day(static_cast<unsigned>(*day))};
    if (!date.ok() || *hour > 23 || *minute > 59 || *second >= 60.0)
      refuse_line(file_, line_, shown, "there is no such date or time", "correct it");
    // Excludes the first and last year for which the sun's position is known, so that the offset cannot lead out of them.
    if (*year <= first_year || *year >= last_year) {
      refuse_line(file_, line_, shown, fmt::format("its year must lie between {} and {}", first_year, last_year),
                  "correct the year");
    }
    if (intervals_.empty()) zone_minutes_ = offset;
    return plus_seconds({*year, *month, *day, *hour, *minute, *second}, -60.0 * offset);
  }

  // Lets each interval last until the next one starts, but no longer than the most common step.
  void set_lengths() {
    std::map<long long, std::size_t> counts;  // by step in milliseconds
    for (std::size_t i = 0; i + 1 < intervals_.size(); ++i) {
      intervals_[i].length_s = seconds_between(intervals_[i].start, intervals_[i + 1].start);
      ++counts[std::llround(1000.0 * intervals_[i].length_s)];
    }
    // Goes from the longest step down, so that the longer of two equally common steps wins.
    const auto common =
        std::max_element(counts.rbegin(), counts.rend(), [](const auto& a, const auto& b) { return a.second < b.second; });
    const double longest_s = 0.001 * static_cast<double>(common->first);
    for (WeatherInterval& interval : intervals_) interval.length_s = std::min(interval.length_s, longest_s);
    intervals_.back().length_s = intervals_[intervals_.size() - 2].length_s;
  }

  const std::filesystem::path& file_;
  std::string_view bytes_;
  std::optional<int> offset_minutes_;  // of all times, if they state none
  char separator_ = ',';
  Columns columns_;
  std::vector<std::string_view> cells_;
  std::size_t line_ = 0;
  std::vector<WeatherInterval> intervals_;
  int zone_minutes_ = 0;  // of the first row
};

}  // namespace

WeatherFile read_station(const std::filesystem::path& file, std::string_view bytes, std::optional<int> offset_minutes) {
  return StationReader(file, bytes, offset_minutes).read();
}

std::optional<int> parse_utc_offset(std::string_view text) {
  if (text == "Z" || text == "z") return 0;
  const bool west = text.starts_with('-');
  if (!take(text, "+-")) return std::nullopt;
  const std::optional<int> hours = take_digits(text, 2);
  int minutes = 0;
  if (hours && !text.empty()) {
    static_cast<void>(take(text, ":"));
    const std::optional<int> given = take_digits(text, 2);
    if (!given) return std::nullopt;
    minutes = *given;
  }
  if (!hours || *hours > 23 || minutes > 59 || !text.empty()) return std::nullopt;
  return (west ? -1 : 1) * (60 * *hours + minutes);
}

}  // namespace sunfleck
