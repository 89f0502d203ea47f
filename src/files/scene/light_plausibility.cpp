#include "files/scene/light_plausibility.h"

#include "physics/transport/model/surfaces.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <optional>
#include <set>

namespace sunfleck {
namespace {

constexpr double most_irradiance_w_m2 = 1400.0;  // of sunlight on level ground, whole spectrum, brightened by clouds
constexpr double largest_in_radians = 1.6;       // just above a right angle
constexpr int decimals_of_radians = 3;

// Returns how many decimals the shortest text of a number has.
int decimals(double value) {
  const std::string text = fmt::format("{}", value);
  const std::size_t point = text.find('.');
  return point == std::string::npos ? 0 : static_cast<int>(text.size() - point - 1);
}

void warn_of_angles(const TomlTable& sun, std::vector<std::string>& warnings) {
  const auto elevation = sun.number("elevation", {});
  if (elevation && *elevation > 0.0 && *elevation < largest_in_radians && decimals(*elevation) >= decimals_of_radians) {
    warnings.push_back(fmt::format("{}: {} looks like radians, but is taken as degrees; radians would be {:.6g} degrees",
                                   sun.place("elevation"), *elevation, glm::degrees(*elevation)));
  }
  const auto azimuth = sun.number("azimuth", {});
  if (azimuth && *azimuth < 0.0) {
    warnings.push_back(
        fmt::format("{}: {} is below 0, and azimuths count clockwise from north: give {:.6g}, or {:.6g} if it was measured "
                    "from south, positive to the west",
                    sun.place("azimuth"), *azimuth, *azimuth + 360.0, std::fmod(*azimuth + 540.0, 360.0)));
  }
}

// Warns if the sun is highest far from noon by the clock of the scene's time. UTC is no clock of a place.
void warn_of_clock(const TomlTable& sun, const SunMoment& moment, std::vector<std::string>& warnings) {
  constexpr double day_minutes = 1440.0, minutes_per_deg = 4.0;
  constexpr double most_minutes = 240.0;  // in western China the sun is highest three hours after noon
  const double longitude_deg = glm::degrees(moment.place.longitude_rad);
  const auto late_minutes = [&](double east_deg) {
    return std::remainder(moment.offset_minutes - minutes_per_deg * east_deg, day_minutes);
  };
  if (moment.offset_minutes == 0 || std::abs(late_minutes(longitude_deg)) <= most_minutes) return;
  const int noon = static_cast<int>(std::lround(0.5 * day_minutes + late_minutes(longitude_deg) + day_minutes)) % 1440;
  const bool turned = std::abs(late_minutes(-longitude_deg)) <= most_minutes;
  warnings.push_back(fmt::format(
      "{}: at {:.6g} degrees east the sun is highest at about {:02}:{:02} by the clock of sun.time; {}", sun.place("longitude"),
      longitude_deg, noon / 60, noon % 60,
      turned ? fmt::format("if it is west, give {:.6g}", -longitude_deg) : "correct the longitude or the offset of the time"));
}

void warn_of_shares(const TomlTable& band, const std::vector<BandLight>& lights, std::vector<std::string>& warnings) {
  double sum = 0.0;
  for (const BandLight& light : lights) sum += light.share.value_or(0.0);
  if (sum <= 1.0 + 1e-6) return;
  warnings.push_back(
      fmt::format("{}: the shares of all bands add up to {:.4g} of the broadband irradiance; give at most 1 in all "
                  "unless bands overlap (a share that is left out is 0.5)",
                  band.place("share"), sum));
}

// Returns whether the table is a [[band]], which takes a unit; `bands` takes none.
bool takes_unit(const TomlTable& band) {
  return !band.has("step");
}

// Returns true, and warns, if the irradiance is more than sunlight brings.
bool warn_of_photons(const TomlTable& band, const char* key, double irradiance_w_m2, std::vector<std::string>& warnings) {
  if (irradiance_w_m2 <= most_irradiance_w_m2) return false;
  warnings.push_back(fmt::format(
      "{}: {:.6g} W m-2 is more than the sun sends to the ground, {:.0f}; if umol m-2 s-1 of PAR "
      "are meant, {} {:.4g} W m-2",
      band.place(key), irradiance_w_m2, most_irradiance_w_m2,
      takes_unit(band) ? "add unit = \"umol_m2_s\", which makes it" : "give", irradiance_w_m2 / par_umol_per_joule));
  return true;
}

// The strongest beam that there can be in a band.
struct BeamLimit {
  double w_m2 = 0.0;  // towards the sun
  std::string where;  // outside the atmosphere, and in which wavelengths
};

BeamLimit limit_of(const WavelengthRange& range, double solar_w_m2) {
  if (!(range.to_nm > 0.0)) return {solar_w_m2, "outside the atmosphere"};
  return {most_solar_share(range) * solar_w_m2,
          fmt::format("outside the atmosphere from {:g} to {:g} nm", range.from_nm, range.to_nm)};
}

// Returns what else the numbers of a band with wavelengths may mean.
std::string photons_instead(const TomlTable& band, const WavelengthRange& range) {
  const bool may_be_photons = range.to_nm > 0.0 && takes_unit(band) && !band.has("unit");
  return may_be_photons ? ", or add unit = \"umol_m2_s\" if umol m-2 s-1 are meant" : "";
}

void warn_of_beam(const TomlTable& band, const BandLight& light, const SunPosition& sun, const WavelengthRange& range,
                  double solar_w_m2, std::vector<std::string>& warnings) {
  const double sine = std::sin(sun.elevation_rad);
  const BeamLimit limit = limit_of(range, solar_w_m2);
  if (light.direct_normal_w_m2 > 0.0) {
    if (warn_of_photons(band, "direct_normal", light.direct_normal_w_m2, warnings)) return;
    if (light.direct_normal_w_m2 <= limit.w_m2) return;
    warnings.push_back(fmt::format("{}: {:.6g} W m-2 is more than {}; give at most {:.0f}{}", band.place("direct_normal"),
                                   light.direct_normal_w_m2, limit.where, limit.w_m2, photons_instead(band, range)));
  } else if (light.direct_w_m2 > 0.0) {
    if (warn_of_photons(band, "direct", light.direct_w_m2, warnings)) return;
    if (sine <= 0.0 || light.direct_w_m2 <= limit.w_m2 * sine) return;
    warnings.push_back(
        fmt::format("{}: {:.6g} W m-2 on level ground, with the sun at {:.4g} degrees, is a beam of {:.0f} W m-2 "
                    "towards the sun, more than {}; give at most {:.4g}{}",
                    band.place("direct"), light.direct_w_m2, glm::degrees(sun.elevation_rad), light.direct_w_m2 / sine,
                    limit.where, limit.w_m2 * sine, photons_instead(band, range)));
  }
}

// Returns the fixed light of all bands together.
BandLight sum_of(const std::vector<BandLight>& bands) {
  BandLight sum;
  for (const BandLight& band : bands) {
    sum.direct_w_m2 += band.direct_w_m2;
    sum.direct_normal_w_m2 += band.direct_normal_w_m2;
    sum.diffuse_w_m2 += band.diffuse_w_m2;
  }
  return sum;
}

// Returns whether its role or a name says that a surface is a leaf; unnamed surfaces count as leaves too.
bool is_called_leaf(const Surface& surface, const RadiationModel& model) {
  if (surface.role != Role::leaf) return false;
  const SurfaceOptics& optics = model.optics[surface.optics];
  const Organ& organ = model.canopy.organs[surface.organ];
  return organ.role == Role::leaf || optics.role == Role::leaf || role_from_name(organ.name) == Role::leaf ||
         role_from_name(optics.name) == Role::leaf;
}

}  // namespace

double most_solar_share(const WavelengthRange& range) {
  constexpr double effective_temperature_k = 5772.0;
  constexpr double margin = 1.25;
  return std::min(1.0, margin * black_body_share(range, effective_temperature_k));
}

std::vector<std::string> light_warnings(const TomlTable& root, const Scene& scene) {
  std::vector<std::string> warnings;
  if (const auto sun = root.table("sun")) {
    warn_of_angles(*sun, warnings);
    if (scene.moment) warn_of_clock(*sun, *scene.moment, warnings);
  }
  const auto day = scene.moment ? std::optional<int>(day_of_year(scene.moment->time)) : std::nullopt;
  const double limit_w_m2 = extraterrestrial_normal_w_m2(solar_constant_w_m2, day);
  const auto check = [&](const TomlTable& table, const BandLight& light, const WavelengthRange& range) {
    if (scene.model.sun) warn_of_beam(table, light, *scene.model.sun, range, limit_w_m2, warnings);
    static_cast<void>(warn_of_photons(table, "diffuse", light.diffuse_w_m2, warnings));
  };
  const std::vector<Waveband>& bands = scene.model.bands;
  if (const auto equal = root.table("bands")) {
    if (!scene.light.bands.front().share) check(*equal, sum_of(scene.light.bands), {bands.front().from_nm, bands.back().to_nm});
    return warnings;
  }
  const std::vector<TomlTable> tables = root.tables("band");
  for (std::size_t b = 0; b < tables.size(); ++b) {
    if (!scene.light.bands[b].share) check(tables[b], scene.light.bands[b], {bands[b].from_nm, bands[b].to_nm});
  }
  warn_of_shares(tables.front(), scene.light.bands, warnings);
  return warnings;
}

std::vector<std::string> emission_warnings(const TomlTable& root, const RadiationModel& model) {
  std::set<std::string> shining;
  for (const Surface& surface : Surfaces(model).of) {
    const SurfaceOptics& optics = model.optics[surface.optics];
    if (optics.shines() && is_called_leaf(surface, model)) shining.insert(optics.name);
  }
  std::vector<std::string> warnings;
  const auto all = root.table("optics");
  for (const std::string& name : shining) {
    if (!all || !all->is_table(name) || !all->table(name)->has("emission")) continue;
    warnings.push_back(fmt::format("{}: leaves send out light; give it 0, or role = \"lamp\" if this is a lamp",
                                   all->table(name)->place("emission")));
  }
  return warnings;
}

}  // namespace sunfleck
