#pragma once
// Tells when files are no longer as they were read.

#include "io/source_files.h"

#include <filesystem>
#include <map>
#include <optional>
#include <span>

namespace sunfleck {

class FileWatch {
 public:
  // Watches no file any more.
  void clear() { known_.clear(); }

  // Watches these too, each as it was when it was first read. What was known of one of them before no longer counts.
  void add(std::span<const SourceFile> files);

  // Looks at all of them. True if one was written, replaced or made since it was read or last looked at. A file that is away is
  // waited for: an editor may be about to put a new one in its place.
  [[nodiscard]] bool has_changed();

 private:
  std::map<std::filesystem::path, std::optional<FileStamp>> known_;  // none: it was missing
};

}  // namespace sunfleck
