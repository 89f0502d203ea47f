#include "programs/cli/option_checks.h"

#include "base/suggestions.h"
#include "simulate/requests.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

namespace sunfleck {
namespace {

// Parses decimal digits, or a number such as 1e6 that is whole and that a double holds exactly.
std::optional<std::uint64_t> whole_number_of(const std::string& text) {
  const char* const end = text.data() + text.size();
  std::uint64_t whole = 0;
  const auto [whole_end, whole_error] = std::from_chars(text.data(), end, whole);
  if (whole_error == std::errc() && whole_end == end) return whole;
  double value = 0.0;
  const auto [value_end, value_error] = std::from_chars(text.data(), end, value);
  const bool exact = value >= 0.0 && value <= 9007199254740992.0 && value == std::floor(value);
  if (value_error != std::errc() || value_end != end || !exact) return std::nullopt;
  return static_cast<std::uint64_t>(value);
}

}  // namespace

CLI::Validator relative_error() {
  return {[](const std::string& text) {
            double value = 0.0;
            const bool good = CLI::detail::lexical_cast(text, value) && value > 0.0 && value < 1.0;
            return good ? std::string()
                        : fmt::format("{} (must be a number between 0 and 1, with a decimal point: give 0.02 for 2 percent)",
                                      text);
          },
          "0..1"};
}

CLI::Validator positive() {
  return {[](const std::string& text) {
            double value = 0.0;
            const bool good = CLI::detail::lexical_cast(text, value) && value > 0.0 && std::isfinite(value);
            return good ? std::string() : fmt::format("{} (must be a positive number)", text);
          },
          ">0"};
}

CLI::Validator not_empty() {
  return {[](const std::string& text) { return text.empty() ? "\"\" (must not be empty)" : std::string(); }, ""};
}

CLI::Validator whole_number(std::uint64_t lo, std::uint64_t hi) {
  const std::string range = fmt::format("{}..{}", lo, hi);
  return {[=](std::string& text) {
            const std::optional<std::uint64_t> value = whole_number_of(text);
            if (!value || *value < lo || *value > hi) return fmt::format("{} (must be a whole number in {})", text, range);
            text = std::to_string(*value);
            return std::string();
          },
          range};
}

CLI::Validator number(double lo, double hi) {
  const std::string range = fmt::format("{}..{}", lo, hi);
  return {[=](const std::string& text) {
            double value = 0.0;
            const bool good = CLI::detail::lexical_cast(text, value) && value >= lo && value <= hi;
            return good ? std::string() : fmt::format("{} (must be a number in {})", text, range);
          },
          range};
}

CLI::Validator memory_size() {
  constexpr std::uint64_t least_bytes = 1'000'000;
  constexpr std::uint64_t most_bytes = 1'000'000'000'000'000;
  return {[](std::string& text) {
            const std::string given = text;
            text.erase(0, std::min(text.find_first_not_of('0'), text.size()));  // CLI11 would take it for octal
            std::optional<std::uint64_t> bytes;
            try {
              CLI::AsSizeValue(true)(text);
              bytes = whole_number_of(text);
            } catch (const CLI::ValidationError&) {  // an unknown unit, or far too much
            }
            if (bytes && *bytes >= least_bytes && *bytes <= most_bytes) {
              text = std::to_string(*bytes);
              return std::string();
            }
            return fmt::format("{} (must be a whole number with a unit, 1MB to 1000TB, such as 500MB or 2GB)", given);
          },
          "SIZE"};
}

CLI::Validator without_blanks() {
  return {[](std::string& text) {
            CLI::detail::trim(text);
            return std::string();
          },
          ""};
}

CLI::Validator device_kind() {
  return {[](std::string& text) {
            text = device_word(text);
            return std::string();
          },
          ""};
}

CLI::Validator one_of(const std::vector<std::string>& words) {
  const std::string list = fmt::format("{}", fmt::join(words, ", "));
  return {[=](const std::string& text) {
            if (std::find(words.begin(), words.end(), text) != words.end()) return std::string();
            if (const auto nearest = nearest_word(text, words))
              return fmt::format("{} (unknown); did you mean {}?", text, *nearest);
            return fmt::format("{} (must be one of: {})", text, list);
          },
          ""};
}

}  // namespace sunfleck
