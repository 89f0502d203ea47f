#pragma once
// Suggestions for misspelt words.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sunfleck {

// Returns the candidate nearest to `word`, ignoring case: at most two edits away, and no more than half the letters. Returns
// nothing if there is none.
[[nodiscard]] std::optional<std::string> nearest_word(std::string_view word, const std::vector<std::string>& candidates);

// Returns "did you mean X?" if there is a nearest word, otherwise `otherwise`.
[[nodiscard]] std::string did_you_mean(std::string_view word, const std::vector<std::string>& candidates,
                                       std::string_view otherwise);

}  // namespace sunfleck
