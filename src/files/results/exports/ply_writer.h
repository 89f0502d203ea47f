#pragma once
// Writes canopy.ply, binary PLY.

#include "files/results/exports/export_data.h"

#include <string>

namespace sunfleck {

// Returns the bytes of the file. Throws Error (failure) if the canopy is too large for the format.
[[nodiscard]] std::string ply_bytes(const ExportData& data);

}  // namespace sunfleck
