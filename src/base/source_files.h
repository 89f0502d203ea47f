#pragma once
// Lists the files that a scene is read from, for its digest and for the viewer, which watches them.

#include "base/file.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace sunfleck {

// Identifies the state of a file. If two stamps of a path are equal, the file was not written, replaced or relinked in between.
struct FileStamp {
  std::int64_t modified_s = 0, modified_ns = 0;
  std::uint64_t device = 0, inode = 0;
  std::int64_t bytes = 0;

  friend bool operator==(const FileStamp&, const FileStamp&) = default;
};

// Returns the stamp of a file, following links; nothing if there is no such file.
[[nodiscard]] std::optional<FileStamp> stamp_of(const std::filesystem::path& file);

struct SourceFile {
  std::filesystem::path path;
  std::optional<FileStamp> stamp;  // taken before the file was read; empty if it was missing
  std::string digest;              // of its bytes, 16 hexadecimal digits; empty if it was not read under this path
};

// Files in the order in which they are looked for and read. A file is listed each time it is read, and once more under the name
// that leads a scene to it.
class SourceFiles {
 public:
  // Adds a file that is looked for but not read, or not under this path: a link, or the name of a missing file.
  void note(const std::filesystem::path& file);

  // Returns the bytes of a file and adds it, even if it cannot be read. Throws as read_file does.
  [[nodiscard]] std::string read(const std::filesystem::path& file, std::uintmax_t most_bytes = largest_file_bytes);

  [[nodiscard]] const std::vector<SourceFile>& list() const { return list_; }

 private:
  std::vector<SourceFile> list_;
};

// Reads a file through `files`, or by read_file if `files` is null.
[[nodiscard]] std::string read_source(const std::filesystem::path& file, SourceFiles* files,
                                      std::uintmax_t most_bytes = largest_file_bytes);

}  // namespace sunfleck
