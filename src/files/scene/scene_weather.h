#pragma once
// Reads [weather]: the broadband irradiance of one moment, of a file, or of a clear sky.

#include "files/scene/scene_reader.h"
#include "files/scene/scene_sun.h"
#include "files/scene/toml_view.h"
#include "physics/light/weather.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace sunfleck {

struct WeatherInput {
  Weather weather;
  TomlTable table;

  // Returns whether the weather may have diffuse light at some time.
  [[nodiscard]] bool may_be_diffuse() const;
};

// Returns nothing for a scene without [weather].
[[nodiscard]] std::optional<WeatherInput> read_weather_table(const TomlTable& root, const std::filesystem::path& scene_file,
                                                             const SceneAccess& access, const std::optional<SunInput>& sun,
                                                             std::vector<std::string>& warnings);

}  // namespace sunfleck
