#pragma once
// Writes long rows of single-precision variables into a netCDF-4 file whose definitions are complete. HDF5, the library below
// netCDF, stores them as chunks that all threads have compressed; netCDF itself would compress one chunk after the other.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace sunfleck {

class NetcdfRows {
 public:
  // `name` is for messages. The variables have `columns` values in a row, and NetcdfFile::store_by_rows has laid them out for one
  // row at a time. Throws Error (failure), as all functions here do.
  NetcdfRows(std::string name, const std::filesystem::path& file, std::span<const std::string> variables, std::size_t columns);
  ~NetcdfRows();
  NetcdfRows(const NetcdfRows&) = delete;
  NetcdfRows& operator=(const NetcdfRows&) = delete;

  // Writes that row of all variables, [variable * columns + column].
  void put(std::size_t row, std::span<const float> values);

  // Completes the file; no other call may follow.
  void finish();

 private:
  void check(bool good);
  [[nodiscard]] std::vector<std::uint8_t> packed(std::span<const float> values) const;

  std::string name_;
  std::size_t columns_, chunk_;
  std::int64_t file_ = -1;
  std::vector<std::int64_t> variables_;
  bool broken_ = false;  // a call failed, so the library must not be called again with this file
};

}  // namespace sunfleck
