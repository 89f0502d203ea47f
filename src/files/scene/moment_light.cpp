#include "files/scene/moment_light.h"

#include "base/check.h"
#include "base/error.h"
#include "base/file.h"

#include <algorithm>
#include <cmath>

namespace sunfleck {

namespace {

// Moments with less diffuse light get the all-weather sky of this value; such a sky sends no noticeable light.
constexpr double least_dhi_w_m2 = 1e-3;

Waveband lit_band(const Waveband& band, const BandLight& light, const Broadband& broadband,
                  const std::optional<SunPosition>& sun) {
  Waveband lit = band;
  const double sine = sun && sun->elevation_rad > 0.0 ? std::sin(sun->elevation_rad) : 0.0;
  if (light.share) {
    lit.direct_w_m2 = *light.share * broadband.direct_normal_w_m2 * sine;
    lit.diffuse_w_m2 = *light.share * broadband.diffuse_w_m2;
  } else {
    lit.direct_w_m2 = light.direct_normal_w_m2 * sine + (sine > 0.0 ? light.direct_w_m2 : 0.0);
    lit.diffuse_w_m2 = light.diffuse_w_m2;
  }
  return lit;
}

MomentLight light_of_weather(const Scene& scene, const std::optional<SunPosition>& sun, const Broadband& broadband) {
  MomentLight light;
  light.sun = sun.value_or(SunPosition{});
  for (std::size_t b = 0; b < scene.light.bands.size(); ++b) {
    light.bands.push_back(lit_band(scene.model.bands[b], scene.light.bands[b], broadband, sun));
  }
  light.sky = scene.light.sky;
  if (scene.light.sky_from_weather) {
    light.sky->dni_w_m2 = broadband.direct_normal_w_m2;
    light.sky->dhi_w_m2 = std::max(least_dhi_w_m2, broadband.diffuse_w_m2);
  }
  return light;
}

}  // namespace

MomentLight light_under(const Scene& scene, const std::optional<SunPosition>& sun, const std::optional<UtcTime>& time) {
  if (!scene.light.weather) return light_of_weather(scene, sun, {});
  EXPECT(sun.has_value(), ==, true);
  return light_of_weather(scene, sun, weather_at(*scene.light.weather, time, *sun));
}

MomentLight light_of_step(const Scene& scene, const UtcTime& middle, double length_s) {
  EXPECT(scene.moment.has_value(), ==, true);
  const SunPosition sun = sun_position(middle, scene.moment->place);
  const std::optional<Weather>& weather = scene.light.weather;
  return light_of_weather(scene, sun, weather ? weather_of_step(*weather, middle, length_s, sun) : Broadband{});
}

MomentLight light_at_night(const Scene& scene, const UtcTime& time) {
  EXPECT(scene.moment.has_value(), ==, true);
  MomentLight light = light_of_weather(scene, sun_position(time, scene.moment->place), {});
  for (Waveband& band : light.bands) band.direct_w_m2 = band.diffuse_w_m2 = 0.0;
  return light;
}

MomentLight light_of(const Scene& scene) {
  const std::optional<UtcTime> time = scene.moment ? std::optional<UtcTime>(scene.moment->time) : std::nullopt;
  return light_under(scene, scene.model.sun, time);
}

void check_day(const Scene& scene) {
  if (!scene.moment) {
    throw_input(printable(scene.file.string()) + ": sun", "`day` needs a place and a date to move the sun",
                "give time, latitude and longitude in [sun]");
  }
  const SceneLight& light = scene.light;
  for (const BandLight& band : light.bands) {
    if (band.direct_w_m2 > 0.0) {
      throw_input(band.direct_place, "a fixed irradiance on level ground does not change over a day",
                  "give direct_normal instead, or [weather]");
    }
  }
  const bool moves = std::any_of(light.bands.begin(), light.bands.end(),
                                 [](const BandLight& band) { return band.share || band.direct_normal_w_m2 > 0.0; });
  if (!moves) {
    throw_input(printable(scene.file.string()) + ": band", "no band has light that changes over a day",
                "add [weather], or direct_normal to a [[band]]");
  }
  if (light.weather && light.weather->source == Weather::Source::moment && !light.weather->moment.has_parts()) {
    throw_input(light.weather_place, "the global irradiance of one moment does not change over a day",
                "give a file, dni and dhi, or clear_sky = \"ineichen\"");
  }
}

}  // namespace sunfleck
