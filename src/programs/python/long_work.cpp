#include "programs/python/long_work.h"

#include <pthread.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>

namespace sunfleck {
namespace {

namespace py = pybind11;

constexpr std::chrono::milliseconds listening_interval{20};
constexpr std::chrono::milliseconds telling_interval{100};

// What the threads of this process are doing. A child of fork() has only the thread that called it.
std::atomic<bool> is_ending = false;
std::atomic<int> in_progress = 0;

class InProgress {
 public:
  InProgress() {
    static const int registered = ::pthread_atfork(nullptr, nullptr, [] { in_progress = 0; });
    static_cast<void>(registered);
    ++in_progress;
  }
  ~InProgress() { --in_progress; }
  InProgress(const InProgress&) = delete;
  InProgress& operator=(const InProgress&) = delete;
};

void exit_if_ending() {
  if (!is_ending) return;
  PyErr_SetNone(PyExc_SystemExit);
  throw py::error_already_set();
}

// State shared by the two threads.
struct Desk {
  std::atomic<bool> stop = false;
  std::mutex mutex;
  std::condition_variable changed;
  bool done = false;
  Progress progress;  // the latest known
};

py::dict as_dict(const Progress& progress) {
  py::dict dict;
  const bool pilot = progress.stage == Progress::Stage::pilot;
  const bool sensors = progress.stage == Progress::Stage::sensors;
  dict["stage"] = pilot ? "pilot" : sensors ? "sensors" : "run";
  dict["rays"] = progress.rays;
  dict["fraction"] = progress.fraction;
  const auto or_none = [](const std::optional<double>& value) { return value ? py::object(py::float_(*value)) : py::none(); };
  dict["seconds_left"] = or_none(progress.seconds_left);
  dict["pass"] = pass_name(progress.pass);
  dict["relative_error"] = or_none(progress.relative_error);
  dict["bound"] = or_none(progress.bound);
  return dict;
}

// Waits for the end of the work; throws what Python raises meanwhile.
void attend(Desk& desk, const py::object& progress) {
  auto last_told = std::chrono::steady_clock::now() - telling_interval;
  while (true) {
    Progress news;
    bool done = false;
    {
      const py::gil_scoped_release release;
      std::unique_lock lock(desk.mutex);
      desk.changed.wait_for(lock, listening_interval, [&] { return desk.done; });
      done = desk.done;
      news = desk.progress;
    }
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    exit_if_ending();
    const auto now = std::chrono::steady_clock::now();
    if (!progress.is_none() && (done || now - last_told >= telling_interval)) {
      progress(as_dict(news));
      last_told = now;
    }
    if (done) return;
  }
}

}  // namespace

void do_long_work(const std::function<void(const Monitor&)>& work, const py::object& progress) {
  exit_if_ending();
  const InProgress counted;
  Desk desk;
  Monitor monitor;
  monitor.interrupted = [&desk] { return desk.stop.load(); };
  monitor.report = [&desk](const Progress& state) {
    const std::lock_guard lock(desk.mutex);
    const double furthest = desk.progress.fraction;
    desk.progress = state;
    desk.progress.fraction = std::max(furthest, state.fraction);
  };
  std::exception_ptr failure;
  std::thread worker([&] {
    try {
      work(monitor);
    } catch (...) {
      failure = std::current_exception();
    }
    const std::lock_guard lock(desk.mutex);
    desk.done = true;
    desk.changed.notify_all();
  });
  std::exception_ptr from_python;
  try {
    attend(desk, progress);
  } catch (...) {
    from_python = std::current_exception();
    desk.stop = true;
  }
  {
    const py::gil_scoped_release release;
    worker.join();
  }
  if (failure) std::rethrow_exception(failure);
  if (from_python) std::rethrow_exception(from_python);
}

void end_long_work() {
  is_ending = true;
  const py::gil_scoped_release release;
  while (in_progress > 0) std::this_thread::sleep_for(listening_interval);
}

}  // namespace sunfleck
