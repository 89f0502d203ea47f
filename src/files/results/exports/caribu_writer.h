#pragma once
// Writes caribu.csv, the table of polygons of CARIBU.

#include "files/results/exports/export_data.h"

#include <string>

namespace sunfleck {

// Returns the bytes of the file. Throws Error (failure) if a plant or leaf has a number that no label can hold.
[[nodiscard]] std::string caribu_csv(const ExportData& data);

}  // namespace sunfleck
