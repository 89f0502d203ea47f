#pragma once
// Declarations shared by the exporters: their input, and one function per format.

#include "io/element_fields.h"
#include "io/exports.h"

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace sunfleck {

class NetcdfFile;

struct ExportData {
  const RunRecord& record;
  const RadiationModel& model;
  const RadiationResult& result;
  const ElementFields& fields;
  std::span<const ElementColour> colours;  // [element], or empty
};

// Return the bytes of the files. Throw Error (failure) if the canopy is too large for the format.
[[nodiscard]] std::string vtp_bytes(const ExportData& data);
[[nodiscard]] std::string ply_bytes(const ExportData& data);
[[nodiscard]] std::string glb_bytes(const ExportData& data);
[[nodiscard]] std::string netcdf_bytes(const ExportData& data);
[[nodiscard]] std::string caribu_csv(const ExportData& data);

// Returns the label of an element in CARIBU files, O PPPPP LLL EEE: the species (N for organs named leafN or stemN, 1 for names
// without a number, 0 for soil); the plant; the leaf (the rank, at least 1, for organs named leaf..., 000 for all others); and
// the number of the triangle in its organ, modulo 1000. Throws Error (failure) if a number has too many digits.
[[nodiscard]] std::string caribu_label(const Organ& organ, std::size_t number_in_organ);

// Returns the label of an element that its file already labelled, with only the plant replaced: other meshes or copies placed
// before it change the plant numbers.
[[nodiscard]] std::string caribu_label_as_read(const Organ& organ, std::uint64_t label);

// One entry of a run's record as text. The record holds the settings, not the device or the run time.
struct RecordEntry {
  std::string key;
  std::string value;  // valid UTF-8, one line
};
[[nodiscard]] std::vector<RecordEntry> record_entries(const RunRecord& record, const RadiationModel& model);

// Adds the record to a netCDF file as attributes; `command` is run or day.
void add_record(NetcdfFile& file, std::string_view command, const RunRecord& record, const RadiationModel& model);

// Returns the text as one line of valid UTF-8, which most formats require of names; replaces offending characters by '?'.
[[nodiscard]] std::string clean_text(std::string_view text);

// Append the bytes of values for formats with little-endian numbers.
template <class T>
void append_bytes(std::string& bytes, std::span<const T> values) {
  bytes.append(reinterpret_cast<const char*>(values.data()), values.size_bytes());
}
template <class T>
void append_bytes(std::string& bytes, const T& value) {
  static_assert(std::is_trivially_copyable_v<T>);
  bytes.append(reinterpret_cast<const char*>(&value), sizeof(T));
}

}  // namespace sunfleck
