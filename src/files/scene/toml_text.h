#pragma once
// Pieces of a scene file that the program writes.

#include <string>
#include <string_view>

namespace sunfleck {

// Returns a basic string of TOML. The text must have no control characters.
[[nodiscard]] std::string toml_string(std::string_view text);

// Returns a name as a TOML key, in quotes if it is not a plain name.
[[nodiscard]] std::string toml_key(std::string_view name);

// Throws Error (input) for a file name that a scene cannot hold: it must be UTF-8 without control characters.
void check_nameable(const std::string& name);

}  // namespace sunfleck
