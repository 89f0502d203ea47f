#include "files/results/exports/exports.h"

#include "base/check.h"
#include "base/file.h"
#include "files/results/exports/caribu_writer.h"
#include "files/results/exports/glb_writer.h"
#include "files/results/exports/netcdf_writer.h"
#include "files/results/exports/ply_writer.h"
#include "files/results/exports/vtp_writer.h"
#include "files/results/tables/element_fields.h"

namespace sunfleck {
namespace {

std::string bytes_of(ExportKind kind, const ExportData& data) {
  switch (kind) {
    case ExportKind::csv:
      return triangles_csv(data.record, data.fields);
    case ExportKind::nc:
      return netcdf_bytes(data);
    case ExportKind::vtp:
      return vtp_bytes(data);
    case ExportKind::glb:
      return glb_bytes(data);
    case ExportKind::ply:
      return ply_bytes(data);
    case ExportKind::caribu:
      return caribu_csv(data);
  }
  return {};
}

}  // namespace

const char* export_name(ExportKind kind) {
  switch (kind) {
    case ExportKind::csv:
      return "csv";
    case ExportKind::nc:
      return "nc";
    case ExportKind::vtp:
      return "vtp";
    case ExportKind::glb:
      return "glb";
    case ExportKind::ply:
      return "ply";
    case ExportKind::caribu:
      return "caribu";
  }
  return "";
}

const char* export_file(ExportKind kind) {
  switch (kind) {
    case ExportKind::csv:
      return "triangles.csv";
    case ExportKind::nc:
      return "results.nc";
    case ExportKind::vtp:
      return "canopy.vtp";
    case ExportKind::glb:
      return "canopy.glb";
    case ExportKind::ply:
      return "canopy.ply";
    case ExportKind::caribu:
      return "caribu.csv";
  }
  return "";
}

std::optional<ExportKind> export_kind(std::string_view name) {
  for (const ExportKind kind : export_kinds) {
    if (name == export_name(kind)) return kind;
  }
  return std::nullopt;
}

void write_exports(std::span<const ExportKind> kinds, const std::filesystem::path& folder, const RunRecord& record,
                   const RadiationModel& model, const RadiationResult& result, std::span<const ElementColour> colours) {
  if (kinds.empty()) return;
  if (!colours.empty()) EXPECT(colours.size(), ==, model.canopy.size());
  const ElementFields fields = make_element_fields(model, result);
  for (const ExportKind kind : kinds) {
    write_file(folder / export_file(kind), bytes_of(kind, {record, model, result, fields, colours}));
  }
}

}  // namespace sunfleck
