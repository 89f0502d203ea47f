#pragma once
// Writes results.nc, netCDF-4 with CF 1.8 attributes.

#include "files/results/exports/export_data.h"
#include "files/results/exports/netcdf_file.h"

#include <string>
#include <string_view>

namespace sunfleck {

// Returns the bytes of the file. Throws Error (failure) if the netCDF library fails.
[[nodiscard]] std::string netcdf_bytes(const ExportData& data);

// Adds the record to a netCDF file as attributes; `command` is run or day.
void add_record(NetcdfFile& file, std::string_view command, const RunRecord& record, const RadiationModel& model);

// Adds a column of kinds, such as the organ of each triangle: their numbers, with the names as flags (CF 1.8, section 3.5), and the
// variable COLUMN_name, which holds the names as they are.
void add_kinds(NetcdfFile& file, Column kinds, int dimension);

}  // namespace sunfleck
