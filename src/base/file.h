#pragma once
// Reading and writing of whole files.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <iosfwd>
#include <string>
#include <string_view>

namespace sunfleck {

inline constexpr std::uintmax_t largest_file_bytes = std::uintmax_t{16} << 30U;

// Throws Error (input) if the file is missing or not a regular file.
void expect_file(const std::filesystem::path& file);

// Throws Error (failure) unless the folder in which a file is to be written exists and can be written.
void expect_folder_of(const std::filesystem::path& file);

// Returns the bytes of a regular file. Throws Error (input) if it is missing, not a regular file or unreadable, and also,
// before allocating memory for it, if it is longer than `most_bytes` or than the memory of this machine.
[[nodiscard]] std::string read_file(const std::filesystem::path& file, std::uintmax_t most_bytes = largest_file_bytes);

// Returns the memory of this machine, or the largest number if the system does not report it.
[[nodiscard]] std::uintmax_t physical_memory_bytes();

// Returns how much more memory this process could allocate: the system's available memory, or what its control groups have left
// if that is less. Returns the memory of the machine if the system reports neither.
[[nodiscard]] std::uintmax_t available_memory_bytes();

// Returns how much memory a control group (version 2) and those around it leave, the least of all, or the largest number if
// none has a limit. `group` is its path as /proc/self/cgroup states it, from the root at which the groups are mounted.
[[nodiscard]] std::uintmax_t memory_left_by_groups(const std::filesystem::path& root, const std::filesystem::path& group);

// Writes to a temporary file in the same folder and renames it, so that the file is either complete or absent even if the
// program is killed. To survive a power cut too, it calls fsync on the file before renaming it, and on the folder before
// returning; where the file system does not support fsync, it does not wait. The folder must exist; a write-protected file is
// not replaced. Throws Error (failure); if only the fsync of the folder failed, the new file is in place nevertheless.
void write_file(const std::filesystem::path& file, std::string_view bytes);

// Does the same with what `write` writes to a stream, of which no copy is kept.
void write_file(const std::filesystem::path& file, const std::function<void(std::ostream&)>& write);

// Replaces `file` by the finished `aside`, on the same file system, and waits for the disk as write_file does. Throws Error
// (failure) and removes `aside`.
void replace_file(const std::filesystem::path& file, const std::filesystem::path& aside);

// Appends bytes to `aside`, which is created if it is missing, and which replace_file puts in the place of `file` once it is
// complete. Throws Error (failure), which names `file`, and removes `aside`.
void append_aside(const std::filesystem::path& file, const std::filesystem::path& aside, std::string_view bytes);

// Creates the folder and its missing parents, and waits until they are on the disk. Throws Error (failure).
void make_folder(const std::filesystem::path& folder);

// Throws Error (failure) if write_file would refuse to replace the file.
void check_writable(const std::filesystem::path& file);

// Returns whether `name` is a temporary file left by a program that was killed while it wrote a file named `of`.
[[nodiscard]] bool is_left_aside(std::string_view name, std::string_view of);

// Returns advice for the errno with which writing a file failed.
[[nodiscard]] std::string_view write_cure(int code);

// Returns whether the text is UTF-8 without overlong forms and surrogates (RFC 3629).
[[nodiscard]] bool is_utf8(std::string_view text);

// Returns a name or a piece of a file in a form fit for a one-line message: replaces control characters by '?', and all
// non-ASCII bytes too if the text is not UTF-8.
[[nodiscard]] std::string printable(std::string_view text);

// Returns the text without a leading UTF-8 byte order mark.
[[nodiscard]] std::string_view without_mark(std::string_view text);

// Returns the text itself, or its first `longest` bytes and "...", never cut inside a UTF-8 character.
[[nodiscard]] std::string shortened(std::string_view text, std::size_t longest);

}  // namespace sunfleck
