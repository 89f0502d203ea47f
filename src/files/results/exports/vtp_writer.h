#pragma once
// Writes canopy.vtp, VTK PolyData.

#include "files/results/exports/export_data.h"

#include <string>

namespace sunfleck {

// Returns the bytes of the file.
[[nodiscard]] std::string vtp_bytes(const ExportData& data);

}  // namespace sunfleck
