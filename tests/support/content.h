#pragma once

#include <filesystem>
#include <string>

namespace sunfleck::test {

// Returns all bytes of a file; none if it cannot be read.
[[nodiscard]] std::string content(const std::filesystem::path& file);

}  // namespace sunfleck::test
