#include "files/results/exports/netcdf_library.h"

#include "base/error.h"

#include <dlfcn.h>

#include <type_traits>

namespace sunfleck {
namespace {

[[noreturn]] void throw_missing() {
  const char* reason = ::dlerror();
  throw_failure("netCDF", reason != nullptr ? reason : "it cannot be loaded",
                "install " SUNFLECK_NETCDF_PACKAGE ", or export vtp or csv");
}

NetcdfLibrary load() {
  void* const library = ::dlopen(SUNFLECK_NETCDF_SONAME, RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) throw_missing();
  const auto find = [library](const char* name, auto& function) {
    void* const found = ::dlsym(library, name);
    if (found == nullptr) throw_missing();
    function = reinterpret_cast<std::remove_reference_t<decltype(function)>>(found);
  };
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
  find("nc_put_var_double", functions.put_var_double);
  find("nc_put_var_float", functions.put_var_float);
  find("nc_put_var_int", functions.put_var_int);
  find("nc_put_var_longlong", functions.put_var_longlong);
  find("nc_put_var_text", functions.put_var_text);
  find("nc_put_vara_float", functions.put_vara_float);
  find("nc_set_var_chunk_cache", functions.set_var_chunk_cache);
  find("nc_strerror", functions.strerror);
  find("nc_sync", functions.sync);
  return functions;
}

}  // namespace

const NetcdfLibrary& netcdf() {
  static const NetcdfLibrary library = load();
  return library;
}

}  // namespace sunfleck
