#include "programs/cli/process.h"

#include "base/error.h"
#include "physics/transport/model/tracer.h"
#include "simulate/cluster/launch.h"

#include <fcntl.h>
#include <malloc.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <new>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>

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

void keep_freed(int large_bytes) {
  constexpr int kept_bytes = 256 << 20;
  ::mallopt(M_MMAP_THRESHOLD, large_bytes);
  ::mallopt(M_TRIM_THRESHOLD, kept_bytes);
}

}  // namespace

void prepare_process() {
  // Large arrays go back to the system when they are freed. By default glibc keeps ever larger ones for later use, which took a
  // seventh more memory and four times as much system time on a stand of a million triangles.
  constexpr int large_bytes = 1 << 20;
  ::mallopt(M_MMAP_THRESHOLD, large_bytes);
  // Smaller ones come back in every replicate. Setting the threshold above fixes how much free memory is kept for them at 128
  // KiB, so that pages were given back and fetched again all the time: a run of maize_sparse.toml took 6 % longer. One arena
  // for all threads keeps the free memory in one place; the threads hardly wait for one another.
  constexpr int kept_bytes = 16 << 20;
  ::mallopt(M_TRIM_THRESHOLD, kept_bytes);
  ::mallopt(M_ARENA_MAX, 1);
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  for (int number = STDIN_FILENO; number <= STDERR_FILENO; ++number) {
    // A closed descriptor is opened in the wrong direction, so that using it is an error, as with a closed stream.
    if (::fcntl(number, F_GETFD) < 0) static_cast<void>(::open("/dev/null", number == STDIN_FILENO ? O_WRONLY : O_RDONLY));
  }
}

void keep_freed_memory() {
  keep_freed(4 << 20);
}

void keep_freed_memory_for(const TracerDevice& device) {
  constexpr int large_bytes = 32 << 20;  // the most that glibc allows
  if (!device.software) keep_freed(large_bytes);
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
