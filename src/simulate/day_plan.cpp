#include "simulate/day_plan.h"

#include "base/error.h"
#include "base/file.h"
#include "physics/light/sun_events.h"
#include "physics/light/years.h"
#include "physics/transport/solve/darkness.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <optional>
#include <string_view>

namespace sunfleck {
namespace {

using std::chrono::sys_days;
using std::chrono::year_month_day;

constexpr int minutes_per_hour = 60;
constexpr int minutes_per_day = 1440;
constexpr double seconds_per_minute = 60.0;

// Returns the number made of exactly this many digits; -1 for any other text.
int number_of(std::string_view text, std::size_t digits) {
  int number = 0;
  const bool good = text.size() == digits && std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
  if (!good) return -1;
  std::from_chars(text.data(), text.data() + text.size(), number);
  return number;
}

// Reads a time; 24:00 is the end of the day.
int read_clock(const char* option, const std::string& text) {
  const std::string_view view = text;
  const std::size_t colon = std::min(view.find(':'), view.size());
  const int hour = colon > 0 && colon <= 2 ? number_of(view.substr(0, colon), colon) : -1;
  const int minute = number_of(view.substr(std::min(colon + 1, view.size())), 2);
  const int minutes = hour * minutes_per_hour + minute;
  if (hour < 0 || minute < 0 || minute >= minutes_per_hour || minutes > minutes_per_day) {
    throw_input(fmt::format("{} {}", option, printable(text)), "must be a time HH:MM in 00:00..24:00",
                "give 06:30, for example");
  }
  return minutes;
}

sys_days read_date(const char* option, const std::string& text) {
  const std::string_view view = text;
  const bool dashes = view.size() == 10 && view[4] == '-' && view[7] == '-';
  const int year = dashes ? number_of(view.substr(0, 4), 4) : -1;
  const int month = dashes ? number_of(view.substr(5, 2), 2) : -1;
  const int day = dashes ? number_of(view.substr(8, 2), 2) : -1;
  const std::string place = fmt::format("{} {}", option, printable(text));
  if (year < 0 || month < 0 || day < 0) throw_input(place, "must be a date YYYY-MM-DD", "give 2002-08-08, for example");
  const year_month_day date = std::chrono::year(year) / month / day;
  if (!date.ok()) throw_input(place, "there is no such date", "check the month and the day");
  if (year < first_year || year > last_year) {
    throw_input(place, fmt::format("must lie in the years {} to {}", first_year, last_year), "give a date in this range");
  }
  return sys_days(date);
}

LocalDate local_date(sys_days date, int offset_minutes) {
  const year_month_day day(date);
  return {static_cast<int>(day.year()), static_cast<int>(static_cast<unsigned>(day.month())),
          static_cast<int>(static_cast<unsigned>(day.day())), offset_minutes};
}

// Returns the time this many minutes of the local clock after midnight of the date.
UtcTime utc_at(const LocalDate& date, double minutes) {
  return plus_seconds({date.year, date.month, date.day}, (minutes - date.offset_minutes) * seconds_per_minute);
}

std::vector<sys_days> dates_of(const DayRequest& request, const SunMoment& moment) {
  const UtcTime local = plus_seconds(moment.time, moment.offset_minutes * seconds_per_minute);
  sys_days first(std::chrono::year(local.year) / local.month / local.day);
  if (!request.date.empty()) first = read_date("--date", request.date);
  const sys_days last = request.to_date.empty() ? first : read_date("--to-date", request.to_date);
  if (last < first) {
    throw_input(fmt::format("--to-date {}", request.to_date), "it lies before the first date", "give the later date");
  }
  std::vector<sys_days> dates;
  // More dates than steps are rejected later.
  for (sys_days date = first; date <= last && dates.size() <= most_day_steps; date += std::chrono::days(1)) {
    dates.push_back(date);
  }
  return dates;
}

// Local hours of a date, minutes since midnight.
struct Hours {
  int from_min = 0, to_min = 0;

  [[nodiscard]] std::size_t steps(int step_min) const {
    return static_cast<std::size_t>(std::max(0, to_min - from_min + step_min - 1) / step_min);
  }
};

// Returns the span from the first sunrise to the last sunset of the dates. Where the clock is far from local time, one of them
// lies beyond midnight.
Hours daylight(const std::vector<sys_days>& dates, const SunMoment& moment) {
  Hours light{minutes_per_day, 0};
  for (const sys_days day : dates) {
    const LocalDate date = local_date(day, moment.offset_minutes);
    const SunEvents events = sun_events(date, moment.place);
    if (!events.sunrise && !events.sunset && sun_position(events.transit, moment.place).elevation_rad < 0.0) continue;
    const auto minute_of = [&](const std::optional<UtcTime>& time, double otherwise) {
      return time ? seconds_between(utc_at(date, 0.0), *time) / seconds_per_minute : otherwise;
    };
    light.from_min = std::min(light.from_min, static_cast<int>(std::floor(minute_of(events.sunrise, 0.0))));
    light.to_min = std::max(light.to_min, static_cast<int>(std::ceil(minute_of(events.sunset, minutes_per_day))));
  }
  return light;
}

// Returns the requested hours; where they are not given, those of daylight, rounded outwards to whole steps. Returns nothing if
// the sun does not rise then.
std::optional<Hours> hours_of(const DayRequest& request, const std::vector<sys_days>& dates, const SunMoment& moment) {
  Hours hours;
  if (request.from.empty() || request.to.empty()) {
    const Hours light = daylight(dates, moment);
    if (light.from_min >= light.to_min) return std::nullopt;
    const int step = request.step_min;
    const bool past_midnight = light.from_min < 0 || light.to_min > minutes_per_day;
    hours.from_min = past_midnight ? 0 : light.from_min / step * step;
    hours.to_min = past_midnight ? minutes_per_day : std::min(minutes_per_day, (light.to_min + step - 1) / step * step);
  }
  if (!request.from.empty()) hours.from_min = read_clock("--from", request.from);
  if (!request.to.empty()) hours.to_min = read_clock("--to", request.to);
  return hours;
}

void refuse_too_many(const DayRequest& request, std::size_t steps_a_date, std::size_t dates) {
  if (steps_a_date * dates <= most_day_steps) return;
  throw_input(
      fmt::format("--step {}", request.step_min),
      fmt::format("more than {} steps on {} dates", most_day_steps, dates > most_day_steps ? "these" : fmt::to_string(dates)),
      "give longer steps or fewer dates");
}

// Returns the hours of all dates. Finding the sunrises of centuries takes minutes, so that some of many dates tell first whether
// there are too many: their hours lie within those of all.
Hours checked_hours(const DayRequest& request, const std::vector<sys_days>& dates, const SunMoment& moment) {
  constexpr std::size_t some = 64;
  if (dates.size() > some) {
    std::vector<sys_days> spread;
    for (std::size_t i = 0; i < dates.size(); i += dates.size() / some + 1) spread.push_back(dates[i]);
    const Hours least = hours_of(request, spread, moment).value_or(Hours{});
    refuse_too_many(request, std::max<std::size_t>(1, least.steps(request.step_min)), dates.size());
  }
  const std::optional<Hours> hours = hours_of(request, dates, moment);
  if (!hours) throw_input("--from", "the sun does not rise on these dates", "give --from and --to");
  if (hours->to_min <= hours->from_min && request.to.empty()) {
    throw_input(fmt::format("--from {}", clock_text(hours->from_min)),
                fmt::format("the steps of these dates end at {}, after sunset", clock_text(hours->to_min)), "give --to, too");
  }
  if (hours->to_min <= hours->from_min && request.from.empty()) {
    throw_input(fmt::format("--to {}", clock_text(hours->to_min)),
                fmt::format("the steps of these dates begin at {}, before sunrise", clock_text(hours->from_min)),
                "give --from, too");
  }
  if (hours->to_min <= hours->from_min) {
    throw_input(fmt::format("--to {}", clock_text(hours->to_min)),
                fmt::format("it is not after {}", clock_text(hours->from_min)), "give the earlier time as --from");
  }
  refuse_too_many(request, hours->steps(request.step_min), dates.size());
  return *hours;
}

void add_steps(DayPlan& plan, const LocalDate& date, int step_min, const Place& place, bool lamps) {
  for (int begin = plan.from_min; begin < plan.to_min; begin += step_min) {
    const int end = std::min(begin + step_min, plan.to_min);
    DayStep step;
    step.start = utc_at(date, begin);
    step.middle = utc_at(date, 0.5 * (begin + end));
    step.length_s = (end - begin) * seconds_per_minute;
    step.date = plan.course.dates.size();
    step.sun = sun_position(step.middle, place);
    step.lamps = lamps;
    plan.course.steps.push_back(step);
  }
  plan.course.dates.push_back(fmt::format("{:04}-{:02}-{:02}", date.year, date.month, date.day));
}

// Sets the light of all steps. Throws the first error of the weather, with how many steps have one.
void add_lights(DayPlan& plan, const Scene& scene) {
  std::optional<std::string> first_error;
  std::size_t errors = 0, last = 0;
  for (std::size_t k = 0; k < plan.course.steps.size(); ++k) {
    const DayStep& step = plan.course.steps[k];
    try {
      plan.lights.push_back(step.unlit()   ? MomentLight{}
                            : step.night() ? light_at_night(scene, step.middle)
                                           : light_of_step(scene, step.middle, step.length_s));
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::input) throw;
      if (!first_error) first_error = error.what();
      ++errors;
      last = k;
    }
  }
  if (!first_error) return;
  if (errors > 1) {
    *first_error += fmt::format("; it is the first of {} such steps, the last begins at {}", errors,
                                local_time_text(plan.course.steps[last].start, plan.course.offset_minutes));
  }
  throw Error(ErrorKind::input, *first_error);
}

// Returns the measured global irradiance of a step; 0 in a gap.
double measured_w_m2(const Weather& weather, const DayStep& step) {
  try {
    return weather_of_step(weather, step.middle, step.length_s, step.sun).global_w_m2(step.sun);
  } catch (const Error&) {  // only steps with sun need weather
    return 0.0;
  }
}

}  // namespace

std::string clock_text(int minutes) {
  return fmt::format("{:02}:{:02}", minutes / minutes_per_hour, minutes % minutes_per_hour);
}

DayPlan plan_day(const DayRequest& request, const Scene& scene) {
  check_day(scene);
  DayPlan plan;
  plan.course.offset_minutes = scene.moment->offset_minutes;
  const std::vector<sys_days> dates = dates_of(request, *scene.moment);
  const Hours hours = checked_hours(request, dates, *scene.moment);
  plan.from_min = hours.from_min;
  plan.to_min = hours.to_min;
  const bool lamps = has_lamps(scene.model);
  for (const sys_days date : dates) {
    add_steps(plan, local_date(date, plan.course.offset_minutes), request.step_min, scene.moment->place, lamps);
  }
  add_lights(plan, scene);
  return plan;
}

std::vector<std::string> plan_warnings(const DayPlan& plan, const Scene& scene) {
  constexpr double worth_a_warning = 0.005;
  const std::optional<Weather>& weather = scene.light.weather;
  if (!weather || weather->source != Weather::Source::intervals) return {};
  double used = 0.0, left_out = 0.0;  // J m-2
  for (const DayStep& step : plan.course.steps) {
    (step.night() ? left_out : used) += step.length_s * measured_w_m2(*weather, step);
  }
  if (!(left_out > worth_a_warning * (used + left_out))) return {};
  return {fmt::format(
      "{}: {:.3g} % of its light falls in steps at whose middle the sun is below the horizon, and is left out; shorter "
      "steps lose less",
      weather->name, 100.0 * left_out / (used + left_out))};
}

}  // namespace sunfleck
