#include "files/results/exports/netcdf_file.h"

#include "base/check.h"
#include "base/error.h"
#include "base/file.h"
#include "base/text.h"
#include "files/results/exports/netcdf_library.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <limits>
#include <memory>
#include <numeric>
#include <utility>

namespace sunfleck {
namespace {

template <class T>
constexpr int type_number = 0;
template <>
constexpr int type_number<std::int32_t> = NC_INT;
template <>
constexpr int type_number<std::int64_t> = NC_INT64;
template <>
constexpr int type_number<float> = NC_FLOAT;
template <>
constexpr int type_number<double> = NC_DOUBLE;

}  // namespace

NetcdfFile::NetcdfFile(std::string name) : lock_(netcdf_mutex()), name_(std::move(name)) {
  constexpr std::size_t first_bytes = std::size_t{1} << 20;
  check(FROM_NETCDF(nc_create_mem)(name_.c_str(), NC_NETCDF4, first_bytes, &file_), "it cannot be created");
}

NetcdfFile::NetcdfFile(std::string name, const std::filesystem::path& file)
    : lock_(netcdf_mutex()), name_(std::move(name)), on_disk_(true) {
  errno = 0;
  check(FROM_NETCDF(nc_create)(file.c_str(), NC_NETCDF4 | NC_CLOBBER, &file_), "it cannot be created");
}

NetcdfFile::~NetcdfFile() {
  if (file_ >= 0 && !broken_) FROM_NETCDF(nc_abort)(file_);
}

void NetcdfFile::check(int status, std::string_view what) {
  if (status == NC_NOERR) return;
  const int reason = errno;
  if (!std::exchange(broken_, true)) leave_before_libraries();
  if (!on_disk_) throw_failure(fmt::format("{}: {}", name_, what), FROM_NETCDF(nc_strerror)(status), "export vtp or csv");
  // HDF5, below netCDF, reports only that a write failed; errno still holds the reason.
  throw_write_failure(fmt::format("{}: {}", name_, what), status == NC_EHDFERR ? reason : 0, FROM_NETCDF(nc_strerror)(status));
}

int NetcdfFile::dimension(const std::string& name, std::size_t size) {
  int number = -1;
  check(FROM_NETCDF(nc_def_dim)(file_, name.c_str(), size, &number), fmt::format("dimension {}", name));
  return number;
}

int NetcdfFile::define(const std::string& name, int type, const std::vector<int>& dimensions) {
  const std::string what = fmt::format("variable {}", name);
  int number = -1;
  check(FROM_NETCDF(nc_def_var)(file_, name.c_str(), type, static_cast<int>(dimensions.size()), dimensions.data(), &number),
        what);
  constexpr int deflate_level = 2;
  if (!dimensions.empty()) check(FROM_NETCDF(nc_def_var_deflate)(file_, number, 1, 1, deflate_level), what);
  return number;
}

// CF 1.8 (section 2.5.1) allows no missing values in coordinates, nor in their bounds.
bool NetcdfFile::is_coordinate(const std::string& name) const {
  int number = -1;
  return name.ends_with("_bounds") || FROM_NETCDF(nc_inq_dimid)(file_, name.c_str(), &number) == NC_NOERR;
}

template <class T>
int NetcdfFile::variable(const std::string& name, const std::vector<int>& dimensions, std::string_view units,
                         std::string_view meaning) {
  const int number = define(name, type_number<T>, dimensions);
  if (std::is_floating_point_v<T> && !is_coordinate(name)) {
    const T missing = std::numeric_limits<T>::quiet_NaN();
    check(FROM_NETCDF(nc_def_var_fill)(file_, number, NC_FILL, &missing), fmt::format("variable {}", name));
  }
  if (!meaning.empty()) attribute(number, "long_name", meaning);
  if (!units.empty()) attribute(number, "units", units);
  return number;
}

void NetcdfFile::attribute(int variable, const std::string& name, std::string_view text) {
  check(FROM_NETCDF(nc_put_att_text)(file_, variable, name.c_str(), text.size(), text.data()),
        fmt::format("attribute {}", name));
}

void NetcdfFile::attribute(int variable, const std::string& name, std::span<const std::int32_t> numbers) {
  check(FROM_NETCDF(nc_put_att_int)(file_, variable, name.c_str(), NC_INT, numbers.size(), numbers.data()),
        fmt::format("attribute {}", name));
}

void NetcdfFile::put_all(int variable, const void* values) {
  check(FROM_NETCDF(nc_put_var)(file_, variable, values), "its values cannot be written");
}

int NetcdfFile::variable(const Column& column, const std::vector<int>& dimensions) {
  const auto define_as = [&]<class T>(T) {
    const int number = variable<T>(column.name, dimensions, column.unit, column.meaning);
    if (!column.error_column.empty()) attribute(number, "ancillary_variables", column.error_column);
    return number;
  };
  if (std::holds_alternative<std::span<const double>>(column.values)) return define_as(double{});
  if (std::holds_alternative<std::span<const std::int32_t>>(column.values)) return define_as(std::int32_t{});
  return define_as(std::int64_t{});
}

void NetcdfFile::put(int variable, const Column& column) {
  struct Put {
    NetcdfFile& file;
    int variable;
    void operator()(std::span<const double> numbers) const { file.put(variable, numbers); }
    void operator()(std::span<const std::int32_t> numbers) const { file.put(variable, numbers); }
    void operator()(std::span<const std::uint32_t> numbers) const { put_wide({numbers.begin(), numbers.end()}); }
    void operator()(const RowNumbers& numbers) const {
      std::vector<std::int64_t> wide(numbers.count);
      std::iota(wide.begin(), wide.end(), 0);
      put_wide(wide);
    }
    void operator()(std::span<const std::string> texts) const { EXPECT(texts.size(), ==, std::size_t{0}); }
    void put_wide(const std::vector<std::int64_t>& wide) const { file.put(variable, std::span(wide)); }
  };
  std::visit(Put{*this, variable}, column.values);
}

int NetcdfFile::add(const Column& column, const std::vector<int>& dimensions) {
  const int number = variable(column, dimensions);
  put(number, column);
  return number;
}

std::vector<std::size_t> NetcdfFile::shape_of(int variable) {
  int count = 0;
  check(FROM_NETCDF(nc_inq_varndims)(file_, variable, &count), "its dimensions cannot be read");
  std::vector<int> dimensions(static_cast<std::size_t>(count));
  check(FROM_NETCDF(nc_inq_vardimid)(file_, variable, dimensions.data()), "its dimensions cannot be read");
  std::vector<std::size_t> shape(dimensions.size());
  for (std::size_t i = 0; i < shape.size(); ++i)
    check(FROM_NETCDF(nc_inq_dimlen)(file_, dimensions[i], &shape[i]), "its dimensions cannot be read");
  return shape;
}

void NetcdfFile::store_by_rows(int variable, std::size_t rows_at_once) {
  std::vector<std::size_t> chunk = shape_of(variable);
  std::size_t values = 1;
  for (std::size_t i = chunk.size(); i-- > 0;) {
    if (i == 0) chunk[i] = std::min(chunk[i], rows_at_once);
    chunk[i] = std::clamp<std::size_t>(chunk[i], 1, std::max<std::size_t>(1, longest_chunk / values));
    values *= chunk[i];
  }
  check(FROM_NETCDF(nc_def_var_chunking)(file_, variable, NC_CHUNKED, chunk.data()), "its layout cannot be set");
  // put_rows writes whole chunks, so that there is no use in keeping many of them.
  constexpr std::size_t cache_bytes = std::size_t{1} << 20, slots = 521;
  check(FROM_NETCDF(nc_set_var_chunk_cache)(file_, variable, cache_bytes, slots, 1.0F), "its layout cannot be set");
}

void NetcdfFile::put_rows(int variable, std::size_t first, std::size_t rows, std::span<const float> values) {
  if (values.empty()) return;
  std::vector<std::size_t> count = shape_of(variable);
  std::vector<std::size_t> begin(count.size());
  begin.at(0) = first;
  count.at(0) = rows;
  check(FROM_NETCDF(nc_put_vara)(file_, variable, begin.data(), count.data(), values.data()), "its values cannot be written");
}

void NetcdfFile::names(const std::string& name, int dimension, std::span<const std::string> values, std::string_view meaning) {
  const auto is_plain = [](const std::string& value) { return std::all_of(value.begin(), value.end(), is_ascii); };
  if (!std::all_of(values.begin(), values.end(), is_plain)) return strings(name, dimension, values, meaning);
  std::size_t longest = 1;
  for (const std::string& value : values) longest = std::max(longest, value.size());
  const int length = this->dimension(name + "_length", longest);
  const int number = define(name, NC_CHAR, {dimension, length});
  attribute(number, "long_name", meaning);
  attribute(number, "_Encoding", "utf-8");
  std::string text;
  for (const std::string& value : values) {
    text += printable(value);
    text.resize(text.size() + longest - value.size());
  }
  if (!values.empty()) put_all(number, text.data());
}

void NetcdfFile::strings(const std::string& name, int dimension, std::span<const std::string> values,
                         std::string_view meaning) {
  std::vector<std::string> shown;
  for (const std::string& value : values) shown.push_back(printable(value));
  std::vector<const char*> texts;
  for (const std::string& text : shown) texts.push_back(text.c_str());
  int number = -1;
  check(FROM_NETCDF(nc_def_var)(file_, name.c_str(), NC_STRING, 1, &dimension, &number), fmt::format("variable {}", name));
  attribute(number, "long_name", meaning);
  put_all(number, texts.data());
}

std::string NetcdfFile::take() {
  NC_memio memory{};
  check(FROM_NETCDF(nc_close_memio)(std::exchange(file_, -1), &memory), "it cannot be finished");
  const std::unique_ptr<void, decltype(&std::free)> owner(memory.memory, &std::free);
  return {static_cast<const char*>(memory.memory), memory.size};
}

void NetcdfFile::finish() {
  check(FROM_NETCDF(nc_sync)(file_), "it cannot be finished");  // so that closing writes nothing more
  check(FROM_NETCDF(nc_close)(std::exchange(file_, -1)), "it cannot be finished");
}

template int NetcdfFile::variable<std::int32_t>(const std::string&, const std::vector<int>&, std::string_view,
                                                std::string_view);
template int NetcdfFile::variable<std::int64_t>(const std::string&, const std::vector<int>&, std::string_view,
                                                std::string_view);
template int NetcdfFile::variable<float>(const std::string&, const std::vector<int>&, std::string_view, std::string_view);
template int NetcdfFile::variable<double>(const std::string&, const std::vector<int>&, std::string_view, std::string_view);

void silence_hdf5() {
  const std::lock_guard lock(netcdf_mutex());
  FROM_NETCDF(H5Eset_auto2)(H5E_DEFAULT, nullptr, nullptr);
}

}  // namespace sunfleck
