#include "programs/validate/sun_cases.h"

#include "base/units.h"
#include "physics/light/sun.h"
#include "physics/light/sun_events.h"
#include "physics/light/weather.h"
#include "programs/validate/known/case_scenes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

namespace sunfleck {
namespace {

Place place_deg(double latitude, double longitude, double altitude_m = 0.0) {
  return {latitude * degree, longitude * degree, altitude_m};
}

double great_circle_deg(const SunPosition& sun, double elevation_deg, double azimuth_deg) {
  const glm::dvec3 a = direction_to_sun(sun);
  const glm::dvec3 b = direction_to_sun(sun_at(elevation_deg, azimuth_deg));
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) / degree;
}

constexpr double spa_deg = 0.0003;  // accuracy stated for the algorithm
constexpr double three_digits_deg = 0.001;

struct EventsOfDay {
  const char* name;
  LocalDate date;
  Place place;
  double rise_s, transit_s, set_s;  // local time of that day; below 0: not listed by the calculator for this date
};

double clock_s(int hour, int minute, int second) {
  return hour * 3600.0 + minute * 60.0 + second;
}

}  // namespace

void sun_position_cases(CaseBench& bench) {
  const Place golden = place_deg(39.742476, -105.1786, 1830.14);
  const auto angles = [&](const char* name, const SunPosition& sun, double elevation_deg, double azimuth_deg) {
    bench.equal(fmt::format("{}, elevation in degrees", name), sun.elevation_rad / degree, elevation_deg, spa_deg);
    bench.equal(fmt::format("{}, azimuth in degrees", name), sun.azimuth_rad / degree, azimuth_deg, spa_deg);
  };
  angles("NREL's example, Golden 2003-10-17", sun_position({2003, 10, 17, 19, 30, 30.0}, golden, 67.0), 39.872046, 194.340241);
  angles("Golden a day later", sun_position({2003, 10, 18, 19, 30, 30.0}, golden, 67.0), 39.505196, 194.311132);
  const Place beijing = place_deg(40.02, 116.28);
  const auto distance = [&](const char* name, const UtcTime& time, const Place& place, double elevation_deg,
                            double azimuth_deg) {
    bench.equal(fmt::format("{}, degrees from NREL's direction", name),
                great_circle_deg(sun_position(time, place), elevation_deg, azimuth_deg), 0.0, 0.0005);
  };
  distance("Beijing 2002-08-08 10:10", {2002, 8, 8, 2, 10, 0.0}, beijing, 53.0176, 120.5690);
  distance("Beijing 2002-08-08 12:20", {2002, 8, 8, 4, 20, 0.0}, beijing, 66.1779, 179.6626);
  distance("Bordeaux 1995-05-15", {1995, 5, 15, 8, 30, 0.0}, place_deg(44.8378, -0.5792), 39.7073, 103.6197);
  distance("Sydney 2021-12-21", {2021, 12, 21, 2, 0, 0.0}, place_deg(-33.8688, 151.2093), 79.4586, 351.3299);
  constexpr std::array<std::array<double, 2>, 14> hours = {{{6.556, 74.229},
                                                            {17.807, 83.436},
                                                            {29.269, 92.968},
                                                            {40.615, 103.834},
                                                            {51.347, 117.757},
                                                            {60.451, 137.891},
                                                            {65.766, 167.896},
                                                            {64.674, 202.607},
                                                            {57.834, 229.326},
                                                            {48.042, 247.036},
                                                            {37.031, 259.725},
                                                            {25.595, 270.019},
                                                            {14.151, 279.348},
                                                            {3.006, 288.599}}};
  double furthest_deg = 0.0;
  for (std::size_t k = 0; k < hours.size(); ++k) {
    const UtcTime time = plus_seconds({2002, 8, 8, 0, 0, 0.0}, (static_cast<double>(k) - 2.0) * 3600.0);
    furthest_deg = std::max(furthest_deg, great_circle_deg(sun_position(time, beijing), hours[k][0], hours[k][1]));
  }
  bench.equal("Beijing 2002-08-08, 6 to 19 o'clock, furthest from NREL's in degrees", furthest_deg, 0.0, three_digits_deg);
}

void sun_event_cases(CaseBench& bench) {
  const Place golden = place_deg(39.742476, -105.1786), south = place_deg(-35.0, 0.0), ohio = place_deg(40.0, -80.0);
  // NREL's calculator lists the events of a UTC date: the sunset it gives for 2 August 2015 is that of the evening before.
  const std::array rows = {
      EventsOfDay{"Golden 2015-01-02", {2015, 1, 2, -420}, golden, clock_s(7, 21, 55), clock_s(12, 4, 45), clock_s(16, 47, 43)},
      EventsOfDay{"Golden 2015-08-01", {2015, 8, 1, -420}, golden, -1.0, -1.0, clock_s(19, 13, 58)},
      EventsOfDay{"Golden 2015-08-02", {2015, 8, 2, -420}, golden, clock_s(5, 0, 27), clock_s(12, 6, 58), -1.0},
      EventsOfDay{"35 S 1996-07-05", {1996, 7, 5, 0}, south, clock_s(7, 8, 15), clock_s(12, 4, 36), clock_s(17, 1, 4)},
      EventsOfDay{"35 S 2004-12-04", {2004, 12, 4, 0}, south, clock_s(4, 38, 57), clock_s(11, 50, 22), clock_s(19, 2, 3)},
      EventsOfDay{"40 N 2000-01-01", {2000, 1, 1, -300}, ohio, clock_s(7, 41, 51), clock_s(12, 23, 23), clock_s(17, 5, 4)}};
  for (const EventsOfDay& row : rows) {
    const SunEvents events = sun_events(row.date, row.place);
    const UtcTime midnight = plus_seconds({row.date.year, row.date.month, row.date.day}, -60.0 * row.date.offset_minutes);
    double furthest_s = 0.0;
    const auto meet = [&](const std::optional<UtcTime>& time, double expected_s) {
      if (expected_s < 0.0) return;
      const double off_s = time ? std::abs(seconds_between(midnight, *time) - expected_s) : 86400.0;
      furthest_s = std::max(furthest_s, off_s);
    };
    meet(events.sunrise, row.rise_s);
    meet(events.transit, row.transit_s);
    meet(events.sunset, row.set_s);
    bench.equal(fmt::format("{}, seconds from NREL's", row.name), furthest_s, 0.0, 5.0);
  }
}

void weather_cases(CaseBench& bench) {
  // Spitters, Toussaint and Goudriaan 1986, hourly relation.
  bench.equal("Spitters, diffuse share of 800 W m-2", spitters_diffuse_share(800.0, beijing_sun(), 220), 0.22454, 2e-5);
  bench.equal("Spitters, diffuse share of 400 W m-2", spitters_diffuse_share(400.0, beijing_sun(), 220), 0.84684, 2e-5);
  // Ineichen and Perez 2002 at sea level, Linke turbidity 3, as implemented in pvlib with 1364 W m-2 outside the atmosphere.
  struct Row {
    double zenith_deg, air_mass, ghi, dni, dhi;
  };
  for (const Row& row :
       {Row{46.0467599, 1.32355476, 704.6968, 888.9015, 87.7360}, Row{10.56413562, 0.93527685, 1044.1231, 953.2493, 107.0311},
        Row{72.41687122, 3.01614096, 251.9943, 655.4493, 53.9901}}) {
    const Broadband sky = ineichen_perez({3.0, 0.0}, row.zenith_deg * degree, row.air_mass, 1364.0);
    const std::string name = fmt::format("Ineichen, zenith angle {:.0f} degrees, ", row.zenith_deg);
    bench.equal(name + "DNI", sky.direct_normal_w_m2, row.dni, 1e-3);
    bench.equal(name + "DHI", sky.diffuse_w_m2, row.dhi, 1e-3);
    bench.equal(name + "GHI", sky.global_w_m2({(90.0 - row.zenith_deg) * degree, 0.0}), row.ghi, 1e-3);
  }
}

}  // namespace sunfleck
