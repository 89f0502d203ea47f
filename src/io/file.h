#pragma once
// Whole files in and out.

#include <filesystem>
#include <string>
#include <string_view>

namespace sunfleck {

// The bytes of a regular file. Throws Error (input) if it is missing, no regular file or unreadable.
[[nodiscard]] std::string read_file(const std::filesystem::path& file);

// Writes aside, in the same folder, and renames, so that the file is whole or not there. The folder must exist.
// Throws Error (failure).
void write_file(const std::filesystem::path& file, std::string_view bytes);

// A name or a piece of a file as a one-line message shows it: control characters become '?'.
[[nodiscard]] std::string printable(std::string_view text);

}  // namespace sunfleck
