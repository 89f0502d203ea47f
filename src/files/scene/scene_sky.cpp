#include "files/scene/scene_sky.h"

#include "files/formats/caribu/light_reader.h"
#include "files/formats/weather/weather_reader.h"
#include "files/scene/scene_files.h"

#include <fmt/format.h>

#include <string>
#include <vector>

namespace sunfleck {

namespace {

enum class Named { uniform, overcast, clear, cie, perez, lights };
const std::vector<std::string> sky_names = {"uniform", "cie-overcast", "cie-clear", "cie", "perez", "lights"};
void refuse_foreign(const TomlTable& table, Named model) {
  const auto refuse = [&](const char* key, Named owner) {
    if (model == owner || !table.has(key)) return;
    table.refuse(key, fmt::format("it is only for model = \"{}\"", sky_names[static_cast<std::size_t>(owner)]), "remove it");
  };
  refuse("type", Named::cie);
  refuse("dni", Named::perez);
  refuse("dhi", Named::perez);
  refuse("file", Named::lights);
}

void read_perez(const TomlTable& table, const std::optional<WeatherInput>& weather, SkyInput& input) {
  input.model.kind = SkyKind::all_weather;
  if (!table.has("dni") && !table.has("dhi") && weather) {
    input.from_weather = true;
    return;
  }
  const bool none = !table.has("dni") && !table.has("dhi");
  if (none) {
    table.refuse("model", "perez needs the broadband irradiance of the moment", "add dni and dhi in W m-2, or [weather]");
  }
  table.require("dni", "dni, the broadband direct normal irradiance in W m-2");
  table.require("dhi", "dhi, the broadband diffuse horizontal irradiance in W m-2");
  const NumberRange dni{.lo = 0.0, .hi = most_broadband_w_m2, .cure = "give W m-2 of all solar radiation"};
  NumberRange dhi = dni;
  dhi.lo_open = true;
  input.model.dni_w_m2 = *table.number("dni", dni);
  input.model.dhi_w_m2 = *table.number("dhi", dhi);
}

}  // namespace

std::optional<SkyInput> read_sky(const TomlTable& root, const std::filesystem::path& scene_file, const SceneAccess& access,
                                 const std::optional<SunInput>& sun, const std::optional<WeatherInput>& weather) {
  const auto table = root.table("sky");
  if (!table) return std::nullopt;
  table->allow({"model", "type", "dni", "dhi", "file"});
  table->require("model", "model = \"cie-overcast\"");
  const Named named = static_cast<Named>(*table->word("model", sky_names));
  refuse_foreign(*table, named);
  SkyInput input;
  switch (named) {
    case Named::uniform:
      input.model.kind = SkyKind::uniform;
      break;
    case Named::overcast:
      input.model.kind = SkyKind::overcast;
      break;
    case Named::clear:
      input.model.kind = SkyKind::general;
      input.model.cie_type = cie_clear_type;
      break;
    case Named::cie:
      table->require("type", "type = 12, or another of 1 to 15");
      input.model.kind = SkyKind::general;
      input.model.cie_type = static_cast<int>(*table->integer("type", 1, 15));
      break;
    case Named::perez:
      read_perez(*table, weather, input);
      break;
    case Named::lights:
      table->require("file", "file = \"sky.light\"");
      input.model.kind = SkyKind::lights;
      input.model.lights = read_lights(find_scene_file(*table, scene_file, access, "name a list of directions"), access.files);
      break;
  }
  if (!sun && input.model.follows_sun()) {
    table->refuse(table->has("type") ? "type" : "model", "this sky depends on the sun, but there is no [sun]",
                  "add [sun], or choose uniform or cie-overcast");
  }
  return input;
}

}  // namespace sunfleck
