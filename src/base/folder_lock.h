#pragma once
// Ensures that only one run at a time uses a result folder.

#include <filesystem>

namespace sunfleck {

// An advisory lock (flock) on the folder itself. It leaves no file behind, and the system releases it if the process is killed.
// On file systems that do not lock folders (some network ones) it has no effect.
class FolderLock {
 public:
  // Takes the lock if the folder exists. Throws Error (failure) if another process holds it.
  explicit FolderLock(std::filesystem::path folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

  // Creates the folder if it is missing, and takes its lock unless already held. Throws Error (failure).
  void make_folder();

 private:
  void take();

  std::filesystem::path folder_;
  int number_ = -1;
};

}  // namespace sunfleck
