#pragma once
// Recognises meshes by their content, for messages about files whose names do not tell.

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace sunfleck {

// Returns the usual ending, such as ".ply", of the mesh format that the bytes at the beginning of a file belong to; nothing if
// they look like no mesh. Binary .stl files are not recognised.
[[nodiscard]] std::optional<std::string> mesh_ending_of(std::string_view bytes);

// Returns the same for a file; nothing also if it cannot be read.
[[nodiscard]] std::optional<std::string> mesh_ending_of_file(const std::filesystem::path& file);

}  // namespace sunfleck
