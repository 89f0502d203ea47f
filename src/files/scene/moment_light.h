#pragma once
// Computes the light of one moment: turns the sun, sky and weather of a scene into numbers for the model.

#include "files/scene/scene_reader.h"

#include <optional>
#include <vector>

namespace sunfleck {

struct MomentLight {
  SunPosition sun;              // meaningless for a scene without [sun]
  std::vector<Waveband> bands;  // [waveband], as in RadiationModel
  std::optional<SkyModel> sky;  // as in RadiationModel
};

// Returns the light for any position of the sun, which a scene with weather must have (EXPECT). `time` selects the weather; it
// is empty if the scene has no time. Otherwise as light_of_step.
[[nodiscard]] MomentLight light_under(const Scene& scene, const std::optional<SunPosition>& sun,
                                      const std::optional<UtcTime>& time);

// Returns the light of a step of this length; the scene must have a time and place (EXPECT). The sun is where it is at the middle,
// and the weather that of the step (weather_of_step). There is no beam while the sun is at or below the horizon; the scene
// or its weather defines the sky light. Throws Error (input), naming the time, if the weather has no data for the middle.
[[nodiscard]] MomentLight light_of_step(const Scene& scene, const UtcTime& middle, double length_s);

// Returns the light at a time as if none came from sun and sky; the scene must have a time and place (EXPECT).
[[nodiscard]] MomentLight light_at_night(const Scene& scene, const UtcTime& time);

// Returns the light at the scene's own time, or for its own sun angles.
[[nodiscard]] MomentLight light_of(const Scene& scene);

// Throws Error (input) unless the scene defines how its light changes over a day. It needs a place and either [weather] or
// direct_normal; a fixed `direct` and weather with the global irradiance of one moment do not change over a day.
void check_day(const Scene& scene);

}  // namespace sunfleck
