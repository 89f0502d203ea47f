#pragma once
// Reads [[band]]: the wavebands and their light.

#include "files/scene/scene_reader.h"
#include "files/scene/scene_sky.h"
#include "files/scene/scene_sun.h"
#include "files/scene/scene_weather.h"
#include "files/scene/toml_view.h"

#include <optional>
#include <string>
#include <vector>

namespace sunfleck {

// Names and photon units are in `bands`, whose irradiances are still 0; `lights` defines the sources of light.
struct BandsInput {
  std::vector<Waveband> bands;
  std::vector<BandLight> lights;  // [waveband]
};

// Refuses a scene without bands, and light without the [sun], [sky] or [weather] that it needs.
[[nodiscard]] BandsInput read_bands(const TomlTable& root, const std::optional<SunInput>& sun,
                                    const std::optional<SkyInput>& sky, const std::optional<WeatherInput>& weather,
                                    std::vector<std::string>& warnings);

}  // namespace sunfleck
