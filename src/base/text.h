#pragma once
// Tools for text that know nothing of files.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace sunfleck {

// Return the text with the letters A to Z in lower case, or a to z in upper case. Unlike those of the C library, which follow the
// locale that a host such as Python sets, these and is_letter are the same everywhere.
[[nodiscard]] std::string lower_case(std::string_view text);
[[nodiscard]] std::string upper_case(std::string_view text);

[[nodiscard]] constexpr bool is_capital(char c) {
  return c >= 'A' && c <= 'Z';
}
[[nodiscard]] constexpr bool is_letter(char c) {
  return is_capital(c) || (c >= 'a' && c <= 'z');
}

[[nodiscard]] constexpr bool is_ascii(char c) {
  return static_cast<unsigned char>(c) < 0x80U;
}

// Returns a number with the name of what is counted, in the plural unless it is one: "1 triangle", "3 triangles".
[[nodiscard]] std::string counted(std::size_t number, std::string_view one);

// Returns a name as a word of a shell's command: in single quotes unless it has only letters, digits and "_-./".
[[nodiscard]] std::string in_shell(std::string_view name);

// Returns text in Latin-1 (ISO 8859-1), where each byte is a character, as UTF-8.
[[nodiscard]] std::string utf8_of_latin1(std::string_view text);

// Removes the next code point of UTF-8 from the text, which is not empty, and returns it. Returns nothing for invalid bytes, and
// removes at least one of them. Overlong forms, surrogates and values above U+10FFFF are invalid (Unicode 15.0, table 3-7).
[[nodiscard]] std::optional<char32_t> take_code_point(std::string_view& text);

}  // namespace sunfleck
