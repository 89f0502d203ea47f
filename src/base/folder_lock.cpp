#include "base/folder_lock.h"

#include "base/error.h"
#include "base/file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <utility>

namespace sunfleck {

FolderLock::FolderLock(std::filesystem::path folder) : folder_(std::move(folder)) {
  take();
}

FolderLock::~FolderLock() {
  if (number_ >= 0) ::close(number_);
}

void FolderLock::make_folder() {
  sunfleck::make_folder(folder_);
  take();
}

void FolderLock::take() {
  if (number_ >= 0) return;
  const int number = ::open(folder_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (number < 0) return;  // it does not exist, or writing will report that it is unreadable
  if (::flock(number, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) {
    number_ = number;
    return;
  }
  ::close(number);
  throw_failure(printable(folder_.string()), "another run is writing into this folder",
                "wait until it ends, or choose another folder with -o");
}

}  // namespace sunfleck
