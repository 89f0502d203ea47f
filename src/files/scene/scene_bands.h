#pragma once
// Reads [[band]], or `bands`: the wavebands and their light.

#include "files/scene/scene_reader.h"
#include "files/scene/scene_sky.h"
#include "files/scene/scene_sun.h"
#include "files/scene/scene_weather.h"
#include "files/scene/toml_view.h"
#include "physics/light/spectrum.h"

#include <optional>
#include <string>
#include <vector>

namespace sunfleck {

// Names, wavelengths and photon units are in `bands`, whose irradiances are still 0; `lights` defines the sources of light.
struct BandsInput {
  std::vector<Waveband> bands;
  std::vector<BandLight> lights;  // [waveband]
  std::vector<double> per_w_m2;   // [waveband], what a number in the band's unit is divided by to give W m-2
};

// `spectrum` is that of the light, null for equal energy at all wavelengths. It shares the light of `bands` out to the bands,
// each named after its wavelengths, e.g. 400_410. Refuses a scene without bands, and light without the [sun], [sky] or
// [weather] that it needs.
[[nodiscard]] BandsInput read_bands(const TomlTable& root, const std::optional<SunInput>& sun,
                                    const std::optional<SkyInput>& sky, const std::optional<WeatherInput>& weather,
                                    const Spectrum* spectrum, std::vector<std::string>& warnings);

}  // namespace sunfleck
