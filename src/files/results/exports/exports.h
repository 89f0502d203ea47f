#pragma once
// Exports results to other programs: every format has the same fields of each triangle, with units and the record of the run.
// An exported file depends only on scene and seed; it names neither device nor time. Every file is written aside and renamed.

#include "files/results/exports/export_data.h"
#include "files/results/tables/result_writer.h"
#include "physics/transport/model/model.h"
#include "physics/transport/model/result.h"

#include <array>
#include <filesystem>
#include <span>

namespace sunfleck {

// csv     triangles.csv  the table
// nc      results.nc     netCDF-4 with CF 1.8 attributes (xarray, R): the fields by triangle, the corners, the band balances
// vtp     canopy.vtp     VTK PolyData (ParaView): the fields by cell, the record as field data
// glb     canopy.glb     binary glTF (Blender): a node for each organ under the node `canopy`; the fields of each triangle at
//                        its three vertices, as _TRIANGLE, _AREA_M2 and _BAND_DIRECT_UPPER ... _BAND_ABSORBED_ERROR (-1: none)
// ply     canopy.ply     binary PLY (MeshLab, CloudCompare): the fields of each triangle at its three vertices
// caribu  caribu.csv     CARIBU's table of polygons: band, index, label, area, Eabs, Ei, Ei_sup, Ei_inf
enum class ExportKind { csv, nc, vtp, glb, ply, caribu };

constexpr std::array<ExportKind, 6> export_kinds = {ExportKind::csv, ExportKind::nc,  ExportKind::vtp,
                                                    ExportKind::glb, ExportKind::ply, ExportKind::caribu};

[[nodiscard]] const char* export_name(ExportKind kind);  // as in --export
[[nodiscard]] const char* export_file(ExportKind kind);

// Writes the file into an existing folder. `colours` ([element], may be empty) are used by canopy.glb and canopy.ply. Throws
// Error (failure) if it cannot be written or the canopy is too large for the format.
void write_export(ExportKind kind, const std::filesystem::path& folder, const RunRecord& record, const RadiationModel& model,
                  const RadiationResult& result, std::span<const ElementColour> colours = {});

}  // namespace sunfleck
