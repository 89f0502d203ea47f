#pragma once
// Reads numbers that were written as texts, only to advise what to write instead.

#include <optional>
#include <string>
#include <string_view>

namespace sunfleck {

// Returns the number that a text such as "50 cm", "48.85N" or "0,5" means for a key whose values `unit` describes: lengths in
// metres if it names metres, degrees with the sign of N, S, E or W if it names degrees, 0.1 for "10 %". Returns nothing if the
// text is anything else.
[[nodiscard]] std::optional<double> number_in_text(std::string_view text, std::string_view unit);

// Returns what to write instead of a text where a number is wanted.
[[nodiscard]] std::string cure_of_text(std::string_view text, std::string_view unit);

}  // namespace sunfleck
