#pragma once
// The netCDF C library, opened when the first file is written. It brings thirty other libraries along (HDF5, curl, Kerberos), and
// loading them takes as long as everything else that the program does before its work.

#include <hdf5.h>
#include <netcdf.h>
#include <netcdf_mem.h>

#include <mutex>
#include <string>

namespace sunfleck {

// Returns a function of netCDF, or of HDF5, the library below it; the libraries stay open. Throws Error (failure) if they cannot be
// loaded.
#define FROM_NETCDF(function) reinterpret_cast<decltype(&(function))>(netcdf_function(#function))
[[nodiscard]] void* netcdf_function(const char* name);

// Held by each file that is open, since neither library may be called by two threads at once.
[[nodiscard]] std::recursive_mutex& netcdf_mutex();

// After a failed write, netCDF-C (4.9.0) crashes when it closes or aborts the file, and again when the process exits and the
// library closes it by itself. This makes the process exit with its intended status before that; the file is left open.
void leave_before_libraries();

// Throws Error (failure), which says that `what` failed: because of `reason`, an errno, if that is one of disks, or else because of
// `otherwise`.
[[noreturn]] void throw_write_failure(const std::string& what, int reason, const char* otherwise);

}  // namespace sunfleck
