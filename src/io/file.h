#pragma once
// Whole files in and out.

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace sunfleck {

inline constexpr std::uintmax_t largest_file_bytes = std::uintmax_t{16} << 30U;

// The bytes of a regular file. Throws Error (input) if it is missing, no regular file or unreadable, and before memory for it
// is taken if it is longer than `most_bytes` or than this machine's memory.
[[nodiscard]] std::string read_file(const std::filesystem::path& file, std::uintmax_t most_bytes = largest_file_bytes);

// Of this machine; the largest number where the system does not say.
[[nodiscard]] std::uintmax_t physical_memory_bytes();

// Returns how much memory this process could still take: what the system has to give, or what its control group has left if
// that is less. The machine's memory where the system tells neither.
[[nodiscard]] std::uintmax_t available_memory_bytes();

// Writes aside, in the same folder, and renames, so that the file is whole or not there, whatever ends the program. It waits
// until the disk has the bytes before it renames, and until the disk has the new name before it returns (fsync of the file and
// of the folder), so that this holds for a power cut too; where the file system does not support that, it does not wait. The
// folder must exist; a file that is write-protected stays. Throws Error (failure); if only the folder could not be brought to
// the disk, the file is there all the same.
void write_file(const std::filesystem::path& file, std::string_view bytes);

// Puts the finished `aside` in the place of `file`, on the same file system, and waits for the disk as write_file does. Throws
// Error (failure), and removes `aside`.
void replace_file(const std::filesystem::path& file, const std::filesystem::path& aside);

// Makes the folder and those above it where they are missing, and waits until the disk has them. Throws Error (failure).
void make_folder(const std::filesystem::path& folder);

// Throws Error (failure) for what write_file would refuse to replace.
void check_writable(const std::filesystem::path& file);

// Whether `name` is what a program that was killed left of writing a file called `of`.
[[nodiscard]] bool is_left_aside(std::string_view name, std::string_view of);

// What helps against the reason, an errno, that a file could not be written.
[[nodiscard]] std::string_view write_cure(int code);

// True for text that is UTF-8 without overlong forms and surrogates (RFC 3629).
[[nodiscard]] bool is_utf8(std::string_view text);

// A name or a piece of a file as a one-line message shows it: control characters become '?', and so does all beyond ASCII in a
// text that is not UTF-8.
[[nodiscard]] std::string printable(std::string_view text);

// The text behind a UTF-8 byte order mark, where it begins with one.
[[nodiscard]] std::string_view without_mark(std::string_view text);

// The text itself, or its first `longest` bytes and "...", not cut inside a UTF-8 character.
[[nodiscard]] std::string shortened(std::string_view text, std::size_t longest);

}  // namespace sunfleck
