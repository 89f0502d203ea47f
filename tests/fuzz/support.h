#pragma once
// Functions shared by the fuzz targets.

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace sunfleck::fuzz {

// Ends the process with a line on standard error if a promise is broken.
void promise(bool kept, std::string_view what);

// Runs the work; a refusal must be one line in three parts.
void read_or_refuse(const std::function<void()>& work);

// Returns a folder of this process, which is created once, with the files that others may name, and removed at the end.
[[nodiscard]] const std::filesystem::path& folder();

// Writes a file into that folder and returns its path.
std::filesystem::path write(const std::string& name, std::string_view bytes);

}  // namespace sunfleck::fuzz
