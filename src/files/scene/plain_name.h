#pragma once
// Names that may stand in the result tables.

#include <string_view>

namespace sunfleck {

// Returns whether a name may head columns or fill cells of the result tables.
[[nodiscard]] bool is_plain_name(std::string_view name);
inline constexpr std::string_view plain_name_rule = "names in tables may have up to 64 letters, digits, _ and -";

}  // namespace sunfleck
