#include "files/scene/scene_editor.h"

#include "base/error.h"
#include "files/scene/toml_parse.h"

#include <toml++/toml.h>

#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <sstream>
#include <string_view>
#include <utility>

namespace sunfleck {
namespace {

using NewName = std::function<std::optional<std::string>(const std::string&)>;

void rename(toml::node& node, const NewName& new_name) {
  if (toml::value<std::string>* text = node.as_string()) {
    if (const auto name = new_name(text->get())) *text = *name;
  } else if (toml::array* items = node.as_array()) {
    for (toml::node& item : *items) rename(item, new_name);
  } else if (toml::table* table = node.as_table()) {
    for (auto&& [key, item] : *table) {
      if (key.str() != "title" && key.str() != "name") rename(item, new_name);
    }
  }
}

void erase(toml::table& table, std::initializer_list<std::string_view> keys) {
  for (const std::string_view key : keys) table.erase(key);
}

toml::table& table_in(toml::table& root, std::string_view key) {
  return *root.insert(key, toml::table()).first->second.as_table();
}

// Returns nothing for a sky of listed directions.
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

// Writes out the bands that a scene gives by number or width.
void list_bands(toml::table& root, const RadiationModel& model) {
  if (!root.contains("bands")) return;
  root.erase("bands");
  toml::array all;
  for (const Waveband& band : model.bands) {
    all.push_back(toml::table{{"name", band.name}, {"range_nm", toml::array{band.from_nm, band.to_nm}}});
  }
  root.insert_or_assign("band", std::move(all));
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

}  // namespace

SceneEditor::SceneEditor(const Scene& scene)
    : root_(std::make_shared<toml::table>(*parse_toml(printable(scene.file.string()), scene.text))) {}

void SceneEditor::rename_files(const NewName& new_name) {
  rename(*root_, new_name);
}

void SceneEditor::set_title(const std::string& title) {
  root_->insert_or_assign("title", title);
}

void SceneEditor::set_accuracy(const Accuracy& accuracy) {
  toml::table& table = table_in(*root_, "accuracy");
  table.insert_or_assign("direct", accuracy.direct);
  table.insert_or_assign("indirect", accuracy.indirect);
}

void SceneEditor::set_sun_moment(const SunTime& moment) {
  constexpr double seconds_per_minute = 60.0;
  const UtcTime local = plus_seconds(moment.time, seconds_per_minute * moment.offset_minutes);
  const toml::date date(local.year, local.month, local.day);
  const toml::time time(local.hour, local.minute, static_cast<int>(std::lround(local.second)));
  toml::time_offset offset;
  offset.minutes = static_cast<std::int16_t>(moment.offset_minutes);
  root_->insert_or_assign("sun", toml::table{{"time", toml::date_time(date, time, offset)},
                                             {"latitude", moment.latitude_deg},
                                             {"longitude", moment.longitude_deg}});
}

void SceneEditor::set_sun_angles_deg(double elevation, double azimuth) {
  root_->insert_or_assign("sun", toml::table{{"elevation", elevation}, {"azimuth", azimuth}});
}

void SceneEditor::remove_sun() {
  root_->erase("sun");
}

void SceneEditor::set_light(const RadiationModel& model) {
  root_->erase("weather");
  list_bands(*root_, model);
  toml::array& bands = *(*root_)["band"].as_array();
  for (std::size_t b = 0; b < model.bands.size(); ++b) {
    toml::table& table = *bands[b].as_table();
    const Waveband& band = model.bands[b];
    erase(table, {"direct", "direct_normal", "diffuse", "share", "unit"});
    table.insert_or_assign("direct", band.direct_w_m2);
    table.insert_or_assign("diffuse", band.diffuse_w_m2);
    if (band.umol_per_joule > 0.0) table.insert_or_assign("umol_per_joule", band.umol_per_joule);
  }
  if (!model.sky) {
    root_->erase("sky");
  } else if (auto sky = sky_table(*model.sky)) {
    root_->insert_or_assign("sky", std::move(*sky));
  }
}

void SceneEditor::set_optics(const RadiationModel& model, std::size_t optics) {
  const SurfaceOptics& surface = model.optics[optics];
  toml::table& table = table_in(table_in(*root_, "optics"), surface.name);
  erase(table, {"reflectance", "transmittance", "spectrum", "upper", "lower"});
  table.insert_or_assign("upper", face_table(model, surface.upper));
  table.insert_or_assign("lower", face_table(model, surface.lower));
}

void SceneEditor::set_soil(const RadiationModel& model) {
  toml::table& soil = table_in(*root_, "soil");
  erase(soil, {"reflectance", "spectrum"});
  soil.insert_or_assign("reflectance", by_band(model, model.soil->reflectance));
}

std::string SceneEditor::text() const {
  std::ostringstream text;
  text << *root_;
  return text.str();
}

}  // namespace sunfleck
