// Preloaded before the program (LD_PRELOAD): simulates a disk that fills up or breaks, and clocks that jump or that count their
// readings, and sends signals that come at the same point of the work however fast the machine is.
//   SUNFLECK_FAULT_FOLDER=/a/folder   restricts the faults of the disk to files in this folder and below
//   SUNFLECK_FAULT_BYTES=1000         these files take this many bytes in total, then there is no space
//   SUNFLECK_FAULT_JOURNAL=/a/file    gets a line for each write, fsync and rename, in their order: `write NAME`, `fsync NAME`,
//                                     `rename NAME NAME`, with names relative to the folder
//   SUNFLECK_FAULT_FSYNC=NAME         fsync fails with SUNFLECK_FAULT_ERRNO for files whose relative name begins with NAME
//   SUNFLECK_FAULT_CLOCK=1            the time of day jumps to and fro by years
//   SUNFLECK_FAULT_STRIDE=0.01        each reading of the steady clock is this many seconds later than the one before
//   SUNFLECK_FAULT_SIGNALS=0@rename a,2@clock    sends these signals to the program one after the other, each at the first event
//                                     after the last signal whose text begins this way. Events are the lines of the journal, and `clock` for a
//                                     reading of the steady clock; `#7` is the seventh line of the journal. 0 is no signal

#include <dlfcn.h>
#include <fcntl.h>
#include <signal.h>
#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <mutex>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

namespace {

template <class Function>
Function* real(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

long long bytes_at_start() {
  const char* text = std::getenv("SUNFLECK_FAULT_BYTES");
  return text != nullptr ? std::atoll(text) : -1;
}

// Returns the path relative to the folder, "." for the folder itself, or nothing for a path outside.
std::optional<std::string> name_in_folder(const std::string& path) {
  static const char* const folder = std::getenv("SUNFLECK_FAULT_FOLDER");
  if (folder == nullptr || path.rfind(folder, 0) != 0) return std::nullopt;
  return std::filesystem::path(path).lexically_relative(folder).string();
}

std::optional<std::string> name_in_folder(int file) {
  char target[4096];
  const std::string link = "/proc/self/fd/" + std::to_string(file);
  const ssize_t length = ::readlink(link.c_str(), target, sizeof target);
  return length > 0 ? name_in_folder(std::string(target, static_cast<std::size_t>(length))) : std::nullopt;
}

// Programs that the program starts, or that start it, get no signals and have their clock.
bool is_program() {
  static const bool is = std::string(::program_invocation_short_name) == "sunfleck";
  return is;
}

// The signals of SUNFLECK_FAULT_SIGNALS.
class Signals {
 public:
  Signals() {
    const char* text = std::getenv("SUNFLECK_FAULT_SIGNALS");
    if (text == nullptr || !is_program()) return;
    std::istringstream list(text);
    for (std::string entry; std::getline(list, entry, ',');) {
      const std::size_t at = entry.find('@');
      awaited_.push_back({std::atoi(entry.c_str()), entry.substr(at + 1)});
    }
    left_ = awaited_.size();
  }

  void meet_line(const std::string& line) {
    if (left_ == 0) return;
    const long number = ++lines_;
    meet([&](const std::string& event) {
      return event[0] == '#' ? std::atol(event.c_str() + 1) == number : line.rfind(event, 0) == 0;
    });
  }
  void meet_clock() {
    if (left_ > 0) meet([](const std::string& event) { return event == "clock"; });
  }

 private:
  struct Awaited {
    int signal;
    std::string event;
  };

  template <class Condition>
  void meet(const Condition& is) {
    int signal = 0;
    {
      const std::lock_guard lock(mutex_);
      if (left_ == 0) return;
      const Awaited& first = awaited_[awaited_.size() - left_];
      if (!is(first.event)) return;
      signal = first.signal;
      --left_;
    }
    if (signal != 0) ::kill(::getpid(), signal);
  }

  std::mutex mutex_;
  std::vector<Awaited> awaited_;
  std::atomic<std::size_t> left_{0};
  std::atomic<long> lines_{0};
};

Signals& signals() {
  static Signals all;
  return all;
}

void note(const std::string& line) {
  signals().meet_line(line);
  static auto* const next = real<ssize_t(int, const void*, std::size_t)>("write");
  static const char* const file = std::getenv("SUNFLECK_FAULT_JOURNAL");
  static const int journal = file != nullptr ? ::open(file, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0600) : -1;
  if (journal >= 0 && next(journal, (line + "\n").c_str(), line.size() + 1) < 0) std::abort();
}

bool fails_to_sync(const std::string& name) {
  static const char* const failing = std::getenv("SUNFLECK_FAULT_FSYNC");
  return failing != nullptr && name.rfind(failing, 0) == 0;
}

// Returns how many of the bytes the disk still takes.
std::size_t granted(int file, std::size_t bytes) {
  static std::atomic<long long> left{bytes_at_start()};
  if (left < 0 || bytes == 0 || !name_in_folder(file)) return bytes;
  long long before = left;
  long long take = 0;
  do {
    take = std::min<long long>(before, static_cast<long long>(bytes));
  } while (!left.compare_exchange_weak(before, before - take));
  return static_cast<std::size_t>(take);
}

template <class Write>
ssize_t write_within(int file, std::size_t bytes, const Write& write) {
  if (const auto name = name_in_folder(file)) note("write " + *name);
  const std::size_t take = granted(file, bytes);
  if (take == 0 && bytes > 0) {
    errno = ENOSPC;
    return -1;
  }
  return write(take);
}

long jump_s() {
  static const bool jumps = std::getenv("SUNFLECK_FAULT_CLOCK") != nullptr;
  static std::atomic<unsigned> calls{0};
  constexpr long years_s = 20L * 365 * 86400;
  if (!jumps) return 0;
  return calls++ % 2 == 0 ? years_s : -years_s;
}

// Counts the readings, which take the place of time.
void stride(timespec& now) {
  static const char* const text = std::getenv("SUNFLECK_FAULT_STRIDE");
  signals().meet_clock();
  if (text == nullptr || !is_program()) return;
  static const double each_s = std::atof(text);
  static std::atomic<long long> readings{0};
  constexpr double begin_s = 1000.0;
  const double now_s = begin_s + each_s * static_cast<double>(++readings);
  now.tv_sec = static_cast<std::time_t>(std::floor(now_s));
  now.tv_nsec = static_cast<long>(1e9 * (now_s - std::floor(now_s)));
}

}  // namespace

extern "C" {

ssize_t write(int file, const void* data, std::size_t bytes) {
  static auto* const next = real<ssize_t(int, const void*, std::size_t)>("write");
  return write_within(file, bytes, [&](std::size_t take) { return next(file, data, take); });
}

ssize_t pwrite(int file, const void* data, std::size_t bytes, off_t at) {
  static auto* const next = real<ssize_t(int, const void*, std::size_t, off_t)>("pwrite");
  return write_within(file, bytes, [&](std::size_t take) { return next(file, data, take, at); });
}

ssize_t pwrite64(int file, const void* data, std::size_t bytes, off64_t at) {
  static auto* const next = real<ssize_t(int, const void*, std::size_t, off64_t)>("pwrite64");
  return write_within(file, bytes, [&](std::size_t take) { return next(file, data, take, at); });
}

int fsync(int file) {
  static auto* const next = real<int(int)>("fsync");
  const auto name = name_in_folder(file);
  if (!name) return next(file);
  note("fsync " + *name);
  if (!fails_to_sync(*name)) return next(file);
  errno = std::atoi(std::getenv("SUNFLECK_FAULT_ERRNO"));
  return -1;
}

int rename(const char* from, const char* to) noexcept {
  static auto* const next = real<int(const char*, const char*)>("rename");
  const auto before = name_in_folder(std::filesystem::absolute(from).string());
  const auto after = name_in_folder(std::filesystem::absolute(to).string());
  if (before && after) note("rename " + *before + " " + *after);
  return next(from, to);
}

int clock_gettime(clockid_t clock, timespec* now) noexcept {
  static auto* const next = real<int(clockid_t, timespec*)>("clock_gettime");
  const int status = next(clock, now);
  if (clock == CLOCK_REALTIME || clock == CLOCK_REALTIME_COARSE) now->tv_sec += jump_s();
  if (clock == CLOCK_MONOTONIC) stride(*now);
  return status;
}

int gettimeofday(timeval* now, void* zone) noexcept {
  static auto* const next = real<int(timeval*, void*)>("gettimeofday");
  const int status = next(now, zone);
  now->tv_sec += jump_s();
  return status;
}

std::time_t time(std::time_t* now) noexcept {
  timespec precise{};
  clock_gettime(CLOCK_REALTIME, &precise);
  if (now != nullptr) *now = precise.tv_sec;
  return precise.tv_sec;
}

}  // extern "C"
