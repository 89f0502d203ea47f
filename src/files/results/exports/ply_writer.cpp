#include "files/results/exports/ply_writer.h"

#include "base/byte_text.h"
#include "base/error.h"
#include "base/file.h"
#include "files/results/exports/record_entries.h"

#include <fmt/format.h>

#include <limits>

namespace sunfleck {
namespace {

struct TypeName {
  const char* operator()(const RowNumbers&) const { return "uint"; }
  const char* operator()(std::span<const std::uint32_t>) const { return "uint"; }
  const char* operator()(std::span<const std::int32_t>) const { return "int"; }
  const char* operator()(std::span<const double>) const { return "double"; }
  const char* operator()(std::span<const std::string>) const { return ""; }
};

std::vector<Column> columns_of(const ElementFields& fields) {
  std::vector<Column> columns = triangles_table(fields).columns;
  std::erase_if(columns, [](const Column& column) { return !column.is_in(in_meshes); });
  return columns;
}

std::string header_of(const ExportData& data, const std::vector<Column>& columns, const char* coordinate) {
  const ElementFields& fields = data.fields;
  std::string text = "ply\nformat binary_little_endian 1.0\n";
  for (const RecordEntry& entry : record_entries(data.record, data.model)) {
    text += fmt::format("comment {}: {}\n", entry.key, entry.value);
  }
  text += "comment Each triangle has three vertices of its own, which carry its values.\n";
  for (std::size_t i = 0; i < fields.organ_names.size(); ++i) {
    text += fmt::format("comment organ {}: {}\n", i, printable(fields.organ_names[i]));
  }
  for (std::size_t i = 0; i < fields.optics_names.size(); ++i) {
    text += fmt::format("comment optics {}: {}\n", i, printable(fields.optics_names[i]));
  }
  text += "comment x, y, z: m\n";
  for (const Column& column : columns) {
    if (column.name == "area_m2") text += fmt::format("comment {}: {}\n", column.name, column.unit);
    if (is_light(column)) text += fmt::format("comment {}: {}, {}\n", column.name, column.unit, column.meaning);
  }
  text += fmt::format("element vertex {}\n", 3 * fields.size());
  for (const char axis : {'x', 'y', 'z'}) text += fmt::format("property {} {}\n", coordinate, axis);
  if (!data.colours.empty()) text += "property uchar red\nproperty uchar green\nproperty uchar blue\n";
  for (const Column& column : columns)
    text += fmt::format("property {} {}\n", std::visit(TypeName{}, column.values), column.name);
  return text + fmt::format("element face {}\nproperty list uchar int vertex_indices\nend_header\n", fields.size());
}

void append_corner(std::string& bytes, const ExportData& data, std::size_t element, std::size_t corner) {
  const glm::dvec3 position = corner_m(data.model, element, corner);
  if (corners_fit_float(data.model)) {
    append_bytes(bytes, glm::vec3(position));
  } else {
    append_bytes(bytes, position);
  }
}

struct AppendValue {
  std::string& bytes;
  std::size_t element;

  void operator()(const RowNumbers&) const { append_bytes(bytes, static_cast<std::uint32_t>(element)); }
  void operator()(std::span<const std::string>) const {}
  void operator()(const auto& numbers) const { append_bytes(bytes, numbers[element]); }
};

void append_values(std::string& bytes, const ExportData& data, const std::vector<Column>& columns, std::size_t element) {
  if (!data.colours.empty()) append_bytes(bytes, data.colours[element].srgb);
  for (const Column& column : columns) std::visit(AppendValue{bytes, element}, column.values);
}

}  // namespace

// Stores the values at the vertices, because CloudCompare and meshio read no values of faces.
std::string ply_bytes(const ExportData& data) {
  const std::size_t count = data.fields.size();
  constexpr std::size_t most_triangles = std::numeric_limits<std::int32_t>::max() / 3;
  if (count > most_triangles) {
    throw_failure(fmt::format("canopy.ply: {} triangles", count),
                  fmt::format("its vertex numbers suffice for at most {}", most_triangles), "export vtp or nc");
  }
  const std::vector<Column> columns = columns_of(data.fields);
  std::string bytes = header_of(data, columns, corners_fit_float(data.model) ? "float" : "double");
  std::string values;
  for (std::size_t e = 0; e < count; ++e) {
    values.clear();
    append_values(values, data, columns, e);
    for (std::size_t k = 0; k < 3; ++k) {
      append_corner(bytes, data, e, k);
      bytes += values;
    }
  }
  for (std::size_t e = 0; e < count; ++e) {
    const auto first = static_cast<std::int32_t>(3 * e);
    bytes += static_cast<char>(3);
    append_bytes(bytes, std::array{first, first + 1, first + 2});
  }
  return bytes;
}

}  // namespace sunfleck
