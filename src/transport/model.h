#pragma once
// What is to be simulated, in SI units: the scene without its files.

#include "canopy/canopy.h"
#include "canopy/optics.h"
#include "canopy/plot.h"
#include "light/sky.h"
#include "light/sun.h"
#include "transport/receivers.h"

#include <optional>
#include <vector>

namespace sunfleck {

struct RadiationModel {
  Canopy canopy;
  Plot plot;
  std::vector<SurfaceOptics> optics;  // [optics number of canopy.optics_of]
  std::vector<Waveband> bands;        // [waveband]
  std::optional<Soil> soil;           // none: what falls through is transmitted
  std::optional<SunPosition> sun;     // none, or not above the horizon: no direct light
  std::optional<SkyModel> sky;        // none: no diffuse light
  std::vector<PlaneReceiver> planes;  // in ascending order of height
  std::vector<Sensor> sensors;
  int layers = 20;  // equal layers from the ground to the highest element

  [[nodiscard]] bool has_beam() const;  // the sun is above the horizon, and some band has light from it
  [[nodiscard]] bool has_sky() const;   // and some band has light from it
};

}  // namespace sunfleck
