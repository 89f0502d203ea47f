#include "physics/transport/indirect/counted_thread.h"

#include "base/threads.h"

#include <oneapi/tbb/global_control.h>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <mutex>

namespace sunfleck {
namespace {

using Control = tbb::global_control;

// The counted threads of the process.
class Counted {
 public:
  void begin() {
    const std::lock_guard lock(mutex_);
    if (count_ == 0) allowed_ = threads_allowed();
    ++count_;
    limit();
  }

  void end() {
    const std::lock_guard lock(mutex_);
    --count_;
    limit();
  }

 private:
  // A thread that calls TBB counts as one of the allowed threads, but not the others that do.
  void limit() {
    const std::size_t others = count_ > 0 ? count_ - 1 : 0;
    control_ = others == 0
                   ? nullptr
                   : std::make_unique<Control>(Control::max_allowed_parallelism, allowed_ - std::min(allowed_ - 1, others));
  }

  std::mutex mutex_;
  std::size_t count_ = 0;
  std::size_t allowed_ = 1;
  std::unique_ptr<Control> control_;
};

Counted& counted() {
  static Counted threads;
  return threads;
}

}  // namespace

CountedThread::CountedThread() {
  counted().begin();
}

CountedThread::~CountedThread() {
  counted().end();
}

UncountedThread::UncountedThread() {
  counted().end();
}

UncountedThread::~UncountedThread() {
  counted().begin();
}

}  // namespace sunfleck
