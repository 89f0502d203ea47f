#pragma once
// Tools for text that know nothing of files.

#include <string>
#include <string_view>

namespace sunfleck {

// Returns the text with the letters A to Z in lower case.
[[nodiscard]] inline std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& c : lower) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return lower;
}

}  // namespace sunfleck
