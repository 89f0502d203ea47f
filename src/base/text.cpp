#include "base/text.h"

#include <algorithm>
#include <array>

namespace sunfleck {

std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& c : lower) {
    if (is_capital(c)) c = static_cast<char>(c - 'A' + 'a');
  }
  return lower;
}

std::string upper_case(std::string_view text) {
  std::string upper(text);
  for (char& c : upper) {
    if (is_letter(c) && !is_capital(c)) c = static_cast<char>(c - 'a' + 'A');
  }
  return upper;
}

std::string counted(std::size_t number, std::string_view one) {
  return std::to_string(number).append(" ").append(one).append(number == 1 ? "" : "s");
}

std::string in_shell(std::string_view name) {
  const auto plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           std::string_view("_-./").find(c) != std::string_view::npos;
  };
  if (!name.empty() && std::all_of(name.begin(), name.end(), plain)) return std::string(name);
  std::string word = "'";
  for (const char c : name) word += c == '\'' ? "'\\''" : std::string(1, c);
  return word + "'";
}

std::string utf8_of_latin1(std::string_view text) {
  std::string utf8;
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (code >= 0x80) utf8 += static_cast<char>(0xc0U | code >> 6U);
    utf8 += static_cast<char>(code < 0x80 ? code : 0x80U | (code & 0x3fU));
  }
  return utf8;
}

std::optional<char32_t> take_code_point(std::string_view& text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char first = byte(0);
  const std::size_t length = first < 0x80 ? 1 : first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
  constexpr std::array<char32_t, 5> smallest = {0, 0, 0x80, 0x800, 0x10000};
  char32_t value = length == 1 ? first : first & (0xffU >> (length + 1));
  std::size_t used = 1;
  while (used < length && used < text.size() && (byte(used) & 0xc0U) == 0x80U) value = value << 6U | (byte(used++) & 0x3fU);
  const bool lone = length > 1 && first < 0xc2;
  const bool good = used == length && !lone && first < 0xf5 && value >= smallest[length] && value <= 0x10ffff &&
                    (value < 0xd800 || value > 0xdfff);
  text.remove_prefix(lone ? 1 : used);
  return good ? std::optional(value) : std::nullopt;
}

}  // namespace sunfleck
