#include "files/scene/scene_bands.h"

#include "files/scene/plain_name.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace sunfleck {

namespace {

constexpr double largest_irradiance_w_m2 = 1e15;
constexpr std::size_t most_bands = 1000;
constexpr double default_share = 0.5;        // share of PAR in solar radiation
constexpr double par_umol_per_joule = 4.57;  // of sunlight of 400..700 nm (McCree 1972)

std::string read_band_name(const TomlTable& band, const std::vector<Waveband>& earlier) {
  band.require("name", "name = \"PAR\"");
  std::string name = *band.text("name");
  if (!is_plain_name(name)) band.refuse("name", plain_name_rule, "give a name such as PAR or band_1");
  if (std::any_of(earlier.begin(), earlier.end(), [&](const Waveband& other) { return other.name == name; })) {
    band.refuse("name", "another [[band]] has this name", "give every band a different name");
  }
  return name;
}

// Returns what a number in the band's unit is to be divided by to give W m-2. Light in photons gives the band its photons per
// joule if it is named PAR.
double read_unit(const TomlTable& table, Waveband& band) {
  const auto unit = table.word("unit", {"W_m2", "umol_m2_s"});
  if (!unit || *unit == 0) return 1.0;
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

}  // namespace

BandsInput read_bands(const TomlTable& root, const std::optional<SunInput>& sun, const std::optional<SkyInput>& sky,
                      const std::optional<WeatherInput>& weather, std::vector<std::string>& warnings) {
  const std::vector<TomlTable> tables = root.tables("band");
  if (tables.empty()) root.require("band", "[[band]] with name = \"PAR\" and direct = 350.0");
  if (tables.empty()) root.refuse("band", "at least one is required", "add [[band]] with name = \"PAR\" and direct = 350.0");
  if (tables.size() > most_bands) root.refuse("band", fmt::format("at most {} are allowed", most_bands), "split the scene");
  BandsInput input;
  for (const TomlTable& table : tables) {
    table.allow({"name", "direct", "direct_normal", "diffuse", "share", "umol_per_joule", "unit"});
    Waveband band;
    band.name = read_band_name(table, input.bands);
    const NumberRange photons{.lo = 0.0, .hi = 1e6, .lo_open = true, .cure = "give 4.57 for PAR from sun and sky"};
    band.umol_per_joule = table.number("umol_per_joule", photons).value_or(0.0);
    const double per_w_m2 = read_unit(table, band);
    input.bands.push_back(std::move(band));
    input.lights.push_back(in_w_m2(read_band_light(table, sun.has_value(), sky.has_value(), weather), per_w_m2));
    if (weather && !input.lights.back().share) {
      warnings.push_back(fmt::format("{}: it has its own irradiance, so [weather] does not affect it", table.place()));
    }
  }
  return input;
}

}  // namespace sunfleck
