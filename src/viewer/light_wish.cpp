#include "viewer/light_wish.h"

#include "base/error.h"
#include "base/units.h"
#include "io/digest.h"
#include "io/moment_light.h"

#include <fmt/format.h>

#include <utility>

namespace sunfleck {
namespace {

constexpr int clear_type = 12;

SunWish sun_wish(const Scene& scene) {
  SunWish wish;
  if (scene.model.sun) {
    wish.shines = true;
    wish.elevation_deg = scene.model.sun->elevation_rad / degree;
    wish.azimuth_deg = scene.model.sun->azimuth_rad / degree;
  }
  if (!scene.moment) return wish;
  const SunMoment& moment = *scene.moment;
  const UtcTime local = plus_seconds(moment.time, 60.0 * moment.offset_minutes);
  wish.by_clock = true;
  wish.year = local.year;
  wish.month = local.month;
  wish.day = local.day;
  wish.hour = local.hour + local.minute / 60.0 + local.second / 3600.0;
  wish.offset_minutes = moment.offset_minutes;
  wish.latitude_deg = moment.place.latitude_rad / degree;
  wish.longitude_deg = moment.place.longitude_rad / degree;
  wish.altitude_m = moment.place.altitude_m;
  return wish;
}

SurfaceWish surface_wish(const SurfaceOptics& optics) {
  SurfaceWish wish;
  for (const FaceOptics& face : optics.upper) wish.upper.push_back({face.reflectance, face.transmittance});
  for (const FaceOptics& face : optics.lower) wish.lower.push_back({face.reflectance, face.transmittance});
  return wish;
}

SunPosition position_of(const SunWish& sun) {
  if (!sun.by_clock) return {sun.elevation_deg * degree, sun.azimuth_deg * degree};
  return sun_position(time_of(sun), {sun.latitude_deg * degree, sun.longitude_deg * degree, sun.altitude_m});
}

std::optional<SkyModel> sky_of(const SkyWish& wish, const Scene& scene) {
  SkyModel sky;
  switch (wish.kind) {
    case SkyWishKind::none:
      return std::nullopt;
    case SkyWishKind::uniform:
      sky.kind = SkyKind::uniform;
      break;
    case SkyWishKind::overcast:
      sky.kind = SkyKind::overcast;
      break;
    case SkyWishKind::clear:
    case SkyWishKind::general:
      sky.kind = SkyKind::general;
      sky.cie_type = wish.kind == SkyWishKind::clear ? clear_type : wish.cie_type;
      break;
    case SkyWishKind::all_weather:
      sky.kind = SkyKind::all_weather;
      sky.dni_w_m2 = wish.dni_w_m2;
      sky.dhi_w_m2 = wish.dhi_w_m2;
      break;
    case SkyWishKind::of_scene:
      return scene.model.sky;
  }
  return sky;
}

// Resets the fields that the other choices make irrelevant, so that only relevant differences remain.
SunWish in_use(SunWish sun) {
  if (sun.by_clock) {
    sun.elevation_deg = sun.azimuth_deg = 0.0;
    return sun;
  }
  SunWish angles;
  angles.shines = sun.shines;
  angles.elevation_deg = sun.elevation_deg;
  angles.azimuth_deg = sun.azimuth_deg;
  return angles;
}

SkyWish in_use(const SkyWish& sky) {
  SkyWish wish{sky.kind};
  if (sky.kind == SkyWishKind::general) wish.cie_type = sky.cie_type;
  if (sky.kind == SkyWishKind::all_weather) wish = sky;
  return wish;
}

// Keeps the scene's own moment exactly, so that an untouched window shows what `run` computes. A sun that does not shine still
// determines the time.
void grant_light(const LightWish& wish, const Scene& scene, RadiationModel& model) {
  const LightWish own = wish_of(scene);
  model.sun = scene.model.sun;
  model.bands = scene.model.bands;
  model.sky = scene.model.sky;
  if (in_use(wish.sun) != in_use(own.sun)) {
    std::optional<UtcTime> time;
    if (scene.moment) time = scene.moment->time;
    if (wish.sun.by_clock) time = time_of(wish.sun);
    const SunPosition sun = position_of(wish.sun);
    MomentLight light = light_under(scene, sun, time);
    model.bands = std::move(light.bands);
    model.sky = std::move(light.sky);
    model.sun = wish.sun.shines ? std::optional(sun) : std::nullopt;
  }
  if (in_use(wish.sky) != in_use(own.sky)) model.sky = sky_of(wish.sky, scene);
  if (wish.own_irradiance) {
    for (std::size_t b = 0; b < model.bands.size(); ++b) {
      const BandWish& band = wish.bands[b];
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
}

void grant_optics(const LightWish& wish, const Scene& scene, RadiationModel& model) {
  for (std::size_t i = 0; i < model.optics.size(); ++i) {
    SurfaceOptics& optics = model.optics[i];
    optics = scene.model.optics[i];
    for (std::size_t b = 0; b < optics.upper.size(); ++b) {
      optics.upper[b] = {wish.optics[i].upper[b].reflectance, wish.optics[i].upper[b].transmittance};
      optics.lower[b] = {wish.optics[i].lower[b].reflectance, wish.optics[i].lower[b].transmittance};
    }
  }
  if (model.soil) model.soil->reflectance = wish.soil_reflectance;
}

}  // namespace

BandWish band_wish(const Waveband& band) {
  const double total = band.direct_w_m2 + band.diffuse_w_m2;
  return {total, total > 0.0 ? band.diffuse_w_m2 / total : 0.0};
}

LightWish wish_of(const Scene& scene) {
  LightWish wish;
  wish.sun = sun_wish(scene);
  wish.sky.kind = scene.model.sky ? SkyWishKind::of_scene : SkyWishKind::none;
  for (const Waveband& band : scene.model.bands) wish.bands.push_back(band_wish(band));
  for (const SurfaceOptics& optics : scene.model.optics) wish.optics.push_back(surface_wish(optics));
  if (scene.model.soil) wish.soil_reflectance = scene.model.soil->reflectance;
  return wish;
}

std::string first_difference(const LightWish& one, const LightWish& other) {
  if (in_use(one.sun) != in_use(other.sun)) return "sun";
  if (in_use(one.sky) != in_use(other.sky)) return "sky";
  if (one.own_irradiance != other.own_irradiance || (one.own_irradiance && one.bands != other.bands)) return "irradiance";
  if (one.optics != other.optics || one.soil_reflectance != other.soil_reflectance) return "optics";
  return "";
}

std::string digest_of(const LightWish& wish) {
  Digest digest;
  const auto add = [&](double number) { digest.add(fmt::format("{} ", number)); };
  const SunWish sun = in_use(wish.sun);
  for (const double number :
       {static_cast<double>(sun.shines), static_cast<double>(sun.by_clock), static_cast<double>(sun.year),
        static_cast<double>(sun.month), static_cast<double>(sun.day), sun.hour, static_cast<double>(sun.offset_minutes),
        sun.latitude_deg, sun.longitude_deg, sun.altitude_m, sun.elevation_deg, sun.azimuth_deg}) {
    add(number);
  }
  const SkyWish sky = in_use(wish.sky);
  for (const double number : {static_cast<double>(sky.kind), static_cast<double>(sky.cie_type), sky.dni_w_m2, sky.dhi_w_m2})
    add(number);
  for (const BandWish& band : wish.own_irradiance ? wish.bands : std::vector<BandWish>()) {
    add(band.total_w_m2);
    add(band.diffuse_share);
  }
  for (const SurfaceWish& surface : wish.optics) {
    for (const auto* faces : {&surface.upper, &surface.lower}) {
      for (const FaceWish& face : *faces) {
        add(face.reflectance);
        add(face.transmittance);
      }
    }
  }
  for (const double reflectance : wish.soil_reflectance) add(reflectance);
  return digest.text();
}

UtcTime time_of(const SunWish& sun) {
  return plus_seconds({sun.year, sun.month, sun.day, 0, 0, 0.0}, 3600.0 * sun.hour - 60.0 * sun.offset_minutes);
}

void grant(const LightWish& wish, const Scene& scene, RadiationModel& model) {
  const std::optional<SunPosition> sun = model.sun;
  const std::optional<SkyModel> sky = model.sky;
  const std::vector<Waveband> bands = model.bands;
  try {
    grant_light(wish, scene, model);
  } catch (...) {
    model.sun = sun;
    model.sky = sky;
    model.bands = bands;
    throw;
  }
  grant_optics(wish, scene, model);
}

}  // namespace sunfleck
