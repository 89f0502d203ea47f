#include "files/scene/text_number.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

namespace sunfleck {
namespace {

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

// Returns the text with a decimal point and a hyphen for a typographic minus.
std::string in_ascii(std::string_view text) {
  std::string ascii(trimmed(text));
  const std::string_view minus = "\u2212";
  if (ascii.starts_with(minus)) ascii.replace(0, minus.size(), "-");
  if (std::count(ascii.begin(), ascii.end(), ',') == 1) std::replace(ascii.begin(), ascii.end(), ',', '.');
  if (ascii.starts_with('+')) ascii.erase(0, 1);
  return ascii;
}

// Returns by what to multiply a number with that suffix; nothing if the suffix does not fit the unit.
std::optional<double> factor_of(std::string_view suffix, std::string_view unit) {
  if (suffix.empty()) return 1.0;
  if (suffix == "%") return 0.01;
  if (unit.find("metres") != std::string_view::npos) {
    if (suffix == "m") return 1.0;
    if (suffix == "cm") return 0.01;
    if (suffix == "mm") return 0.001;
  }
  if (unit.find("degrees") != std::string_view::npos) {
    if (suffix.starts_with("\u00b0")) suffix = trimmed(suffix.substr(2));
    if (suffix.empty() || suffix == "N" || suffix == "E" || suffix == "deg" || suffix == "degrees") return 1.0;
    if (suffix == "S" || suffix == "W") return -1.0;
  }
  return std::nullopt;
}

}  // namespace

std::optional<double> number_in_text(std::string_view text, std::string_view unit) {
  const std::string ascii = in_ascii(text);
  double value = 0.0;
  const char* const end = ascii.data() + ascii.size();
  const auto [rest, error] = std::from_chars(ascii.data(), end, value);
  if (error != std::errc()) return std::nullopt;
  const auto factor = factor_of(trimmed({rest, static_cast<std::size_t>(end - rest)}), unit);
  if (!factor) return std::nullopt;
  // Dividing gives the decimal fraction that a factor of 0.01 would miss by rounding.
  return *factor > 0.0 && *factor < 1.0 ? value / (1.0 / *factor) : value * *factor;
}

std::string cure_of_text(std::string_view text, std::string_view unit) {
  const auto number = number_in_text(text, unit);
  if (number) return fmt::format("write it without quotes and unit: {:.12g}", *number);
  const bool begins_with_number = !text.empty() && text.find_first_of("0123456789") <= 1;
  return begins_with_number ? fmt::format("write the number alone, without quotes and unit ({})", unit)
                            : "write it without quotes, or give a number";
}

}  // namespace sunfleck
