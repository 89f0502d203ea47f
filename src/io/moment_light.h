#pragma once
// The light of one moment: what a scene says of sun, sky and weather, made into numbers for the model.

#include "io/scene_reader.h"

namespace sunfleck {

struct MomentLight {
  SunPosition sun;              // means nothing for a scene without [sun]
  std::vector<Waveband> bands;  // [waveband], as in RadiationModel
  std::optional<SkyModel> sky;  // as in RadiationModel
};

// Under a sun that stands anywhere, which a scene with weather must have (EXPECT); `time` is the weather's, none where the
// scene has none. Otherwise as light_at.
[[nodiscard]] MomentLight light_under(const Scene& scene, const std::optional<SunPosition>& sun,
                                      const std::optional<UtcTime>& time);

// At another time than the scene's own, which must have a time and place (EXPECT). With the sun at or below the horizon there
// is no beam; sky light is what the scene or its weather says. Throws Error (input), naming the time, where the weather has
// nothing for it.
[[nodiscard]] MomentLight light_at(const Scene& scene, const UtcTime& time);

// At the scene's own moment, or for its own angles of the sun.
[[nodiscard]] MomentLight light_of(const Scene& scene);

// Throws Error (input) if the scene does not say how its light changes over a day: it needs a place, [weather] or
// direct_normal; a fixed `direct`, and weather of one moment's global irradiance, have no course.
void check_day(const Scene& scene);

}  // namespace sunfleck
