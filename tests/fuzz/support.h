#pragma once
// What the fuzz targets share.

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace sunfleck::fuzz {

// Ends the process if a promise is broken, with a line on standard error.
void promise(bool kept, std::string_view what);

// Runs the work; a refusal must be one line in three parts.
void read_or_refuse(const std::function<void()>& work);

// A folder of this process, made once with the files that others may name, and removed at the end.
[[nodiscard]] const std::filesystem::path& folder();

// Writes a file there and returns its path.
std::filesystem::path write(const std::string& name, std::string_view bytes);

}  // namespace sunfleck::fuzz
