#pragma once
// Writes canopy.glb, binary glTF.

#include "files/results/exports/export_data.h"

#include <string>

namespace sunfleck {

// Returns the bytes of the file. Throws Error (failure) if the canopy is too large for the format.
[[nodiscard]] std::string glb_bytes(const ExportData& data);

}  // namespace sunfleck
