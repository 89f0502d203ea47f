#include "files/results/exports/vtp_writer.h"

#include "base/byte_text.h"
#include "base/check.h"
#include "base/file.h"
#include "files/results/exports/record_entries.h"

#include <fmt/format.h>

#include <iterator>

namespace sunfleck {
namespace {

std::string escaped(std::string_view text) {
  std::string safe;
  for (const char c : text) {
    switch (c) {
      case '&':
        safe += "&amp;";
        break;
      case '<':
        safe += "&lt;";
        break;
      case '>':
        safe += "&gt;";
        break;
      case '"':
        safe += "&quot;";
        break;
      default:
        safe += c;
    }
  }
  return safe;
}

template <class T>
constexpr const char* type_name = nullptr;
template <>
constexpr const char* type_name<float> = "Float32";
template <>
constexpr const char* type_name<double> = "Float64";
template <>
constexpr const char* type_name<std::int32_t> = "Int32";
template <>
constexpr const char* type_name<std::uint32_t> = "UInt32";
template <>
constexpr const char* type_name<std::int64_t> = "Int64";

// Writes VTK's XML format, version 1.0, with raw appended numbers: the size in bytes precedes each array.
class VtpWriter {
 public:
  explicit VtpWriter(const ExportData& data) : data_(data) {}

  std::string take() {
    const std::size_t count = data_.fields.size();
    xml_ +=
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" "
        "header_type=\"UInt64\">\n<PolyData>\n<FieldData>\n";
    for (const RecordEntry& entry : record_entries(data_.record, data_.model)) add_texts(entry.key, {entry.value});
    add_texts("organ_names", data_.fields.organ_names);
    add_texts("optics_names", data_.fields.optics_names);
    xml_ += "</FieldData>\n";
    xml_ += fmt::format(
        "<Piece NumberOfPoints=\"{}\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\"{}\">\n",
        3 * count, count);
    add_cells();
    xml_ += "<Points>\n";
    if (corners_fit_float(data_.model)) {
      add_array<float>("corners", "m", 3, points<float>());
    } else {
      add_array<double>("corners", "m", 3, points<double>());
    }
    xml_ += "</Points>\n<Polys>\n";
    add_array<std::int64_t>("connectivity", "", 1, counted(3 * count, 0, 1));
    add_array<std::int64_t>("offsets", "", 1, counted(count, 3, 3));
    xml_ += "</Polys>\n</Piece>\n</PolyData>\n<AppendedData encoding=\"raw\">\n_";
    xml_ += appended_;
    xml_ += "\n</AppendedData>\n</VTKFile>\n";
    return std::move(xml_);
  }

 private:
  // Writes texts as character codes, each text ended by 0, so that no character of a name can break the file.
  void add_texts(std::string_view name, const std::vector<std::string>& texts) {
    xml_ +=
        fmt::format("<Array type=\"String\" Name=\"{}\" NumberOfTuples=\"{}\" format=\"ascii\">", escaped(name), texts.size());
    for (const std::string& text : texts) {
      for (const char c : printable(text)) fmt::format_to(std::back_inserter(xml_), "{} ", static_cast<unsigned char>(c));
      xml_ += "0 ";
    }
    xml_ += "</Array>\n";
  }

  template <class T>
  void add_array(std::string_view name, std::string_view unit, int components, std::span<const T> values) {
    xml_ += fmt::format("<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"appended\" offset=\"{}\"",
                        type_name<T>, escaped(name), components, appended_.size());
    if (unit.empty()) {
      xml_ += "/>\n";
    } else {
      xml_ += fmt::format(
          ">\n<InformationKey name=\"UNITS_LABEL\" location=\"vtkDataArray\">{}</InformationKey>\n</DataArray>\n", unit);
    }
    append_bytes(appended_, static_cast<std::uint64_t>(values.size_bytes()));
    append_bytes(appended_, values);
  }
  template <class T>
  void add_array(std::string_view name, std::string_view unit, int components, const std::vector<T>& values) {
    add_array(name, unit, components, std::span<const T>(values));
  }

  struct AddCells {
    VtpWriter& writer;
    const Column& column;

    void operator()(const RowNumbers& numbers) const {
      writer.add_array(column.name, column.unit, 1, counted(numbers.count, 0, 1));
    }
    void operator()(std::span<const std::string> texts) const { EXPECT(texts.size(), ==, std::size_t{0}); }
    void operator()(const auto& numbers) const { writer.add_array(column.name, column.unit, 1, numbers); }
  };

  void add_cells() {
    xml_ += "<CellData>\n";
    for (const Column& column : triangles_table(data_.fields).columns) {
      if (column.is_in(in_meshes)) std::visit(AddCells{*this, column}, column.values);
    }
    xml_ += "</CellData>\n";
  }

  template <class T>
  [[nodiscard]] std::vector<T> points() const {
    std::vector<T> values;
    values.reserve(9 * data_.fields.size());
    for (std::size_t e = 0; e < data_.fields.size(); ++e) {
      for (std::size_t k = 0; k < 3; ++k) {
        const glm::dvec3 corner = corner_m(data_.model, e, k);
        for (int axis = 0; axis < 3; ++axis) values.push_back(static_cast<T>(corner[axis]));
      }
    }
    return values;
  }

  static std::vector<std::int64_t> counted(std::size_t count, std::int64_t first, std::int64_t step) {
    std::vector<std::int64_t> values;
    values.reserve(count);
    for (std::size_t i = 0; i < count; ++i) values.push_back(first + step * static_cast<std::int64_t>(i));
    return values;
  }

  const ExportData& data_;
  std::string xml_, appended_;
};

}  // namespace

std::string vtp_bytes(const ExportData& data) {
  return VtpWriter(data).take();
}

}  // namespace sunfleck
