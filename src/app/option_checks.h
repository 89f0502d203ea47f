#pragma once
// What CLI11 checks a value with. A message reads `VALUE (why)`.

#include <CLI/CLI.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace sunfleck {

[[nodiscard]] CLI::Validator relative_error();  // above 0, below 1
[[nodiscard]] CLI::Validator positive();        // and finite
[[nodiscard]] CLI::Validator not_empty();

// To be used with transform(): it rewrites the number in digits, as CLI11 alone would wrap -1 round and read 010 as octal.
// Takes 1e6 too.
[[nodiscard]] CLI::Validator whole_number(std::uint64_t lo, std::uint64_t hi);

// To be used with transform(), for the items of a list: takes the blanks around one away.
[[nodiscard]] CLI::Validator without_blanks();

// To be used with transform(): the kinds of devices in lower case; other words, which are names, stay.
[[nodiscard]] CLI::Validator device_kind();

[[nodiscard]] CLI::Validator one_of(const std::vector<std::string>& words);

}  // namespace sunfleck
