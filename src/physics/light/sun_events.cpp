#include "physics/light/sun_events.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>

#include "base/error.h"

namespace sunfleck {
namespace {

constexpr double half_day_s = 43200.0;

// Searches in seconds after `origin` rather than in calendar times, so that it is plain arithmetic.
struct Search {
  UtcTime origin;
  Place place;

  [[nodiscard]] double height(double seconds) const {
    return sun_position(plus_seconds(origin, seconds), place).elevation_rad - rise_set_elevation_rad;
  }

  // Finds a transit. The hour angle makes one turn a day to within half a minute, so each step gains more than three
  // digits.
  [[nodiscard]] double transit(double guess_s) const {
    for (int step = 0; step < 4; ++step)
      guess_s -= sun_hour_angle_rad(plus_seconds(origin, guess_s), place) / std::numbers::pi * half_day_s;
    return guess_s;
  }

  // Finds where the height changes sign between a low and a high position, if it does. The result is accurate to 2^-24 of half
  // a day, which is 3 ms.
  [[nodiscard]] std::optional<UtcTime> crossing(double low_s, double high_s) const {
    if (height(low_s) >= 0.0 || height(high_s) < 0.0) return {};
    for (int step = 0; step < 24; ++step) {
      const double middle_s = 0.5 * (low_s + high_s);
      (height(middle_s) < 0.0 ? low_s : high_s) = middle_s;
    }
    return time_at(high_s);
  }

  [[nodiscard]] UtcTime time_at(double seconds) const { return plus_seconds(origin, std::round(10.0 * seconds) / 10.0); }
};

}  // namespace

SunEvents sun_events(const LocalDate& date, const Place& place) {
  if (std::abs(date.offset_minutes) >= 24 * 60)
    throw_input(fmt::format("offset of {} minutes from UTC", date.offset_minutes), "must be less than a day",
                "give the minutes by which local time is ahead of UTC");
  const UtcTime noon{date.year, date.month, date.day, 12, 0, 0.0};
  const Search search{plus_seconds(noon, -60.0 * date.offset_minutes), place};
  const double transit_s = search.transit(0.0);
  SunEvents events;
  events.transit = search.time_at(transit_s);
  events.sunrise = search.crossing(transit_s - half_day_s, transit_s);
  events.sunset = search.crossing(transit_s + half_day_s, transit_s);
  return events;
}

}  // namespace sunfleck
