#include "files/results/exports/exports.h"

#include "base/check.h"
#include "base/file.h"
#include "files/results/exports/caribu_writer.h"
#include "files/results/exports/glb_writer.h"
#include "files/results/exports/netcdf_writer.h"
#include "files/results/exports/ply_writer.h"
#include "files/results/exports/vtp_writer.h"
#include "files/results/tables/element_fields.h"
#include "files/results/tables/table_text.h"

namespace sunfleck {
namespace {

struct ExportFormat {
  const char* name;
  const char* file;
  std::string (*bytes)(const ExportData& data);
};

std::string triangles_csv(const ExportData& data) {
  return csv_text(data.record, triangles_table(data.fields));
}

// [ExportKind]
constexpr std::array<ExportFormat, export_kinds.size()> formats = {{{"csv", "triangles.csv", triangles_csv},
                                                                    {"nc", "results.nc", netcdf_bytes},
                                                                    {"vtp", "canopy.vtp", vtp_bytes},
                                                                    {"glb", "canopy.glb", glb_bytes},
                                                                    {"ply", "canopy.ply", ply_bytes},
                                                                    {"caribu", "caribu.csv", caribu_csv}}};

const ExportFormat& format_of(ExportKind kind) {
  return formats[static_cast<std::size_t>(kind)];
}

}  // namespace

const char* export_name(ExportKind kind) {
  return format_of(kind).name;
}

const char* export_file(ExportKind kind) {
  return format_of(kind).file;
}

void write_export(ExportKind kind, const std::filesystem::path& folder, const RunRecord& record, const RadiationModel& model,
                  const RadiationResult& result, std::span<const ElementColour> colours) {
  if (!colours.empty()) EXPECT(colours.size(), ==, model.canopy.size());
  const ElementFields fields = make_element_fields(model, result);
  write_file(folder / export_file(kind), format_of(kind).bytes({record, model, result, fields, colours}));
}

}  // namespace sunfleck
