#include "base/file.h"

#include "base/error.h"
#include "base/text.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <limits>
#include <memory>
#include <ostream>
#include <streambuf>
#include <system_error>
#include <utility>
#include <vector>

namespace sunfleck {

namespace {

namespace fs = std::filesystem;

constexpr mode_t new_file_mode = 0666;  // before the user's umask

using Handle = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

Handle open(const fs::path& file, const char* mode) {
  return {std::fopen(file.c_str(), mode), &std::fclose};
}

[[noreturn]] void refuse_read(const fs::path& file, std::string_view why, std::string_view cure) {
  throw_input(fmt::format("{}: cannot be read", printable(file.string())), why, cure);
}

[[noreturn]] void refuse_write(const fs::path& file, int code) {
  throw_failure(fmt::format("{}: cannot be written", printable(file.string())), std::strerror(code), write_cure(code));
}

// Returns 0, or the errno that forbids replacing a file of this name; a rename alone would ignore it.
int protection(const fs::path& file) {
  struct stat state {};
  if (::stat(file.c_str(), &state) != 0) return 0;  // there is no file, or opening the new one will report the reason
  if (S_ISDIR(state.st_mode)) return EISDIR;
  return ::access(file.c_str(), W_OK) == 0 ? 0 : errno;
}

// Waits until a file or folder is on the disk. Returns 0 or errno; a file system without fsync counts as success.
int wait_for_disk(int number) {
  int code = 0;
  do {
    code = ::fsync(number) == 0 ? 0 : errno;
  } while (code == EINTR);
  return code == EINVAL || code == ENOTSUP ? 0 : code;
}

int sync_file(const fs::path& file) {
  const int number = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (number < 0) return errno;
  const int code = wait_for_disk(number);
  ::close(number);
  return code;
}

// Waits until the entries of a folder are on the disk. Returns 0 or errno; a folder that is writable but not readable counts as
// success.
int sync_folder(const fs::path& folder) {
  const int number = ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (number < 0) return errno == EACCES ? 0 : errno;
  const int code = wait_for_disk(number);
  ::close(number);
  return code;
}

// Renames a file that is on the disk, and waits for its new name. Returns 0 or errno.
int put_in_place(const fs::path& file, const fs::path& aside) {
  if (const int code = protection(file); code != 0) return code;
  if (std::rename(aside.c_str(), file.c_str()) != 0) return errno;
  return sync_folder(file.parent_path());
}

// Says whether writing waits until the bytes are on the disk.
enum class Wait { no, for_disk };

// An open file that a stream can write to. The first error of the system is kept until close().
class OpenFile : public std::streambuf {
 public:
  explicit OpenFile(int number) : number_(number) { setp(space_.data(), space_.data() + space_.size()); }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;
  ~OpenFile() override {
    if (number_ >= 0) ::close(number_);
  }

  // Writes all bytes, unless an earlier call has failed.
  void put(std::string_view bytes) {
    while (!bytes.empty() && code_ == 0) {
      const ssize_t written = ::write(number_, bytes.data(), bytes.size());
      if (written < 0 && errno != EINTR) code_ = errno;
      if (written > 0) bytes.remove_prefix(static_cast<std::size_t>(written));
    }
  }

  // Closes the file. Returns 0 or the first errno.
  int close(Wait wait) {
    put_space();
    if (code_ == 0 && wait == Wait::for_disk) code_ = wait_for_disk(number_);
    if (::close(std::exchange(number_, -1)) != 0 && code_ == 0) code_ = errno;  // a full network disk may be reported only now
    return code_;
  }

 protected:
  int_type overflow(int_type byte) override {
    put_space();
    if (!traits_type::eq_int_type(byte, traits_type::eof())) sputc(traits_type::to_char_type(byte));
    return traits_type::not_eof(byte);
  }

  std::streamsize xsputn(const char* bytes, std::streamsize count) override {
    if (count < epptr() - pptr()) return std::streambuf::xsputn(bytes, count);
    put_space();
    put({bytes, static_cast<std::size_t>(count)});
    return count;
  }

 private:
  void put_space() {
    put({pbase(), static_cast<std::size_t>(pptr() - pbase())});
    setp(space_.data(), space_.data() + space_.size());
  }

  int number_;
  int code_ = 0;
  std::array<char, std::size_t{1} << 16U> space_;
};

// Removes what was written aside, and throws, unless `code` is 0.
void expect_written(const fs::path& file, const fs::path& aside, int code) {
  if (code == 0) return;
  ::unlink(aside.c_str());
  refuse_write(file, code);
}

}  // namespace

bool is_utf8(std::string_view text) {
  while (!text.empty())
    if (!take_code_point(text)) return false;
  return true;
}

std::string printable(std::string_view text) {
  const bool ascii_only = !is_utf8(text);
  std::string shown(text);
  for (std::size_t i = 0; i < shown.size(); ++i) {
    const auto c = static_cast<unsigned char>(shown[i]);
    // U+0080 to U+009F are control characters too.
    const bool second_control = c == 0xC2U && i + 1 < shown.size() && static_cast<unsigned char>(shown[i + 1]) < 0xA0U;
    if (c < 0x20U || c == 0x7FU || (c >= 0x80U && ascii_only)) shown[i] = '?';
    if (second_control && !ascii_only) shown[i] = shown[i + 1] = '?';
  }
  return shown;
}

std::string_view without_mark(std::string_view text) {
  constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
  return text.starts_with(byte_order_mark) ? text.substr(byte_order_mark.size()) : text;
}

std::string shortened(std::string_view text, std::size_t longest) {
  if (text.size() <= longest) return std::string(text);
  std::size_t cut = longest;
  while (cut > 0 && (static_cast<unsigned char>(text[cut]) & 0xC0U) == 0x80U) --cut;
  return fmt::format("{}...", text.substr(0, cut));
}

std::uintmax_t physical_memory_bytes() {
  const long pages = ::sysconf(_SC_PHYS_PAGES), page_bytes = ::sysconf(_SC_PAGESIZE);
  if (pages <= 0 || page_bytes <= 0) return std::numeric_limits<std::uintmax_t>::max();
  return static_cast<std::uintmax_t>(pages) * static_cast<std::uintmax_t>(page_bytes);
}

std::uintmax_t available_memory_bytes() {
  std::uintmax_t available = physical_memory_bytes();
  std::ifstream meminfo("/proc/meminfo");
  for (std::string line; std::getline(meminfo, line);) {
    std::uintmax_t kib = 0;
    if (std::sscanf(line.c_str(), "MemAvailable: %ju kB", &kib) == 1) available = std::min(available, kib * 1024);
  }
  constexpr std::string_view second_version = "0::";
  std::ifstream groups("/proc/self/cgroup");
  for (std::string line; std::getline(groups, line);) {
    if (!line.starts_with(second_version)) continue;
    available = std::min(available, memory_left_by_groups("/sys/fs/cgroup", line.substr(second_version.size())));
  }
  return available;
}

std::uintmax_t memory_left_by_groups(const fs::path& root, const fs::path& group) {
  std::uintmax_t left = std::numeric_limits<std::uintmax_t>::max();
  fs::path folder = root;
  const auto add = [&] {
    std::uintmax_t limit = 0, used = 0;  // the limit reads "max" if there is none
    std::ifstream limit_file(folder / "memory.max"), used_file(folder / "memory.current");
    if (limit_file >> limit && used_file >> used) left = std::min(left, limit - std::min(limit, used));
  };
  add();
  for (const fs::path& part : group.relative_path()) {
    folder /= part;
    add();
  }
  return left;
}

void expect_file(const fs::path& file) {
  std::error_code code;
  const fs::file_status status = fs::status(file, code);
  if (status.type() == fs::file_type::not_found) {
    throw MissingFile(three_part_message(fmt::format("{}: cannot be read", printable(file.string())), "there is no such file",
                                         "check the name and the folder"));
  }
  if (code) refuse_read(file, code.message(), "check the path and its permissions");
  if (fs::is_directory(status)) refuse_read(file, "it is a directory", "name a file");
  if (!fs::is_regular_file(status)) refuse_read(file, "it is not a regular file", "name a file on disk");
}

void expect_folder_of(const fs::path& file) {
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  std::error_code error;
  if (!fs::is_directory(folder, error))
    throw_failure(printable(file.string()), "its folder does not exist", "create the folder first");
  if (::access(folder.c_str(), W_OK) != 0)
    throw_failure(printable(file.string()), "its folder cannot be written", "name another place with -o");
}

std::string read_file(const fs::path& file, std::uintmax_t most_bytes) {
  expect_file(file);
  const Handle handle = open(file, "rb");
  if (!handle) refuse_read(file, std::strerror(errno), "check its permissions");
  std::error_code code;
  const std::uintmax_t size = fs::file_size(file, code);
  if (code) refuse_read(file, code.message(), "check the path and its permissions");
  if (const std::uintmax_t most = std::min(most_bytes, physical_memory_bytes()); size > most)
    refuse_read(file, fmt::format("it has {} bytes, but at most {} are allowed", size, most), "use a smaller file");
  std::string bytes(size, '\0');
  const std::size_t got = std::fread(bytes.data(), 1, bytes.size(), handle.get());
  if (std::ferror(handle.get()) != 0) refuse_read(file, std::strerror(errno), "check the disk");
  if (got != bytes.size()) refuse_read(file, "it was truncated while being read", "try again when it is complete");
  return bytes;
}

std::string_view write_cure(int code) {
  switch (code) {
    case ENOSPC:
    case EDQUOT:
      return "free some space or choose another disk";
    case EFBIG:
      return "raise the limit of file sizes (ulimit -f) or choose another disk";
    case ENOENT:
    case ENOTDIR:
      return "create its folder first";
    case EISDIR:
      return "remove that folder or choose another name";
    case EIO:
      return "check the disk";
    default:
      return "choose a folder with write permission";
  }
}

void write_file(const fs::path& file, std::string_view bytes) {
  write_file(file, [&](std::ostream& out) { out.write(bytes.data(), static_cast<std::streamsize>(bytes.size())); });
}

void write_file(const fs::path& file, const std::function<void(std::ostream&)>& write) {
  check_writable(file);
  const fs::path aside = fmt::format("{}.{}.tmp", file.string(), ::getpid());
  ::unlink(aside.c_str());
  const int number = ::open(aside.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, new_file_mode);
  if (number < 0) refuse_write(file, errno);
  int code = 0;
  try {
    OpenFile open_file(number);
    std::ostream stream(&open_file);
    stream.exceptions(std::ios::badbit);  // or formatted output would swallow std::bad_alloc
    write(stream);
    code = open_file.close(Wait::for_disk);
  } catch (...) {
    ::unlink(aside.c_str());
    throw;
  }
  if (code == 0) code = put_in_place(file, aside);
  expect_written(file, aside, code);
}

void check_writable(const fs::path& file) {
  if (const int code = protection(file); code != 0) refuse_write(file, code);
}

void replace_file(const fs::path& file, const fs::path& aside) {
  int code = sync_file(aside);
  if (code == 0) code = put_in_place(file, aside);
  expect_written(file, aside, code);
}

void append_aside(const fs::path& file, const fs::path& aside, std::string_view bytes) {
  const int number = ::open(aside.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, new_file_mode);
  if (number < 0) refuse_write(file, errno);
  OpenFile open_file(number);
  open_file.put(bytes);
  expect_written(file, aside, open_file.close(Wait::no));
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  std::vector<fs::path> parents;  // parents that get a new entry
  for (fs::path at = folder; !at.empty() && !fs::exists(at, error); at = at.parent_path()) parents.push_back(at.parent_path());
  fs::create_directories(folder, error);
  if (error) throw_failure(printable(folder.string()), error.message(), "choose a writable folder with -o");
  for (const fs::path& parent : parents) {
    if (const int code = sync_folder(parent); code != 0) refuse_write(folder, code);
  }
}

bool is_left_aside(std::string_view name, std::string_view of) {
  constexpr std::string_view ending = ".tmp";
  if (!name.starts_with(of) || !name.ends_with(ending) || name.size() < of.size() + ending.size() + 2) return false;
  const std::string_view number = name.substr(of.size() + 1, name.size() - of.size() - 1 - ending.size());
  return name[of.size()] == '.' && number.find_first_not_of("0123456789") == std::string_view::npos;
}

}  // namespace sunfleck
