#include "programs/viewer/saved_scene.h"

#include "base/error.h"
#include "base/file.h"
#include "files/formats/mesh/mesh_reader.h"
#include "files/scene/toml_parse.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>
#include <string_view>
#include <system_error>

namespace sunfleck {
namespace {

namespace fs = std::filesystem;

// Returns the file's name relative to the scene's folder; empty if it does not lie in that folder or below.
fs::path name_in_scene_folder(const Scene& scene, const fs::path& file) {
  std::error_code ignored;
  const fs::path folder = fs::absolute(scene.file, ignored).lexically_normal().parent_path();
  const auto below = [](const fs::path& base, const fs::path& whole) {
    const fs::path name = whole.lexically_relative(base);
    return name.empty() || *name.begin() == ".." ? fs::path() : name;
  };
  const fs::path name = below(folder, fs::absolute(file, ignored).lexically_normal());
  if (!name.empty()) return name;
  return below(fs::weakly_canonical(folder, ignored), fs::weakly_canonical(file, ignored));
}

// Returns the name under which the saved scene finds a file that the original calls `name`; nothing if that is no file's name.
std::optional<std::string> saved_name(const Scene& scene, const std::string& name) {
  std::error_code ignored;
  const fs::path meant = fs::absolute(scene.file.parent_path() / name, ignored).lexically_normal();
  const bool known = std::any_of(scene.files.begin(), scene.files.end(), [&](const SourceFile& file) {
    return fs::absolute(file.path, ignored).lexically_normal() == meant;
  });
  if (name.empty() || !known) return std::nullopt;
  const fs::path inside = name_in_scene_folder(scene, meant);
  return inside.empty() ? meant.generic_string() : (fs::path(saved_scene_files) / inside).generic_string();
}

void rename_files(toml::node& node, const Scene& scene) {
  if (toml::value<std::string>* text = node.as_string()) {
    if (const auto name = saved_name(scene, text->get())) *text = *name;
  } else if (toml::array* items = node.as_array()) {
    for (toml::node& item : *items) rename_files(item, scene);
  } else if (toml::table* table = node.as_table()) {
    for (auto&& [key, item] : *table) {
      if (key.str() != "title" && key.str() != "name") rename_files(item, scene);
    }
  }
}

void erase(toml::table& table, std::initializer_list<std::string_view> keys) {
  for (const std::string_view key : keys) table.erase(key);
}

toml::table sun_table(const SunRequest& sun) {
  if (!sun.by_clock) return toml::table{{"elevation", sun.elevation_deg}, {"azimuth", sun.azimuth_deg}};
  SunRequest without_offset = sun;
  without_offset.offset_minutes = 0;
  const UtcTime local = time_of(without_offset);
  const toml::date date(local.year, local.month, local.day);
  const toml::time time(local.hour, local.minute, static_cast<int>(std::lround(local.second)));
  toml::time_offset offset;
  offset.minutes = static_cast<std::int16_t>(sun.offset_minutes);
  return toml::table{
      {"time", toml::date_time(date, time, offset)}, {"latitude", sun.latitude_deg}, {"longitude", sun.longitude_deg}};
}

// Returns nothing for a sky of listed directions, which only a file holds.
std::optional<toml::table> sky_table(const SkyModel& sky) {
  switch (sky.kind) {
    case SkyKind::uniform:
      return toml::table{{"model", "uniform"}};
    case SkyKind::overcast:
      return toml::table{{"model", "cie-overcast"}};
    case SkyKind::general:
      return toml::table{{"model", "cie"}, {"type", sky.cie_type}};
    case SkyKind::all_weather:
      return toml::table{{"model", "perez"}, {"dni", sky.dni_w_m2}, {"dhi", sky.dhi_w_m2}};
    case SkyKind::lights:
      break;
  }
  return std::nullopt;
}

// Gives every band its light in W m-2 instead of by other keys.
void fix_bands(toml::table& root, const RadiationModel& model) {
  root.erase("weather");
  if (root.contains("bands")) {
    root.erase("bands");
    toml::array all;
    for (const Waveband& band : model.bands) {
      all.push_back(toml::table{{"name", band.name}, {"range_nm", toml::array{band.from_nm, band.to_nm}}});
    }
    root.insert_or_assign("band", std::move(all));
  }
  toml::array& bands = *root["band"].as_array();
  for (std::size_t b = 0; b < model.bands.size(); ++b) {
    toml::table& table = *bands[b].as_table();
    const Waveband& band = model.bands[b];
    erase(table, {"direct", "direct_normal", "diffuse", "share", "unit"});
    table.insert_or_assign("direct", band.direct_w_m2);
    table.insert_or_assign("diffuse", band.diffuse_w_m2);
    if (band.umol_per_joule > 0.0) table.insert_or_assign("umol_per_joule", band.umol_per_joule);
  }
}

void put_light(toml::table& root, const SceneToSave& scene) {
  const LightRequest own = request_of(scene.original);
  const RadiationModel& model = scene.granted.model;
  const bool other_sun = !same_sun(own.sun, scene.request.sun);
  const bool other_sky = !same_sky(own.sky, scene.request.sky);
  if (!other_sun && !other_sky && !scene.request.own_irradiance) return;
  // Where only the sun has moved, the scene's own keys say what the light is, unless weather needs the time.
  const bool by_keys = !other_sky && !scene.request.own_irradiance && scene.request.sun.shines &&
                       (scene.request.sun.by_clock || !scene.original.light.weather);
  if (!model.sun) {
    root.erase("sun");
  } else if (other_sun) {
    root.insert_or_assign("sun", sun_table(scene.request.sun));
  }
  if (by_keys) return;
  fix_bands(root, model);
  if (!model.sky) {
    root.erase("sky");
  } else if (auto sky = sky_table(*model.sky)) {
    root.insert_or_assign("sky", std::move(*sky));
  }
}

toml::table by_band(const RadiationModel& model, const std::vector<double>& values) {
  toml::table table;
  for (std::size_t b = 0; b < model.bands.size(); ++b) table.insert_or_assign(model.bands[b].name, values[b]);
  return table;
}

toml::table face_table(const RadiationModel& model, const std::vector<FaceOptics>& face) {
  std::vector<double> reflectance, transmittance;
  for (const FaceOptics& optics : face) {
    reflectance.push_back(optics.reflectance);
    transmittance.push_back(optics.transmittance);
  }
  return toml::table{{"reflectance", by_band(model, reflectance)}, {"transmittance", by_band(model, transmittance)}};
}

toml::table& table_in(toml::table& root, std::string_view key) {
  return *root.insert(key, toml::table()).first->second.as_table();
}

void put_optics(toml::table& root, const SceneToSave& scene) {
  const LightRequest own = request_of(scene.original);
  const RadiationModel& model = scene.granted.model;
  for (std::size_t i = 0; i < own.optics.size(); ++i) {
    if (own.optics[i] == scene.request.optics[i]) continue;
    toml::table& table = table_in(table_in(root, "optics"), model.optics[i].name);
    erase(table, {"reflectance", "transmittance", "spectrum", "upper", "lower"});
    table.insert_or_assign("upper", face_table(model, model.optics[i].upper));
    table.insert_or_assign("lower", face_table(model, model.optics[i].lower));
  }
  if (own.soil_reflectance == scene.request.soil_reflectance) return;
  toml::table& soil = *root["soil"].as_table();
  erase(soil, {"reflectance", "spectrum"});
  soil.insert_or_assign("reflectance", by_band(model, scene.request.soil_reflectance));
}

}  // namespace

std::string saved_scene_text(const SceneToSave& scene) {
  toml::table root = *parse_toml(printable(scene.original.file.string()), scene.original.text);
  rename_files(root, scene.original);
  root.insert_or_assign("title", scene.granted.title);
  put_light(root, scene);
  put_optics(root, scene);
  toml::table& accuracy = table_in(root, "accuracy");
  accuracy.insert_or_assign("direct", scene.accuracy.direct);
  accuracy.insert_or_assign("indirect", scene.accuracy.indirect);
  std::ostringstream text;
  text << "# The scene of this result, as `sunfleck view` showed it.\n";
  if (scene.seed != 1) text << fmt::format("# Run it with --seed {}.\n", scene.seed);
  text << root << '\n';
  return text.str();
}

void save_scene(const SceneToSave& scene, const fs::path& folder) {
  const fs::path file = folder / saved_scene_file;
  std::error_code ignored;
  if (fs::equivalent(file, scene.original.file, ignored)) {
    throw_input(file.string(), "the window shows this scene, and would replace it", "give another folder with -o");
  }
  const std::string text = saved_scene_text(scene);
  for (const SourceFile& source : scene.original.files) {
    const fs::path name = name_in_scene_folder(scene.original, source.path);
    if (name.empty() || !fs::is_regular_file(source.path, ignored)) continue;
    const bool is_text = !is_mesh_file(scene.original.file) && fs::equivalent(source.path, scene.original.file, ignored);
    if (is_text) continue;
    const fs::path copy = folder / saved_scene_files / name;
    make_folder(copy.parent_path());
    std::error_code error;
    fs::copy_file(source.path, copy, fs::copy_options::overwrite_existing, error);
    if (error) throw_failure(copy.string(), error.message(), "check space and permissions, or give another folder with -o");
  }
  write_file(file, text);
}

}  // namespace sunfleck
