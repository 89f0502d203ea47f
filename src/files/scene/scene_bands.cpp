#include "files/scene/scene_bands.h"

#include "base/text.h"
#include "files/scene/light_plausibility.h"
#include "files/scene/plain_name.h"
#include "files/scene/scene_spectra.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace sunfleck {

namespace {

constexpr double largest_irradiance_w_m2 = 1e15;
constexpr std::size_t most_bands = 1000;
constexpr NumberRange wavelength_nm{.lo = 100.0, .hi = 1e6, .cure = "give nm, e.g. [400, 700]"};
constexpr double default_share = 0.5;  // share of PAR in solar radiation

std::string read_band_name(const TomlTable& band, const std::vector<Waveband>& earlier) {
  band.require("name", "name = \"PAR\"");
  std::string name = *band.text("name");
  if (!is_plain_name(name)) band.refuse("name", plain_name_rule, "give a name such as PAR or band_1");
  // results.nc has sensor_BAND_direct of the means of sensors and sensor_point_BAND_direct of their points.
  if (name.starts_with("point_")) band.refuse("name", "names with point_ are those of points of sensors", "leave out point_");
  if (std::any_of(earlier.begin(), earlier.end(), [&](const Waveband& other) { return other.name == name; })) {
    band.refuse("name", "another [[band]] has this name", "give every band a different name");
  }
  return name;
}

// Returns whether the unit is another word for umol_m2_s.
bool means_photons(const TomlTable& band) {
  if (!band.is_text("unit")) return false;
  const std::string unit = lower_case(band.text("unit").value_or(""));
  if (unit == "umol_m2_s") return false;
  return unit.find("mol") != unit.npos || unit.find("ppfd") != unit.npos || unit.find("photon") != unit.npos;
}

// Returns what a number in the band's unit is to be divided by to give W m-2. Light in photons gives the band its photons per
// joule: those of its wavelengths or, if it is named PAR, those of sunlight.
double read_unit(const TomlTable& table, Waveband& band, const Spectrum* spectrum) {
  if (means_photons(table)) table.refuse("unit", "must be one of W_m2, umol_m2_s", "did you mean umol_m2_s?");
  const auto unit = table.word("unit", {"W_m2", "umol_m2_s"});
  if (!unit || *unit == 0) return 1.0;
  if (band.umol_per_joule == 0.0 && band.to_nm > 0.0) {
    check_light_covers(table, {band.from_nm, band.to_nm}, spectrum);
    band.umol_per_joule = umol_per_joule_in({band.from_nm, band.to_nm}, spectrum);
  }
  if (band.umol_per_joule == 0.0 && (band.name == "PAR" || band.name == "par")) band.umol_per_joule = par_umol_per_joule;
  if (band.umol_per_joule == 0.0) {
    table.refuse("unit", "the photons per joule of this band are unknown",
                 "add umol_per_joule, 4.57 for sunlight of 400..700 nm");
  }
  if (table.has("share")) table.refuse("unit", "a share of the weather has no unit", "remove one of the two");
  return band.umol_per_joule;
}

BandLight read_fixed_light(const TomlTable& band, bool has_sun, bool has_sky) {
  const NumberRange irradiance{.lo = 0.0, .hi = largest_irradiance_w_m2, .cure = "give W m-2"};
  if (band.has("direct") && band.has("direct_normal")) {
    band.refuse("direct_normal", "direct is also given, and each follows from the other", "remove one of the two");
  }
  BandLight light;
  light.direct_w_m2 = band.number("direct", irradiance).value_or(0.0);
  light.direct_normal_w_m2 = band.number("direct_normal", irradiance).value_or(0.0);
  light.diffuse_w_m2 = band.number("diffuse", irradiance).value_or(0.0);
  if (band.has("direct")) light.direct_place = band.place("direct");
  if (light.direct_w_m2 + light.direct_normal_w_m2 > 0.0 && !has_sun) {
    band.refuse(band.has("direct") ? "direct" : "direct_normal", "this light needs a [sun]", "add [sun] or remove it");
  }
  if (light.diffuse_w_m2 > 0.0 && !has_sky) {
    band.refuse("diffuse", "this light needs a [sky]", "add [sky] with model = \"uniform\", or remove it");
  }
  return light;
}

BandLight read_band_light(const TomlTable& band, bool has_sun, bool has_sky, const std::optional<WeatherInput>& weather) {
  const auto share =
      band.number("share", {.lo = 0.0, .hi = 1.0, .is_share = true, .cure = "give a share of the broadband irradiance"});
  if (share && !weather) band.refuse("share", "a share needs [weather]", "add [weather] or remove it");
  for (const char* key : {"direct", "direct_normal", "diffuse"}) {
    if (share && band.has(key)) {
      band.refuse(key, "share is also given, which takes this light from [weather]", "remove one of the two");
    }
  }
  const bool fixed = band.has("direct") || band.has("direct_normal") || band.has("diffuse");
  if (!weather || fixed) return read_fixed_light(band, has_sun, has_sky);
  BandLight light;
  light.share = share.value_or(default_share);
  if (*light.share > 0.0 && !has_sky && weather->may_be_diffuse()) {
    weather->table.refuse_table("its diffuse light needs a [sky]", "add [sky] with model = \"perez\" or another");
  }
  return light;
}

BandLight in_w_m2(BandLight light, double per_w_m2) {
  light.direct_w_m2 /= per_w_m2;
  light.direct_normal_w_m2 /= per_w_m2;
  light.diffuse_w_m2 /= per_w_m2;
  return light;
}

std::optional<WavelengthRange> read_range(const TomlTable& band) {
  const auto range = band.numbers("range_nm", 2, wavelength_nm);
  if (!range) return std::nullopt;
  if ((*range)[0] >= (*range)[1]) {
    band.refuse("range_nm", "it must ascend", "give the shorter wavelength first, e.g. [400, 700]");
  }
  return WavelengthRange{(*range)[0], (*range)[1]};
}

// Returns the photons per energy of the band's light, 0 if they are not asked for.
double read_photons(const TomlTable& table, const Waveband& band, const Spectrum* spectrum) {
  const NumberRange photons{
      .lo = 0.0, .hi = 1e6, .lo_open = true, .cure = "give 4.57 for PAR from sun and sky, or \"spectrum\""};
  if (!table.is_text("umol_per_joule")) return table.number("umol_per_joule", photons).value_or(0.0);
  static_cast<void>(table.word("umol_per_joule", {"spectrum"}));
  const WavelengthRange range{band.from_nm, band.to_nm};
  if (!(band.to_nm > 0.0)) {
    table.refuse("umol_per_joule", "the band has no wavelengths", "add range_nm = [400, 700], or give a number");
  }
  check_light_covers(table, range, spectrum);
  return umol_per_joule_in(range, spectrum);
}

BandLight scaled(BandLight light, double share) {
  if (light.share) *light.share *= share;
  light.direct_w_m2 *= share;
  light.direct_normal_w_m2 *= share;
  light.diffuse_w_m2 *= share;
  return light;
}

// Reads `bands`: bands of equal width, among which the light is shared out by its spectrum.
BandsInput read_equal_bands(const TomlTable& root, bool has_sun, bool has_sky, const std::optional<WeatherInput>& weather,
                            const Spectrum* spectrum) {
  if (root.has("band")) root.refuse("bands", "[[band]] is also given", "keep one of the two");
  if (!root.is_table("bands")) root.refuse("bands", "it must be a table", "write bands = { from = 400, to = 700, step = 10 }");
  const TomlTable table = *root.table("bands");
  table.allow({"from", "to", "step", "direct", "direct_normal", "diffuse", "share", "umol_per_joule"});
  for (const char* key : {"from", "to", "step"}) table.require(key, fmt::format("{}, in nm", key));
  const NumberRange nm{.lo = wavelength_nm.lo, .hi = wavelength_nm.hi, .cure = "give nm, such as 400"};
  const WavelengthRange all{*table.number("from", nm), *table.number("to", nm)};
  if (all.from_nm >= all.to_nm)
    table.refuse("to", fmt::format("it must be above `from`, {:g}", all.from_nm), "exchange the two");
  const double step_nm =
      *table.number("step", {.lo = 0.0, .hi = wavelength_nm.hi, .lo_open = true, .cure = "give the width of a band in nm"});
  const double count = (all.to_nm - all.from_nm) / step_nm;
  const double whole = std::round(count);
  if (!(whole >= 1.0) || whole > static_cast<double>(most_bands) || std::abs(count - whole) > 1e-6) {
    table.refuse("step",
                 fmt::format("{:g} to {:g} nm gives {:g} bands, but 1 to {} whole ones are possible", all.from_nm, all.to_nm,
                             count, most_bands),
                 "choose a step that divides the range");
  }
  check_light_covers(table, all, spectrum);
  const double energy = energy_in(spectrum, all);
  if (!(energy > 0.0)) table.refuse_table("the light spectrum is dark in its range", "correct the range or the file");
  const BandLight light = read_band_light(table, has_sun, has_sky, weather);
  BandsInput input;
  for (int k = 0; k < static_cast<int>(whole); ++k) {
    const WavelengthRange range{all.from_nm + k * step_nm,
                                k + 1 < static_cast<int>(whole) ? all.from_nm + (k + 1) * step_nm : all.to_nm};
    Waveband band;
    band.name = fmt::format("{:g}_{:g}", range.from_nm, range.to_nm);
    band.from_nm = range.from_nm;
    band.to_nm = range.to_nm;
    band.umol_per_joule = read_photons(table, band, spectrum);
    if (!is_plain_name(band.name)) {
      table.refuse("step", fmt::format("a band would be named {}", band.name), "use wavelengths in whole nm");
    }
    input.bands.push_back(std::move(band));
    input.lights.push_back(scaled(light, energy_in(spectrum, range) / energy));
    input.per_w_m2.push_back(1.0);
  }
  return input;
}

}  // namespace

BandsInput read_bands(const TomlTable& root, const std::optional<SunInput>& sun, const std::optional<SkyInput>& sky,
                      const std::optional<WeatherInput>& weather, const Spectrum* spectrum,
                      std::vector<std::string>& warnings) {
  if (root.has("bands")) return read_equal_bands(root, sun.has_value(), sky.has_value(), weather, spectrum);
  const std::vector<TomlTable> tables = root.tables("band");
  if (tables.empty()) root.require("band", "[[band]] with name = \"PAR\" and direct = 350.0");
  if (tables.empty()) root.refuse("band", "at least one is required", "add [[band]] with name = \"PAR\" and direct = 350.0");
  if (tables.size() > most_bands) root.refuse("band", fmt::format("at most {} are allowed", most_bands), "split the scene");
  BandsInput input;
  for (const TomlTable& table : tables) {
    table.allow({"name", "range_nm", "direct", "direct_normal", "diffuse", "share", "umol_per_joule", "unit"});
    Waveband band;
    band.name = read_band_name(table, input.bands);
    if (const auto range = read_range(table)) {
      band.from_nm = range->from_nm;
      band.to_nm = range->to_nm;
    }
    band.umol_per_joule = read_photons(table, band, spectrum);
    const double per_w_m2 = read_unit(table, band, spectrum);
    input.bands.push_back(std::move(band));
    input.lights.push_back(in_w_m2(read_band_light(table, sun.has_value(), sky.has_value(), weather), per_w_m2));
    input.per_w_m2.push_back(per_w_m2);
    if (weather && !input.lights.back().share) {
      warnings.push_back(fmt::format("{}: it has its own irradiance, so [weather] does not affect it", table.place()));
    }
  }
  return input;
}

}  // namespace sunfleck
