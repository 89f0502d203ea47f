#pragma once
// Parses TOML, adds checks that toml++ lacks, and reports its errors on one line.

#include <toml++/impl/forward_declarations.h>

#include <memory>
#include <string>
#include <string_view>

namespace sunfleck {

// Returns the tree of a text. Messages refer to it as `file`, a printable name. Throws Error (input), one line, if it is empty,
// not UTF-8 or not valid TOML.
[[nodiscard]] std::shared_ptr<const toml::table> parse_toml(const std::string& file, std::string_view text);

}  // namespace sunfleck
