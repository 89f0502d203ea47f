#pragma once
// Tools for text that know nothing of files.

#include <optional>
#include <string>
#include <string_view>

namespace sunfleck {

// Returns the text with the letters A to Z in lower case.
[[nodiscard]] std::string lower_case(std::string_view text);

// Removes the next code point of UTF-8 from the text, which is not empty, and returns it. Returns nothing for invalid bytes, and
// removes at least one of them. Overlong forms, surrogates and values above U+10FFFF are invalid (Unicode 15.0, table 3-7).
[[nodiscard]] std::optional<char32_t> take_code_point(std::string_view& text);

}  // namespace sunfleck
