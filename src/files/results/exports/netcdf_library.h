#pragma once
// The netCDF C library, opened when the first file is written. It brings thirty other libraries along (HDF5, curl, Kerberos), and
// loading them takes as long as everything else that the program does before its work.

#include <hdf5.h>
#include <netcdf.h>
#include <netcdf_mem.h>

#include <string>

namespace sunfleck {

// Its functions, under their names without nc_.
struct NetcdfLibrary {
  decltype(&nc_abort) abort;
  decltype(&nc_close) close;
  decltype(&nc_close_memio) close_memio;
  decltype(&nc_create) create;
  decltype(&nc_create_mem) create_mem;
  decltype(&nc_def_dim) def_dim;
  decltype(&nc_def_var) def_var;
  decltype(&nc_def_var_chunking) def_var_chunking;
  decltype(&nc_def_var_deflate) def_var_deflate;
  decltype(&nc_def_var_fill) def_var_fill;
  decltype(&nc_inq_dimlen) inq_dimlen;
  decltype(&nc_inq_vardimid) inq_vardimid;
  decltype(&nc_inq_varndims) inq_varndims;
  decltype(&nc_put_att_int) put_att_int;
  decltype(&nc_put_att_text) put_att_text;
  decltype(&nc_put_var) put_var;
  decltype(&nc_put_vara) put_vara;
  decltype(&nc_set_var_chunk_cache) set_var_chunk_cache;
  decltype(&nc_strerror) strerror;
  decltype(&nc_sync) sync;
};

// Functions of HDF5, the library below it.
struct Hdf5Library {
  decltype(&H5Fopen) file_open;
  decltype(&H5Fclose) file_close;
  decltype(&H5Dopen2) dataset_open;
  decltype(&H5Dclose) dataset_close;
  decltype(&H5Dwrite_chunk) dataset_write_chunk;
};

// Return the libraries, which stay open. Throw Error (failure) if they cannot be loaded.
[[nodiscard]] const NetcdfLibrary& netcdf();
[[nodiscard]] const Hdf5Library& hdf5();

// After a failed write, netCDF-C (4.9.0) crashes when it closes or aborts the file, and again when the process exits and the
// library closes it by itself. This makes the process exit with its intended status before that; the file is left open.
void leave_before_libraries();

// Throws Error (failure), which says that `what` failed: because of `reason`, an errno, if that is one of disks, or else because of
// `otherwise`.
[[noreturn]] void throw_write_failure(const std::string& what, int reason, const char* otherwise);

}  // namespace sunfleck
