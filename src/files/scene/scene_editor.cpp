#include "files/scene/scene_editor.h"

#include "base/check.h"
#include "files/scene/toml_parse.h"

#include <toml++/toml.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <sstream>
#include <utility>

namespace sunfleck {
namespace {

using BandNames = std::vector<std::string>;
using RenamedFile = std::function<std::optional<std::string>(const std::string&)>;

constexpr std::array<std::string_view, 4> keys_of_files = {"file", "positions", "spectrum", "light_spectrum"};

void rename_files(toml::table& table, const RenamedFile& renamed) {
  for (auto&& [key, item] : table) {
    if (toml::table* below = item.as_table()) {
      rename_files(*below, renamed);
    } else if (toml::array* list = item.as_array()) {
      for (toml::node& entry : *list) {
        if (toml::table* in_list = entry.as_table()) rename_files(*in_list, renamed);
      }
    } else if (toml::value<std::string>* text = item.as_string()) {
      if (std::find(keys_of_files.begin(), keys_of_files.end(), key.str()) == keys_of_files.end()) continue;
      if (auto name = renamed(text->get())) *text = std::move(*name);
    }
  }
}

void erase(toml::table& table, std::initializer_list<std::string_view> keys) {
  for (const std::string_view key : keys) table.erase(key);
}

// Returns the table of that name, which is added if it is missing.
toml::table& table_in(toml::table& root, std::string_view key) {
  return *root.insert(key, toml::table()).first->second.as_table();
}

toml::table sun_table(const SunByAngles& sun) {
  return toml::table{{"elevation", sun.elevation_deg}, {"azimuth", sun.azimuth_deg}};
}

toml::table sun_table(const SunByClock& sun) {
  const UtcTime& local = sun.local_time;
  const toml::date date(local.year, local.month, local.day);
  const toml::time time(local.hour, local.minute, static_cast<int>(std::lround(local.second)));
  toml::time_offset offset;
  offset.minutes = static_cast<std::int16_t>(sun.offset_minutes);
  return toml::table{
      {"time", toml::date_time(date, time, offset)}, {"latitude", sun.latitude_deg}, {"longitude", sun.longitude_deg}};
}

toml::table sky_table(const SkyModel& sky) {
  EXPECT(sky.kind == SkyKind::lights, ==, false);
  switch (sky.kind) {
    case SkyKind::uniform:
    case SkyKind::lights:
      break;
    case SkyKind::overcast:
      return toml::table{{"model", "cie-overcast"}};
    case SkyKind::general:
      return toml::table{{"model", "cie"}, {"type", sky.cie_type}};
    case SkyKind::all_weather:
      return toml::table{{"model", "perez"}, {"dni", sky.dni_w_m2}, {"dhi", sky.dhi_w_m2}};
  }
  return toml::table{{"model", "uniform"}};
}

// Writes, removes or keeps one table of the scene.
struct PutTable {
  toml::table& root;
  std::string_view key;

  void operator()(Unchanged /*table*/) const {}
  void operator()(Absent /*table*/) const { root.erase(key); }
  void operator()(const SunByAngles& sun) const { root.insert_or_assign(key, sun_table(sun)); }
  void operator()(const SunByClock& sun) const { root.insert_or_assign(key, sun_table(sun)); }
  void operator()(const SkyModel& sky) const { root.insert_or_assign(key, sky_table(sky)); }
};

// Replaces bands of equal width by a list of them.
void list_bands(toml::table& root, const std::vector<Waveband>& bands) {
  root.erase("bands");
  toml::array list;
  for (const Waveband& band : bands) {
    list.push_back(toml::table{{"name", band.name}, {"range_nm", toml::array{band.from_nm, band.to_nm}}});
  }
  root.insert_or_assign("band", std::move(list));
}

template <class ValueOf>
toml::table by_band(const BandNames& names, const ValueOf& value_of) {
  toml::table table;
  for (std::size_t b = 0; b < names.size(); ++b) table.insert_or_assign(names[b], value_of(b));
  return table;
}

// Writes in W m-2 what lamps emit in bands with another unit, before these lose it.
void put_emission_in_w_m2(toml::table& root, const std::vector<Waveband>& bands) {
  BandNames names;
  std::vector<double> per_w_m2;
  for (std::size_t b = 0; b < bands.size(); ++b) {
    const bool photons = root["band"][b]["unit"].value<std::string>() == "umol_m2_s";
    names.push_back(bands[b].name);
    per_w_m2.push_back(photons ? bands[b].umol_per_joule : 1.0);
  }
  toml::table* optics = root["optics"].as_table();
  if (optics == nullptr || std::count(per_w_m2.begin(), per_w_m2.end(), 1.0) == std::ssize(per_w_m2)) return;
  for (auto&& [name, item] : *optics) {
    toml::table& surface = *item.as_table();
    const auto emission = surface["emission"];
    if (!emission) continue;
    surface.insert_or_assign("emission", by_band(names, [&](std::size_t b) {
                               const auto given =
                                   emission.is_table() ? emission[names[b]].value<double>() : emission.value<double>();
                               return *given / per_w_m2[b];
                             }));
  }
}

void put_irradiances(toml::table& root, const std::vector<Waveband>& bands) {
  root.erase("weather");
  if (root.contains("bands")) list_bands(root, bands);
  toml::array& list = *root["band"].as_array();
  EXPECT(list.size(), ==, bands.size());
  put_emission_in_w_m2(root, bands);
  for (std::size_t b = 0; b < bands.size(); ++b) {
    toml::table& table = *list[b].as_table();
    const Waveband& band = bands[b];
    erase(table, {"direct", "direct_normal", "diffuse", "share", "unit"});
    table.insert_or_assign("direct", band.direct_w_m2);
    table.insert_or_assign("diffuse", band.diffuse_w_m2);
    if (band.umol_per_joule > 0.0) table.insert_or_assign("umol_per_joule", band.umol_per_joule);
  }
}

toml::table face_table(const BandNames& names, const std::vector<FaceOptics>& face) {
  EXPECT(face.size(), ==, names.size());
  return toml::table{{"reflectance", by_band(names, [&](std::size_t b) { return face[b].reflectance; })},
                     {"transmittance", by_band(names, [&](std::size_t b) { return face[b].transmittance; })}};
}

void put_optics(toml::table& root, const BandNames& names, const SurfaceOptics& optics) {
  toml::table& table = table_in(table_in(root, "optics"), optics.name);
  erase(table, {"reflectance", "transmittance", "spectrum"});
  table.insert_or_assign("upper", face_table(names, optics.upper));
  table.insert_or_assign("lower", face_table(names, optics.lower));
}

void put_soil(toml::table& root, const BandNames& names, const std::vector<double>& reflectance) {
  EXPECT(reflectance.size(), ==, names.size());
  toml::table& soil = table_in(root, "soil");
  soil.erase("spectrum");
  soil.insert_or_assign("reflectance", by_band(names, [&](std::size_t b) { return reflectance[b]; }));
}

void put_accuracy(toml::table& root, const Accuracy& accuracy) {
  toml::table& table = table_in(root, "accuracy");
  table.insert_or_assign("direct", accuracy.direct);
  table.insert_or_assign("indirect", accuracy.indirect);
}

}  // namespace

std::string edited_scene_text(const std::string& file, std::string_view text, const std::vector<std::string>& band_names,
                              const SceneEdits& edits) {
  toml::table root = *parse_toml(file, text);
  if (edits.renamed_file) rename_files(root, edits.renamed_file);
  if (edits.title) root.insert_or_assign("title", *edits.title);
  std::visit(PutTable{root, "sun"}, edits.sun);
  std::visit(PutTable{root, "sky"}, edits.sky);
  if (!edits.irradiances.empty()) put_irradiances(root, edits.irradiances);
  for (const SurfaceOptics& optics : edits.optics) put_optics(root, band_names, optics);
  if (!edits.soil_reflectance.empty()) put_soil(root, band_names, edits.soil_reflectance);
  if (edits.accuracy) put_accuracy(root, *edits.accuracy);
  std::ostringstream written;
  written << root << '\n';
  return written.str();
}

}  // namespace sunfleck
