#pragma once
// The model to be simulated, in SI units: the scene without its files.

#include "physics/canopy/canopy.h"
#include "physics/canopy/optics.h"
#include "physics/canopy/plot.h"
#include "physics/light/sky_model.h"
#include "physics/light/sun.h"
#include "physics/transport/model/receivers.h"

#include <optional>
#include <vector>

namespace sunfleck {

struct RadiationModel {
  Canopy canopy;
  Plot plot;
  std::vector<SurfaceOptics> optics;  // [optics number of canopy.optics_of]
  std::vector<Waveband> bands;        // [waveband]
  std::optional<Soil> soil;           // without soil, light that falls through counts as transmitted
  std::optional<SunPosition> sun;     // without a sun, or with one that is not above the horizon, there is no direct light
  std::optional<SkyModel> sky;        // without a sky there is no diffuse light
  std::vector<PlaneReceiver> planes;  // ascending by height
  std::vector<Sensor> sensors;
  int layers = 20;  // equal layers from the ground to the highest element

  [[nodiscard]] bool has_beam() const;  // the sun is above the horizon, and some band has direct light
  [[nodiscard]] bool has_sky() const;   // there is a sky, and some band has diffuse light
};

}  // namespace sunfleck
