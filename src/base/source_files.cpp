#include "base/source_files.h"

#include "base/digest.h"

#include <sys/stat.h>

namespace sunfleck {

std::optional<FileStamp> stamp_of(const std::filesystem::path& file) {
  struct stat state {};
  if (::stat(file.c_str(), &state) != 0) return std::nullopt;
  return FileStamp{state.st_mtim.tv_sec, state.st_mtim.tv_nsec, state.st_dev, state.st_ino, state.st_size};
}

void SourceFiles::note(const std::filesystem::path& file) {
  list_.push_back({file, stamp_of(file), {}});
}

std::string SourceFiles::read(const std::filesystem::path& file, std::uintmax_t most_bytes) {
  // The stamp is taken before reading, so that any later write leads to a different stamp.
  note(file);
  std::string bytes = read_file(file, most_bytes);
  Digest digest;
  digest.add(bytes);
  list_.back().digest = digest.text();
  return bytes;
}

std::string read_source(const std::filesystem::path& file, SourceFiles* files, std::uintmax_t most_bytes) {
  return files != nullptr ? files->read(file, most_bytes) : read_file(file, most_bytes);
}

}  // namespace sunfleck
