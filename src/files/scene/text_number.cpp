#include "files/scene/text_number.h"

#include "base/text_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

namespace sunfleck {
namespace {

// Returns the text with a decimal point and a hyphen for a typographic minus.
std::string in_ascii(std::string_view text) {
  std::string ascii(trimmed(text));
  const std::string_view minus = "\u2212";
  if (ascii.starts_with(minus)) ascii.replace(0, minus.size(), "-");
  if (std::count(ascii.begin(), ascii.end(), ',') == 1) std::replace(ascii.begin(), ascii.end(), ',', '.');
  if (ascii.starts_with('+')) ascii.erase(0, 1);
  return ascii;
}

struct LengthUnit {
  std::string_view word;
  double metres;
};

constexpr LengthUnit length_units[] = {{"m", 1.0},
                                       {"metre", 1.0},
                                       {"metres", 1.0},
                                       {"meter", 1.0},
                                       {"meters", 1.0},
                                       {"dm", 0.1},
                                       {"cm", 0.01},
                                       {"mm", 0.001},
                                       {"in", 0.0254},
                                       {"inch", 0.0254},
                                       {"inches", 0.0254},
                                       {"foot", 0.3048},
                                       {"feet", 0.3048},
                                       {"ft", 0.3048},
                                       {"centimetre", 0.01},
                                       {"centimetres", 0.01},
                                       {"centimeter", 0.01},
                                       {"centimeters", 0.01},
                                       {"millimetre", 0.001},
                                       {"millimetres", 0.001},
                                       {"millimeter", 0.001},
                                       {"millimeters", 0.001}};

std::optional<double> metres_in(std::string_view word) {
  for (const auto& [known, metres] : length_units) {
    if (word == known) return metres;
  }
  return std::nullopt;
}

// Returns whether the key's values are metres per unit of a file.
bool is_scale(std::string_view unit) {
  return unit.find("for a file in cm") != std::string_view::npos;
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
  if (is_scale(unit)) return metres_in(suffix);
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
  if (is_scale(unit)) {
    const auto metres = metres_in(trimmed(text));
    if (metres) return fmt::format("write the metres that a unit of the file has, without quotes: {:.12g}", *metres);
  }
  const bool begins_with_number = !text.empty() && text.find_first_of("0123456789") <= 1;
  return begins_with_number ? fmt::format("write the number alone, without quotes and unit ({})", unit)
                            : fmt::format("give a number, without quotes ({})", unit);
}

}  // namespace sunfleck
