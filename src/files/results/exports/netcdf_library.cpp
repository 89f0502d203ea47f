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

}  // namespace

// netCDF depends on HDF5, so that its handle finds the functions of both.
void* netcdf_function(const char* name) {
  static void* const library = ::dlopen(SUNFLECK_NETCDF_SONAME, RTLD_NOW | RTLD_LOCAL);
  void* const found = library != nullptr ? ::dlsym(library, name) : nullptr;
  if (found == nullptr) throw_missing();
  return found;
}

std::recursive_mutex& netcdf_mutex() {
  static std::recursive_mutex mutex;
  return mutex;
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
