#pragma once
// The files that a scene is read from: what its digest is made of, and what a window watches.

#include "io/file.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace sunfleck {

// Two equal stamps of a path: nobody has written, replaced or turned its link to another file in between.
struct FileStamp {
  std::int64_t modified_s = 0, modified_ns = 0;
  std::uint64_t device = 0, inode = 0;
  std::int64_t bytes = 0;

  friend bool operator==(const FileStamp&, const FileStamp&) = default;
};

// Links are followed. None where there is no such file.
[[nodiscard]] std::optional<FileStamp> stamp_of(const std::filesystem::path& file);

struct SourceFile {
  std::filesystem::path path;
  std::optional<FileStamp> stamp;  // before it was read; none if it was missing
  std::string digest;              // of its bytes, 16 hexadecimal digits; empty if it was not read under this path
};

// In the order in which they are sought and read. A file stands here as often as it is read, and once more under the name by
// which a scene finds it.
class SourceFiles {
 public:
  // Adds a file that is sought but not read, or not under this path: a link, or the name of a file that is missing.
  void note(const std::filesystem::path& file);

  // The bytes of a file, which is added even if it cannot be read. Throws as read_file does.
  [[nodiscard]] std::string read(const std::filesystem::path& file, std::uintmax_t most_bytes = largest_file_bytes);

  [[nodiscard]] const std::vector<SourceFile>& list() const { return list_; }

 private:
  std::vector<SourceFile> list_;
};

// The same for readers of which nobody may want the list: read_file without `files`.
[[nodiscard]] std::string read_source(const std::filesystem::path& file, SourceFiles* files,
                                      std::uintmax_t most_bytes = largest_file_bytes);

}  // namespace sunfleck
