#pragma once
// Watches files for changes since they were read.

#include "base/source_files.h"

#include <filesystem>
#include <map>
#include <optional>
#include <span>

namespace sunfleck {

class FileWatch {
 public:
  // Stops watching all files.
  void clear() { known_.clear(); }

  // Also watches these files, each from the state in which it was first read. Replaces what was known about them before.
  void add(std::span<const SourceFile> files);

  // Looks at all files. Returns true if one was written, replaced or created since it was read or last looked at. A missing
  // file counts as unchanged, because an editor may be about to put a new one in its place.
  [[nodiscard]] bool has_changed();

 private:
  std::map<std::filesystem::path, std::optional<FileStamp>> known_;  // none: the file was missing
};

}  // namespace sunfleck
