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

}  // namespace sunfleck
