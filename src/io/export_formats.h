#pragma once
// What the exporters share: what they write, and one function a format.

#include "io/element_fields.h"
#include "io/exports.h"

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace sunfleck {

struct ExportData {
  const RunRecord& record;
  const RadiationModel& model;
  const RadiationResult& result;
  const ElementFields& fields;
  std::span<const ElementColour> colours;  // [element], or empty
};

// The files' bytes. Throws Error (failure) for a canopy too large for the format.
[[nodiscard]] std::string vtp_bytes(const ExportData& data);
[[nodiscard]] std::string ply_bytes(const ExportData& data);
[[nodiscard]] std::string glb_bytes(const ExportData& data);
[[nodiscard]] std::string netcdf_bytes(const ExportData& data);
[[nodiscard]] std::string caribu_csv(const ExportData& data);

// The label of an element in CARIBU's files, O PPPPP LLL EEE: O the species, from organs named leaf2, stem2, ... (1 for names
// without number, 0 for soil), plant, leaf (the rank, at least 1, of organs named leaf...; 000 of all others), and the
// triangle's number in its organ modulo 1000. Throws Error (failure) where a number has too many digits.
[[nodiscard]] std::string caribu_label(const Organ& organ, std::size_t number_in_organ);

// The same of an element whose file had this label: as it was, but for the plant, which other meshes or copies before it
// renumber.
[[nodiscard]] std::string caribu_label_as_read(const Organ& organ, std::uint64_t label);

// The record of a run as text: what it was asked for, not on what or how fast it ran.
struct RecordEntry {
  std::string key;
  std::string value;  // valid UTF-8, one line
};
[[nodiscard]] std::vector<RecordEntry> record_entries(const RunRecord& record, const RadiationModel& model);

// On one line and valid UTF-8, as most formats want their names; what breaks this becomes '?'.
[[nodiscard]] std::string clean_text(std::string_view text);

// Formats with little-endian numbers.
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
