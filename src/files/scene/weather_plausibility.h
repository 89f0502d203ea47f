#pragma once
// Warns about weather that does not follow the sun.

#include "physics/light/sun.h"
#include "physics/light/weather.h"

#include <optional>
#include <string>
#include <vector>

namespace sunfleck {

// Returns warnings about measured intervals at a place; `where` begins each. A file's light is correlated with the sine of the
// sun's elevation, moved by -12 to 12 hours, and at the place with latitude and longitude exchanged; a clearly better fit is
// reported. So are intervals of more than two hours, and light below 5 W m-2 in all of them with the sun above 20 degrees.
// Otherwise warns of light at night and of more light than the limits of physically possible values of Long and Dutton (2002):
// direct normal the light outside the atmosphere S, global 1.5 S sin(elevation)^1.2 + 100 W m-2, diffuse 0.95 S
// sin(elevation)^1.2 + 50 W m-2; means over half an hour and more have a global limit of S sin(elevation) + 50 W m-2. Looks at
// no more than 1000 intervals, in whole days.
[[nodiscard]] std::vector<std::string> weather_warnings(const Weather& weather, const Place& place, const std::string& where);

// Returns the same about the irradiance of one moment that the scene states. `day` may be empty: mean distance of the sun.
[[nodiscard]] std::vector<std::string> moment_warnings(const WeatherInterval& moment, const SunPosition& sun,
                                                       std::optional<int> day, const std::string& where);

}  // namespace sunfleck
