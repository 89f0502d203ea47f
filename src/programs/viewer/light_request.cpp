#include "programs/viewer/light_request.h"

#include "base/digest.h"
#include "base/error.h"
#include "base/units.h"
#include "files/scene/moment_light.h"
#include "physics/light/sun_events.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace sunfleck {
namespace {

SunRequest sun_request(const Scene& scene) {
  SunRequest request;
  if (scene.model.sun) {
    request.shines = true;
    request.elevation_deg = in_degrees(scene.model.sun->elevation_rad);
    request.azimuth_deg = in_degrees(scene.model.sun->azimuth_rad);
  }
  if (!scene.moment) return request;
  const SunMoment& moment = *scene.moment;
  const UtcTime local = plus_seconds(moment.time, 60.0 * moment.offset_minutes);
  request.by_clock = true;
  request.year = local.year;
  request.month = local.month;
  request.day = local.day;
  request.hour = local.hour + local.minute / 60.0 + local.second / 3600.0;
  request.offset_minutes = moment.offset_minutes;
  request.latitude_deg = moment.place.latitude_rad / degree;
  request.longitude_deg = moment.place.longitude_rad / degree;
  request.altitude_m = moment.place.altitude_m;
  return request;
}

SurfaceRequest surface_request(const SurfaceOptics& optics) {
  SurfaceRequest request;
  for (const FaceOptics& face : optics.upper) request.upper.push_back({face.reflectance, face.transmittance});
  for (const FaceOptics& face : optics.lower) request.lower.push_back({face.reflectance, face.transmittance});
  return request;
}

SunPosition position_of(const SunRequest& sun) {
  // A scene file cannot hold 360 degrees.
  if (!sun.by_clock) return {sun.elevation_deg * degree, std::fmod(sun.azimuth_deg, 360.0) * degree};
  return sun_position(time_of(sun), {sun.latitude_deg * degree, sun.longitude_deg * degree, sun.altitude_m});
}

std::optional<SkyModel> sky_of(const SkyRequest& request, const Scene& scene) {
  SkyModel sky;
  switch (request.kind) {
    case SkyRequestKind::none:
      return std::nullopt;
    case SkyRequestKind::uniform:
      sky.kind = SkyKind::uniform;
      break;
    case SkyRequestKind::overcast:
      sky.kind = SkyKind::overcast;
      break;
    case SkyRequestKind::clear:
    case SkyRequestKind::general:
      sky.kind = SkyKind::general;
      sky.cie_type = request.kind == SkyRequestKind::clear ? cie_clear_type : request.cie_type;
      break;
    case SkyRequestKind::all_weather:
      sky.kind = SkyKind::all_weather;
      sky.dni_w_m2 = request.dni_w_m2;
      sky.dhi_w_m2 = request.dhi_w_m2;
      break;
    case SkyRequestKind::of_scene:
      return scene.model.sky;
  }
  return sky;
}

// Resets the fields that the other choices make irrelevant, so that only relevant differences remain.
SunRequest in_use(SunRequest sun) {
  if (sun.by_clock) {
    sun.elevation_deg = sun.azimuth_deg = 0.0;
    return sun;
  }
  SunRequest angles;
  angles.shines = sun.shines;
  angles.elevation_deg = sun.elevation_deg;
  angles.azimuth_deg = sun.azimuth_deg;
  return angles;
}

SkyRequest in_use(const SkyRequest& sky) {
  SkyRequest request{sky.kind};
  if (sky.kind == SkyRequestKind::general) request.cie_type = sky.cie_type;
  if (sky.kind == SkyRequestKind::all_weather) request = sky;
  return request;
}

// Divides the irradiance of bands without diffuse light between sun and sky.
std::optional<double> assume_diffuse_light(const LightRequest& request, std::vector<Waveband>& bands) {
  const auto is_diffuse = [](const Waveband& band) { return band.diffuse_w_m2 > 0.0; };
  if (std::any_of(bands.begin(), bands.end(), is_diffuse)) return std::nullopt;
  const double share = assumed_diffuse_share(request);
  for (Waveband& band : bands) {
    band.diffuse_w_m2 = share * band.direct_w_m2;
    band.direct_w_m2 -= band.diffuse_w_m2;
  }
  return share;
}

// Keeps the scene's own moment exactly, so that an untouched window shows what `run` computes. A sun that does not shine still
// determines the time.
std::optional<double> grant_light(const LightRequest& request, const Scene& scene, RadiationModel& model) {
  std::optional<double> assumed;
  const LightRequest own = request_of(scene);
  model.sun = scene.model.sun;
  model.bands = scene.model.bands;
  model.sky = scene.model.sky;
  if (!same_sun(request.sun, own.sun)) {
    std::optional<UtcTime> time;
    if (scene.moment) time = scene.moment->time;
    if (request.sun.by_clock) time = time_of(request.sun);
    const SunPosition sun = position_of(request.sun);
    MomentLight light = light_under(scene, sun, time);
    model.bands = std::move(light.bands);
    model.sky = std::move(light.sky);
    model.sun = request.sun.shines ? std::optional(sun) : std::nullopt;
  }
  if (!same_sky(request.sky, own.sky)) {
    model.sky = sky_of(request.sky, scene);
    if (model.sky && !request.own_irradiance) assumed = assume_diffuse_light(request, model.bands);
  }
  if (request.own_irradiance) {
    for (std::size_t b = 0; b < model.bands.size(); ++b) {
      const BandRequest& band = request.bands[b];
      model.bands[b].direct_w_m2 = band.total_w_m2 * (1.0 - band.diffuse_share);
      model.bands[b].diffuse_w_m2 = band.total_w_m2 * band.diffuse_share;
    }
  }
  const bool sun_up = model.sun && model.sun->elevation_rad > 0.0;
  for (Waveband& band : model.bands) {
    if (!sun_up) band.direct_w_m2 = 0.0;
    if (!model.sky) band.diffuse_w_m2 = 0.0;
  }
  if (model.sky && model.sky->follows_sun() && !model.sun) {
    throw_input("sky", "it follows the sun, but the scene has no sun",
                "switch the sun on, or choose a uniform or overcast sky");
  }
  return assumed;
}

void grant_optics(const LightRequest& request, const Scene& scene, RadiationModel& model) {
  for (std::size_t i = 0; i < model.optics.size(); ++i) {
    SurfaceOptics& optics = model.optics[i];
    optics = scene.model.optics[i];
    for (std::size_t b = 0; b < optics.upper.size(); ++b) {
      optics.upper[b] = {request.optics[i].upper[b].reflectance, request.optics[i].upper[b].transmittance};
      optics.lower[b] = {request.optics[i].lower[b].reflectance, request.optics[i].lower[b].transmittance};
    }
  }
  if (model.soil) model.soil->reflectance = request.soil_reflectance;
}

}  // namespace

BandRequest band_request(const Waveband& band) {
  const double total = band.direct_w_m2 + band.diffuse_w_m2;
  return {total, total > 0.0 ? band.diffuse_w_m2 / total : 0.0};
}

LightRequest request_of(const Scene& scene) {
  LightRequest request;
  request.sun = sun_request(scene);
  request.sky.kind = scene.model.sky ? SkyRequestKind::of_scene : SkyRequestKind::none;
  for (const Waveband& band : scene.model.bands) request.bands.push_back(band_request(band));
  for (const SurfaceOptics& optics : scene.model.optics) request.optics.push_back(surface_request(optics));
  if (scene.model.soil) request.soil_reflectance = scene.model.soil->reflectance;
  return request;
}

bool same_sun(const SunRequest& one, const SunRequest& other) {
  return in_use(one) == in_use(other);
}

bool same_sky(const SkyRequest& one, const SkyRequest& other) {
  return in_use(one) == in_use(other);
}

std::string first_difference(const LightRequest& one, const LightRequest& other) {
  if (!same_sun(one.sun, other.sun)) return "sun";
  if (!same_sky(one.sky, other.sky)) return "sky";
  if (one.own_irradiance != other.own_irradiance || (one.own_irradiance && one.bands != other.bands)) return "irradiance";
  if (one.optics != other.optics || one.soil_reflectance != other.soil_reflectance) return "optics";
  return "";
}

std::string digest_of(const LightRequest& request) {
  Digest digest;
  const auto add = [&](double number) { digest.add(fmt::format("{} ", number)); };
  const SunRequest sun = in_use(request.sun);
  for (const double number :
       {static_cast<double>(sun.shines), static_cast<double>(sun.by_clock), static_cast<double>(sun.year),
        static_cast<double>(sun.month), static_cast<double>(sun.day), sun.hour, static_cast<double>(sun.offset_minutes),
        sun.latitude_deg, sun.longitude_deg, sun.altitude_m, sun.elevation_deg, sun.azimuth_deg}) {
    add(number);
  }
  const SkyRequest sky = in_use(request.sky);
  for (const double number : {static_cast<double>(sky.kind), static_cast<double>(sky.cie_type), sky.dni_w_m2, sky.dhi_w_m2})
    add(number);
  for (const BandRequest& band : request.own_irradiance ? request.bands : std::vector<BandRequest>()) {
    add(band.total_w_m2);
    add(band.diffuse_share);
  }
  for (const SurfaceRequest& surface : request.optics) {
    for (const auto* faces : {&surface.upper, &surface.lower}) {
      for (const FaceRequest& face : *faces) {
        add(face.reflectance);
        add(face.transmittance);
      }
    }
  }
  for (const double reflectance : request.soil_reflectance) add(reflectance);
  return digest.text();
}

UtcTime time_of(const SunRequest& sun) {
  return plus_seconds({sun.year, sun.month, sun.day, 0, 0, 0.0}, std::round(3600.0 * sun.hour) - 60.0 * sun.offset_minutes);
}

double next_played_hour(const SunRequest& sun, double step_min) {
  const Place where{sun.latitude_deg * degree, sun.longitude_deg * degree, sun.altitude_m};
  SunRequest midnight = sun;
  midnight.hour = 0.0;
  const UtcTime begin = time_of(midnight);
  const SunEvents events = sun_events({sun.year, sun.month, sun.day, sun.offset_minutes}, where);
  const auto hour_of = [&](const std::optional<UtcTime>& time, double otherwise) {
    return time ? std::clamp(seconds_between(begin, *time) / 3600.0, 0.0, 24.0) : otherwise;
  };
  const double first_h = hour_of(events.sunrise, 0.0);
  const double last_h = hour_of(events.sunset, 24.0);
  const double step_h = step_min / 60.0;
  const double next_h = sun.hour + step_h;
  return next_h < first_h || next_h > last_h ? std::min(last_h, first_h + step_h) : next_h;
}

std::vector<LightRequest> moments_after(LightRequest moment, double step_min, std::size_t count) {
  std::vector<LightRequest> moments;
  try {
    while (moment.sun.by_clock && moments.size() < count) {
      moment.sun.hour = next_played_hour(moment.sun, step_min);
      moments.push_back(moment);
    }
  } catch (const Error&) {  // there is no such date
  }
  return moments;
}

double assumed_diffuse_share(const LightRequest& request) {
  constexpr double of_clear_day = 0.2;
  const bool alone = !request.sun.shines || request.sky.kind == SkyRequestKind::overcast;
  return alone ? 1.0 : of_clear_day;
}

bool has_fixed_beam(const Scene& scene) {
  return std::any_of(scene.light.bands.begin(), scene.light.bands.end(),
                     [](const BandLight& band) { return !band.share && band.direct_w_m2 > 0.0; });
}

std::optional<double> grant(const LightRequest& request, const Scene& scene, RadiationModel& model) {
  const std::optional<SunPosition> sun = model.sun;
  const std::optional<SkyModel> sky = model.sky;
  const std::vector<Waveband> bands = model.bands;
  std::optional<double> assumed;
  try {
    assumed = grant_light(request, scene, model);
  } catch (...) {
    model.sun = sun;
    model.sky = sky;
    model.bands = bands;
    throw;
  }
  grant_optics(request, scene, model);
  return assumed;
}

}  // namespace sunfleck
