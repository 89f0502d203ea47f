#pragma once
// Reads [sky], the distribution of diffuse light over the hemisphere.

#include "files/scene/scene_reader.h"
#include "files/scene/scene_sun.h"
#include "files/scene/scene_weather.h"
#include "files/scene/toml_view.h"
#include "physics/light/sky_model.h"

#include <filesystem>
#include <optional>

namespace sunfleck {

struct SkyInput {
  SkyModel model;
  bool from_weather = false;  // perez without dni and dhi
};

// Returns nothing for a scene without [sky].
[[nodiscard]] std::optional<SkyInput> read_sky(const TomlTable& root, const std::filesystem::path& scene_file,
                                               const SceneAccess& access, const std::optional<SunInput>& sun,
                                               const std::optional<WeatherInput>& weather);

}  // namespace sunfleck
