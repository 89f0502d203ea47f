#include "files/results/exports/netcdf_library.h"

#include "base/error.h"
#include "base/file.h"

#include <dlfcn.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <new>
#include <string_view>

namespace sunfleck {
namespace {

[[noreturn]] void throw_missing() {
  const char* const told = ::dlerror();
  const std::string_view reason = told != nullptr ? told : "it cannot be loaded";
  // A library for which there is no room is not missing. The loader says so in these words alone.
  for (const char* of_memory : {" map ", "allocate", "cannot create", "memory"}) {
    if (reason.find(of_memory) != reason.npos) throw std::bad_alloc();
  }
  throw_failure("netCDF", std::string(reason), "install " SUNFLECK_NETCDF_PACKAGE ", or export vtp or csv");
}

template <class Function>
void find(const char* name, Function& function) {
  static void* const library = ::dlopen(SUNFLECK_NETCDF_SONAME, RTLD_NOW | RTLD_LOCAL);
  void* const found = library != nullptr ? ::dlsym(library, name) : nullptr;
  if (found == nullptr) throw_missing();
  function = reinterpret_cast<Function>(found);
}

NetcdfLibrary load_netcdf() {
  NetcdfLibrary functions{};
  find("nc_abort", functions.abort);
  find("nc_close", functions.close);
  find("nc_close_memio", functions.close_memio);
  find("nc_create", functions.create);
  find("nc_create_mem", functions.create_mem);
  find("nc_def_dim", functions.def_dim);
  find("nc_def_var", functions.def_var);
  find("nc_def_var_chunking", functions.def_var_chunking);
  find("nc_def_var_deflate", functions.def_var_deflate);
  find("nc_def_var_fill", functions.def_var_fill);
  find("nc_inq_dimlen", functions.inq_dimlen);
  find("nc_inq_vardimid", functions.inq_vardimid);
  find("nc_inq_varndims", functions.inq_varndims);
  find("nc_put_att_int", functions.put_att_int);
  find("nc_put_att_text", functions.put_att_text);
  find("nc_put_var", functions.put_var);
  find("nc_put_vara", functions.put_vara);
  find("nc_set_var_chunk_cache", functions.set_var_chunk_cache);
  find("nc_strerror", functions.strerror);
  find("nc_sync", functions.sync);
  return functions;
}

// netCDF depends on HDF5, so that its handle finds these too.
Hdf5Library load_hdf5() {
  Hdf5Library functions{};
  find("H5Fopen", functions.file_open);
  find("H5Fclose", functions.file_close);
  find("H5Dopen2", functions.dataset_open);
  find("H5Dclose", functions.dataset_close);
  find("H5Dwrite_chunk", functions.dataset_write_chunk);
  return functions;
}

}  // namespace

const NetcdfLibrary& netcdf() {
  static const NetcdfLibrary library = load_netcdf();
  return library;
}

const Hdf5Library& hdf5() {
  static const Hdf5Library library = load_hdf5();
  return library;
}

void leave_before_libraries() {
  ::on_exit(
      [](int status, void*) {
        std::fflush(nullptr);
        std::_Exit(status);
      },
      nullptr);
}

void throw_write_failure(const std::string& what, int reason, const char* otherwise) {
  const bool of_disk = reason == ENOSPC || reason == EDQUOT || reason == EFBIG || reason == EIO;
  throw_failure(what, of_disk ? std::strerror(reason) : otherwise,
                of_disk ? write_cure(reason) : "free some space, or choose another folder with -o");
}

}  // namespace sunfleck
