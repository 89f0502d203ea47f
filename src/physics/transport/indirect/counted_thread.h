#pragma once
// Keeps a process within the threads that it was given.

namespace sunfleck {

// Counts the calling thread among those of TBB while it exists: where k such threads are at work, TBB lends at most the others
// to their loops, so that there are never more than it may have (tbb::global_control), and all of them where only one thread is
// left.
class CountedThread {
 public:
  CountedThread();
  ~CountedThread();
  CountedThread(const CountedThread&) = delete;
  CountedThread& operator=(const CountedThread&) = delete;
};

// Does not count a counted thread while it waits for others.
class UncountedThread {
 public:
  UncountedThread();
  ~UncountedThread();
  UncountedThread(const UncountedThread&) = delete;
  UncountedThread& operator=(const UncountedThread&) = delete;
};

}  // namespace sunfleck
