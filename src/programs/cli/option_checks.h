#pragma once
// CLI11 validators for option values. Their messages read `VALUE (why)` or `VALUE (why); what would be right`.

#include <CLI/CLI.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace sunfleck {

[[nodiscard]] CLI::Validator relative_error();  // above 0, below 1
[[nodiscard]] CLI::Validator positive();        // and finite
[[nodiscard]] CLI::Validator not_empty();
[[nodiscard]] CLI::Validator number(double lo, double hi);

// Use with transform(): rewrites the number in decimal digits, because CLI11 alone would wrap -1 around and read 010 as octal.
// Accepts 1e6 too.
[[nodiscard]] CLI::Validator whole_number(std::uint64_t lo, std::uint64_t hi);

// Use with transform(): turns a size such as 500MB into bytes; kB, MB and GB are powers of 1000, KiB, MiB and GiB of 1024.
[[nodiscard]] CLI::Validator memory_size();

// Use with transform() for the items of a list: trims the blanks around each item.
[[nodiscard]] CLI::Validator without_blanks();

// Use with transform(): turns the device kinds into lower case and leaves any other word, a device name, as it is.
[[nodiscard]] CLI::Validator device_kind();

[[nodiscard]] CLI::Validator one_of(const std::vector<std::string>& words);

}  // namespace sunfleck
