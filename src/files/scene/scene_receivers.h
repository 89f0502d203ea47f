#pragma once
// Reads [[plane]] and [[sensor]], the places where light is measured.

#include "files/scene/toml_view.h"
#include "physics/canopy/plot.h"
#include "physics/transport/model/receivers.h"

#include <vector>

namespace sunfleck {

// `plot.axes` are those of the numbers in the file.

// Returns the planes in ascending order of height.
[[nodiscard]] std::vector<PlaneReceiver> read_planes(const TomlTable& root, const Plot& plot);

// Returns the sensors in the order of the file; their names differ.
[[nodiscard]] std::vector<Sensor> read_sensors(const TomlTable& root, const Plot& plot);

}  // namespace sunfleck
