#pragma once
// A netCDF-4 file in memory or on disk, written by the C library. While a thread has one, other threads wait for theirs.

#include "files/results/tables/table.h"

#include <cstdint>
#include <filesystem>
#include <mutex>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sunfleck {

class NetcdfFile {
 public:
  static constexpr std::size_t longest_chunk = std::size_t{1} << 18U;  // values, of variables that are stored by rows

  explicit NetcdfFile(std::string name);  // creates a file in memory; `name` is for messages
  NetcdfFile(std::string name, const std::filesystem::path& file);
  ~NetcdfFile();
  NetcdfFile(const NetcdfFile&) = delete;
  NetcdfFile& operator=(const NetcdfFile&) = delete;

  // Define a dimension or variable and return its number. Variables with dimensions are compressed (deflate 2 after shuffling);
  // NaN is the missing value of float and double variables, but for coordinates, which have the name of a dimension. They have
  // long_name and units unless these are empty.
  int dimension(const std::string& name, std::size_t size);
  template <class T>  // std::int32_t, std::int64_t, float or double
  int variable(const std::string& name, const std::vector<int>& dimensions, std::string_view units = {},
               std::string_view meaning = {});

  // Defines a variable for a column of numbers, which refers to that of its half-widths, if there is one. Row numbers and unsigned
  // numbers become std::int64_t.
  int variable(const Column& column, const std::vector<int>& dimensions);

  // Lays out a variable for writing by put_rows, that many rows at once. A row is an index of the first dimension.
  void store_by_rows(int variable, std::size_t rows_at_once = 1);

  // Adds an attribute to a variable, or to the file if the number is -1.
  void attribute(int variable, const std::string& name, std::string_view text);
  void attribute(int variable, const std::string& name, std::span<const std::int32_t> numbers);

  // Writes all values, of the type that the variable was defined with, the last dimension fastest.
  template <class T>
  void put(int variable, std::span<const T> values) {
    if (!values.empty()) put_all(variable, values.data());
  }
  void put(int variable, const Column& column);
  void put_rows(int variable, std::size_t first, std::size_t rows, std::span<const float> values);

  // Define a variable and write its values.
  int add(const Column& column, const std::vector<int>& dimensions);
  template <class T>
  int add(const std::string& name, const std::vector<int>& dimensions, std::string_view units, std::string_view meaning,
          const std::vector<T>& values) {
    const int number = variable<T>(name, dimensions, units, meaning);
    put(number, std::span<const T>(values));
    return number;
  }

  // Writes a variable of names, made printable: characters padded with zeros, `name`(dimension, name_length), or strings if a
  // name has a letter that is not ASCII, since readers take the bytes of such characters apart.
  void names(const std::string& name, int dimension, std::span<const std::string> values, std::string_view meaning);

  // Completes the file; no other call may follow. Use `take` for a file in memory and `finish` for one on disk.
  [[nodiscard]] std::string take();
  void finish();

 private:
  [[nodiscard]] std::vector<std::size_t> shape_of(int variable);
  [[nodiscard]] bool is_coordinate(const std::string& name) const;
  void strings(const std::string& name, int dimension, std::span<const std::string> values, std::string_view meaning);
  int define(const std::string& name, int type, const std::vector<int>& dimensions);
  void put_all(int variable, const void* values);
  void check(int status, std::string_view what);

  std::unique_lock<std::recursive_mutex> lock_;  // see netcdf_mutex
  std::string name_;
  bool on_disk_ = false;
  bool broken_ = false;  // a call failed, so the library must not be called again with this file
  int file_ = -1;
};

// Keeps HDF5, below netCDF, from printing what it reports to the calling thread. netCDF itself does so in the thread that calls it
// first.
void silence_hdf5();

}  // namespace sunfleck
