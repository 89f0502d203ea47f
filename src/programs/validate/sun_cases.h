#pragma once
// Compares sun positions, sunrise and sunset, and the split of measured irradiance with known answers.

#include "programs/validate/case_bench.h"

namespace sunfleck {

// Adds rows that compare positions of the sun with NREL's Solar Position Algorithm (Reda and Andreas 2004).
void sun_position_cases(CaseBench& bench);

// Adds rows about sunrise, transit and sunset.
void sun_event_cases(CaseBench& bench);

// Adds rows about the split of measured irradiance into beam and sky light.
void weather_cases(CaseBench& bench);

}  // namespace sunfleck
