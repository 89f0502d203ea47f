#include "io/file.h"

#include "base/error.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <system_error>

namespace sunfleck {

namespace {

namespace fs = std::filesystem;

using Handle = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

Handle open(const fs::path& file, const char* mode) {
  return {std::fopen(file.c_str(), mode), &std::fclose};
}

[[noreturn]] void refuse_read(const fs::path& file, std::string_view why, std::string_view cure) {
  throw_input(fmt::format("{}: cannot be read", printable(file.string())), why, cure);
}

std::string_view write_cure(int code) {
  if (code == ENOSPC || code == EDQUOT) return "free some space or choose another disk";
  if (code == ENOENT || code == ENOTDIR) return "make its folder first";
  return "choose a folder where files may be written";
}

}  // namespace

std::string printable(std::string_view text) {
  std::string shown(text);
  std::replace_if(
      shown.begin(), shown.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; }, '?');
  return shown;
}

std::string read_file(const fs::path& file) {
  std::error_code code;
  const fs::file_status status = fs::status(file, code);
  if (status.type() == fs::file_type::not_found) refuse_read(file, "there is no such file", "check the name and the folder");
  if (code) refuse_read(file, code.message(), "check the path and its permissions");
  if (fs::is_directory(status)) refuse_read(file, "it is a directory", "name a file");
  if (!fs::is_regular_file(status)) refuse_read(file, "it is no regular file", "name a file on disk");

  const Handle handle = open(file, "rb");
  if (!handle) refuse_read(file, std::strerror(errno), "check its permissions");
  std::string bytes(fs::file_size(file, code), '\0');
  if (code) refuse_read(file, code.message(), "check the path and its permissions");
  const std::size_t got = std::fread(bytes.data(), 1, bytes.size(), handle.get());
  if (std::ferror(handle.get()) != 0) refuse_read(file, std::strerror(errno), "check the disk");
  if (got != bytes.size()) refuse_read(file, "it became shorter while it was read", "try again when it is complete");
  return bytes;
}

void write_file(const fs::path& file, std::string_view bytes) {
  const fs::path aside = fmt::format("{}.{}.tmp", file.string(), ::getpid());
  const auto fail = [&](int code) {
    std::remove(aside.c_str());
    throw_failure(fmt::format("{}: cannot be written", printable(file.string())), std::strerror(code), write_cure(code));
  };
  Handle handle = open(aside, "wb");
  if (!handle) fail(errno);
  if (std::fwrite(bytes.data(), 1, bytes.size(), handle.get()) != bytes.size()) fail(errno);
  if (std::fclose(handle.release()) != 0) fail(errno);
  if (std::rename(aside.c_str(), file.c_str()) != 0) fail(errno);
}

}  // namespace sunfleck
