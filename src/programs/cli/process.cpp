#include "programs/cli/process.h"

#include "base/error.h"
#include "simulate/cluster/launch.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <exception>
#include <new>
#include <stdexcept>
#include <string_view>
#include <system_error>

extern "C" [[gnu::weak]] int mallctl(const char* name, void* old, std::size_t* old_bytes, void* value, std::size_t bytes);

namespace sunfleck {
namespace {

// Uses neither a buffer nor an exception, since both memory and standard error may be gone.
int fail_with(const char* message, const char* after = "") {
  std::fputs("sunfleck: ", stderr);
  std::fputs(message, stderr);
  std::fputs(after, stderr);
  std::fputc('\n', stderr);
  return static_cast<int>(ErrorKind::failure);
}

int output_lost(int code) {
  return fail_with(three_part_message("standard output: cannot be written", std::strerror(code),
                                      "the result files are not affected; send standard output elsewhere")
                       .c_str());
}

}  // namespace

void prepare_process() {
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  for (int number = STDIN_FILENO; number <= STDERR_FILENO; ++number) {
    // A closed descriptor is opened in the wrong direction, so that using it is an error, as with a closed stream.
    if (::fcntl(number, F_GETFD) < 0) static_cast<void>(::open("/dev/null", number == STDIN_FILENO ? O_WRONLY : O_RDONLY));
  }
}

void keep_freed_memory() {
  if (::mallctl == nullptr) return;
  ::ssize_t decay_ms = -1;  // never
  static_cast<void>(::mallctl("arena.0.dirty_decay_ms", nullptr, nullptr, &decay_ms, sizeof decay_ms));
}

void return_freed_memory() {
  if (::mallctl != nullptr) static_cast<void>(::mallctl("arena.0.purge", nullptr, nullptr, nullptr, 0));
}

int finish_output(int status) {
  errno = 0;
  const bool failed = std::fflush(stdout) != 0 || std::ferror(stdout) != 0;
  if (!failed || errno == EPIPE) return status;
  return output_lost(errno != 0 ? errno : EIO);
}

int report_exception() {
  // A launcher ends all ranks at the first bad status, so rank 0 must be able to report the reason first.
  if (is_worker_rank()) return 0;
  try {
    throw;
  } catch (const Error& error) {
    static_cast<void>(fail_with(error.what()));
    return static_cast<int>(error.kind());
  } catch (const std::bad_alloc&) {
    return fail_with("out of memory (allocation failed); make the scene or the pictures smaller, or free some memory");
  } catch (const std::length_error&) {
    return fail_with("out of memory (more than a process can address); make the scene or the pictures smaller");
  } catch (const std::system_error& error) {
    if (std::ferror(stdout) != 0) return error.code().value() == EPIPE ? 0 : output_lost(error.code().value());
    return fail_with(error.what(), " (refused by the system); free memory or threads, or give fewer --threads");
  } catch (const std::runtime_error& error) {
    // oneTBB reports a thread that the system refuses in this form.
    if (std::string_view(error.what()).starts_with("pthread_create")) {
      return fail_with(error.what(), " (refused by the system); free memory or threads, or give fewer --threads");
    }
    return fail_with(error.what(), "; this is a bug in the program, please report it");
  } catch (const std::exception& error) {
    return fail_with(error.what(), "; this is a bug in the program, please report it");
  }
}

}  // namespace sunfleck
