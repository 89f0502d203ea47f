#include "programs/viewer/file_watch.h"

namespace sunfleck {

void FileWatch::add(std::span<const SourceFile> files) {
  std::map<std::filesystem::path, std::optional<FileStamp>> read;
  for (const SourceFile& file : files) read.try_emplace(file.path, file.stamp);
  read.merge(known_);
  known_ = std::move(read);
}

bool FileWatch::has_changed() {
  bool changed = false;
  for (auto& [file, known] : known_) {
    const std::optional<FileStamp> now = stamp_of(file);
    if (!now || now == known) continue;
    known = now;
    changed = true;
  }
  return changed;
}

}  // namespace sunfleck
