#include "io/exports.h"

#include "base/check.h"
#include "io/element_fields.h"
#include "io/export_formats.h"
#include "io/file.h"

#include <fmt/format.h>

#include <bit>

namespace sunfleck {
namespace {

static_assert(std::endian::native == std::endian::little, "append_bytes copies numbers as stored in memory");

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

std::string clean_text(std::string_view text) {
  return printable(text);
}

std::vector<RecordEntry> record_entries(const RunRecord& record, const RadiationModel& model) {
  std::vector<RecordEntry> entries = {{"title", clean_text(record.title)},
                                      {"sunfleck", clean_text(record.version)},
                                      {"commit", clean_text(record.commit)},
                                      {"scene_file", clean_text(record.scene_file)},
                                      {"scene_digest", clean_text(record.scene_digest)},
                                      {"seed", fmt::to_string(record.seed)},
                                      {"complete", record.complete ? "true" : "false"},
                                      {"direct_error", fmt::to_string(record.accuracy.direct)},
                                      {"indirect_error", fmt::to_string(record.accuracy.indirect)},
                                      {"confidence", fmt::to_string(record.accuracy.confidence)},
                                      {"of", error_target_name(record.accuracy.of)},
                                      {"plot_size_m", fmt::format("{} {}", model.plot.size_x_m, model.plot.size_z_m)},
                                      {"periodic", model.plot.periodic ? "true" : "false"},
                                      {"axes", "X south, Y up, Z west; m"}};
  if (record.grid_m) entries.push_back({"grid_m", fmt::to_string(*record.grid_m)});
  if (record.passes) entries.push_back({"passes", fmt::to_string(*record.passes)});
  if (record.max_rays) entries.push_back({"max_rays", fmt::to_string(*record.max_rays)});
  return entries;
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
