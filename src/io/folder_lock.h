#pragma once
// One run at a time in a result folder.

#include <filesystem>

namespace sunfleck {

// An advisory lock (flock) on the folder itself: nothing is left behind in it, and the lock of a process that is killed goes
// with it. On file systems that do not lock folders (some network ones) it holds nothing.
class FolderLock {
 public:
  // Takes the lock if the folder is there. Throws Error (failure) while another process has it.
  explicit FolderLock(std::filesystem::path folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

  // Makes the folder where it is missing, and takes its lock unless that is held already. Throws Error (failure).
  void make_folder();

 private:
  void take();

  std::filesystem::path folder_;
  int number_ = -1;
};

}  // namespace sunfleck
