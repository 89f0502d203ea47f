#include "files/results/exports/netcdf_rows.h"

#include "base/check.h"
#include "base/rounding.h"
#include "base/zlib_streams.h"
#include "files/results/exports/netcdf_file.h"
#include "files/results/exports/netcdf_library.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <utility>

namespace sunfleck {
namespace {

constexpr unsigned read_and_write = 0x0001U;  // H5F_ACC_RDWR, which calls functions of the library

// Returns all first bytes of the values, then all second ones, and so on, as the shuffle filter of HDF5 does.
std::vector<std::byte> shuffled(std::span<const float> values, std::size_t count) {
  const std::span<const std::byte> bytes = std::as_bytes(values);
  std::vector<std::byte> planes(sizeof(float) * count);
  for (std::size_t k = 0; k < sizeof(float); ++k) {
    for (std::size_t i = 0; i < values.size(); ++i) planes[k * count + i] = bytes[i * sizeof(float) + k];
  }
  return planes;
}

}  // namespace

NetcdfRows::NetcdfRows(std::string name, const std::filesystem::path& file, std::span<const std::string> variables,
                       std::size_t columns)
    : name_(std::move(name)), columns_(columns), chunk_(std::min(columns, NetcdfFile::longest_chunk)) {
  errno = 0;
  file_ = FROM_NETCDF(H5Fopen)(file.c_str(), read_and_write, H5P_DEFAULT);
  check(file_ >= 0);
  for (const std::string& variable : variables) {
    variables_.push_back(FROM_NETCDF(H5Dopen2)(file_, variable.c_str(), H5P_DEFAULT));
    check(variables_.back() >= 0);
  }
}

NetcdfRows::~NetcdfRows() {
  if (file_ < 0 || broken_) return;
  for (const std::int64_t variable : variables_) FROM_NETCDF(H5Dclose)(variable);
  FROM_NETCDF(H5Fclose)(file_);
}

void NetcdfRows::put(std::size_t row, std::span<const float> values) {
  EXPECT(values.size(), ==, variables_.size() * columns_);
  const std::size_t chunks = chunk_ > 0 ? block_count(columns_, chunk_) : 0;
  std::vector<std::vector<std::uint8_t>> all(variables_.size() * chunks);
  tbb::parallel_for(std::size_t{0}, all.size(), [&](std::size_t k) {
    const std::size_t begin = k % chunks * chunk_;
    all[k] = packed(values.subspan(k / chunks * columns_ + begin, std::min(chunk_, columns_ - begin)));
  });
  for (std::size_t k = 0; k < all.size(); ++k) {
    const std::array<hsize_t, 2> begin = {row, k % chunks * chunk_};
    errno = 0;
    check(FROM_NETCDF(H5Dwrite_chunk)(variables_[k / chunks], H5P_DEFAULT, 0, begin.data(), all[k].size(), all[k].data()) >= 0);
  }
}

void NetcdfRows::finish() {
  for (const std::int64_t variable : std::exchange(variables_, {})) {
    errno = 0;
    check(FROM_NETCDF(H5Dclose)(variable) >= 0);
  }
  errno = 0;
  check(FROM_NETCDF(H5Fclose)(std::exchange(file_, -1)) >= 0);
}

void NetcdfRows::check(bool good) {
  if (good) return;
  const int reason = errno;
  if (!std::exchange(broken_, true)) leave_before_libraries();
  throw_write_failure(name_ + ": its values cannot be written", reason, "HDF5 reports an error");
}

// A chunk at the end of a row is as long as the others. The lowest bytes of its values, which come first, are often as good as
// random.
std::vector<std::uint8_t> NetcdfRows::packed(std::span<const float> values) const {
  const std::vector<std::byte> planes = shuffled(values, chunk_);
  std::size_t stored = 0;
  while (stored < planes.size() && look_random(std::span(planes).subspan(stored, chunk_))) stored += chunk_;
  std::vector<std::uint8_t> bytes;
  ZlibStreams().append(planes, stored, bytes);
  return bytes;
}

}  // namespace sunfleck
