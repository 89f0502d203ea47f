#include "files/scene/scene_surface.h"

#include "base/file.h"
#include "base/suggestions.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <string_view>

namespace sunfleck {

namespace {

constexpr double most_patches = 64e6;    // cells of the soil's map: 512 MB per field in double precision
constexpr double default_patches = 4e6;  // without `patch`, on plots where 0.05 m would give more: above a hectare
constexpr double sum_tolerance = 1e-12;  // rounding of reflectance + transmittance as decimal fractions
constexpr std::size_t most_optics = 65535;
constexpr std::size_t most_coefficients = 4'000'000;  // optics times bands; 32 bytes each

constexpr NumberRange share{.lo = 0.0, .hi = 1.0, .is_share = true, .cure = "give a share of the incident light"};

constexpr NumberRange exitance{
    .lo = 0.0, .hi = 1e15, .cure = "give the flux that leaves the upper side in W m-2, or in the band's unit"};

// Reads one number for all bands, or a table with exactly one number per band; returns nothing if the key is absent.
std::optional<std::vector<double>> read_by_band(const TomlTable& table, std::string_view key,
                                                const std::vector<Waveband>& bands, const NumberRange& range = share) {
  if (!table.is_table(key)) {
    const auto value = table.number(key, range);
    if (!value) return std::nullopt;
    return std::vector<double>(bands.size(), *value);
  }
  const TomlTable by_band = *table.table(key);
  std::vector<std::string> names;
  for (const Waveband& band : bands) names.push_back(band.name);
  for (const std::string& name : by_band.keys()) {
    if (std::find(names.begin(), names.end(), name) != names.end()) continue;
    by_band.refuse(name, "the scene has no [[band]] of this name",
                   did_you_mean(name, names, "remove it, or add a [[band]] with this name"));
  }
  std::vector<double> values;
  for (const std::string& name : names) {
    by_band.require(name, fmt::format("a number for band {}, or give one number for all bands", name));
    values.push_back(*by_band.number(name, range));
  }
  return values;
}

glm::dvec3 read_rgb(const TomlTable& table, const glm::dvec3& fallback) {
  return table.triple("rgb", {.lo = 0.0, .hi = 1.0, .cure = "give reflectances; divide 8-bit colours by 255"})
      .value_or(fallback);
}

std::vector<FaceOptics> read_face(const TomlTable& table, std::vector<Waveband>& bands, const SpectraAccess& spectra) {
  if (table.has("spectrum")) return read_spectral_face(table, bands, spectra);
  table.require("reflectance", fmt::format("reflectance = {{ {} = 0.12 }}", bands.front().name));
  const std::vector<double> reflectance = *read_by_band(table, "reflectance", bands);
  const std::vector<double> transmittance =
      read_by_band(table, "transmittance", bands).value_or(std::vector<double>(bands.size(), 0.0));
  std::vector<FaceOptics> face;
  for (std::size_t band = 0; band < bands.size(); ++band) {
    const double sum = reflectance[band] + transmittance[band];
    if (sum > 1.0 + sum_tolerance) {
      table.refuse("transmittance",
                   fmt::format("reflectance + transmittance = {} in band {}, but must be at most 1", sum, bands[band].name),
                   "lower one of the two");
    }
    face.push_back({reflectance[band], transmittance[band]});
  }
  return face;
}

std::vector<double> read_emission_w_m2(const TomlTable& table, const std::vector<Waveband>& bands,
                                       const std::vector<double>& per_w_m2) {
  std::vector<double> emission = read_by_band(table, "emission", bands, exitance).value_or(std::vector<double>());
  for (std::size_t band = 0; band < emission.size(); ++band) emission[band] /= per_w_m2[band];
  return emission;
}

SurfaceOptics read_surface(const TomlTable& table, const std::string& name, std::vector<Waveband>& bands,
                           const std::vector<double>& per_w_m2, const SpectraAccess& spectra) {
  table.allow({"reflectance", "transmittance", "spectrum", "rgb", "upper", "lower", "emission", "role"});
  SurfaceOptics optics;
  optics.name = name;
  optics.rgb = read_rgb(table, optics.rgb);
  optics.role = read_role(table);
  optics.emission_w_m2 = read_emission_w_m2(table, bands, per_w_m2);
  if (!table.has("upper") && !table.has("lower")) {
    optics.upper = read_face(table, bands, spectra);
    optics.lower = optics.upper;
    return optics;
  }
  for (const char* key : {"reflectance", "transmittance", "spectrum"}) {
    if (table.has(key)) table.refuse(key, "upper and lower give it for each face", "remove it, or upper and lower");
  }
  table.require("upper", fmt::format("[optics.{}.upper] with reflectance", printable(name)));
  table.require("lower", fmt::format("[optics.{}.lower] with reflectance", printable(name)));
  const TomlTable upper = *table.table("upper");
  const TomlTable lower = *table.table("lower");
  upper.allow({"reflectance", "transmittance", "spectrum"});
  lower.allow({"reflectance", "transmittance", "spectrum"});
  optics.upper = read_face(upper, bands, spectra);
  optics.lower = read_face(lower, bands, spectra);
  return optics;
}

// Refuses [[optics]] and other things that are no tables by name.
[[noreturn]] void refuse_list_of_optics(const TomlTable& root) {
  std::string name = "leaf";
  if (!root.is_text("optics")) {
    const std::vector<TomlTable> items = root.tables("optics");
    if (!items.empty() && items.front().is_text("name")) name = *items.front().text("name");
  }
  root.refuse("optics", "each material has a table of its own name, and there is no list of them",
              fmt::format("write [optics.{}] with reflectance below it", printable(name)));
}

double cells(const Plot& plot, double patch_m) {
  return std::ceil(plot.size_x_m / patch_m) * std::ceil(plot.size_z_m / patch_m);
}

}  // namespace

std::optional<Role> read_role(const TomlTable& table) {
  if (table.is_text("role")) {
    const std::string word = table.text("role").value_or("");
    const auto meant = role_from_name(word);
    if (meant && word != role_name(*meant))
      table.refuse("role", fmt::format("must be one of {}", fmt::join(role_names, ", ")),
                   fmt::format("did you mean {}?", role_name(*meant)));
  }
  const auto number = table.word("role", {role_names.begin(), role_names.end()});
  if (!number) return std::nullopt;
  return static_cast<Role>(*number);
}

std::optional<Soil> read_soil(const TomlTable& root, std::vector<Waveband>& bands, const Plot& plot,
                              const SpectraAccess& spectra, std::vector<std::string>& warnings) {
  const auto table = root.table("soil");
  if (!table) return std::nullopt;
  table->allow({"reflectance", "spectrum", "patch", "rgb"});
  Soil soil;
  if (table->has("spectrum")) {
    for (const FaceOptics& face : read_spectral_face(*table, bands, spectra)) soil.reflectance.push_back(face.reflectance);
  } else {
    table->require("reflectance", fmt::format("reflectance = {{ {} = 0.15 }}", bands.front().name));
    soil.reflectance = *read_by_band(*table, "reflectance", bands);
  }
  soil.rgb = read_rgb(*table, soil.rgb);
  const auto patch_m = table->number("patch", {.lo = 0.0, .hi = 1e6, .lo_open = true, .cure = "give metres"});
  soil.patch_m = patch_m.value_or(soil.patch_m);
  const double count = cells(plot, soil.patch_m);
  if (patch_m && count > most_patches) {
    table->refuse("patch", fmt::format("gives {:.3g} cells on this plot, but at most {:.0f} are allowed", count, most_patches),
                  "use larger patches");
  }
  if (patch_m || plot.area_m2() <= default_patches * soil.patch_m * soil.patch_m) return soil;
  soil.patch_m = std::sqrt(plot.area_m2() / default_patches);
  warnings.push_back(fmt::format("{}.patch is {:.3g} m, because there would be {:.3g} patches of 0.05 m on this plot",
                                 table->place(), soil.patch_m, count));
  return soil;
}

OpticsByName read_optics(const TomlTable& root, std::vector<Waveband>& bands, const std::vector<double>& per_w_m2,
                         const SpectraAccess& spectra) {
  if (root.has("optics") && !root.is_table("optics")) refuse_list_of_optics(root);
  const auto all = root.table("optics");
  if (!all) return {};
  const std::size_t names = all->keys().size();
  if (names > most_optics) all->refuse_table(fmt::format("there are more than {} names", most_optics), "define fewer");
  if (names * bands.size() > most_coefficients) {
    all->refuse_table(
        fmt::format("{} names with {} bands each give more than {} coefficients", names, bands.size(), most_coefficients),
        "define fewer, or split the bands over scenes");
  }
  OpticsByName optics;
  for (const std::string& name : all->keys()) {
    if (!all->is_table(name)) {
      all->refuse(name, "each entry must be a table named after a material of a mesh",
                  "write [optics.leaf] with reflectance below it, or remove this key");
    }
    if (name.empty()) all->refuse(name, "a name must not be empty", "give the name of a mesh's material");
    const TomlTable table = *all->table(name);
    optics.emplace(name, OpticsInput{read_surface(table, name, bands, per_w_m2, spectra), table.place()});
  }
  return optics;
}

}  // namespace sunfleck
