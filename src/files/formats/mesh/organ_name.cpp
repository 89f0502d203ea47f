#include "files/formats/mesh/organ_name.h"

#include "base/text.h"
#include "base/text_reader.h"

#include <fmt/format.h>

#include <cctype>
#include <cstdint>
#include <limits>

namespace sunfleck {

std::optional<Organ> organ_from_name(std::string_view name) {
  constexpr std::string_view digits = "0123456789";
  constexpr std::string_view prefix = "plant";
  if (const std::size_t dot = name.rfind('.');
      dot != name.npos && dot + 1 < name.size() && name.find_first_not_of(digits, dot + 1) == name.npos)
    name = name.substr(0, dot);
  if (lower_case(name.substr(0, prefix.size())) != prefix) return std::nullopt;
  name.remove_prefix(prefix.size());
  const std::size_t bar = name.find('_');
  if (bar == name.npos) return std::nullopt;
  const auto plant = parse_integer(name.substr(0, bar));
  if (!plant || name.find_first_not_of(digits) != bar || *plant > std::numeric_limits<std::uint32_t>::max())
    return std::nullopt;
  name.remove_prefix(bar + 1);
  const std::size_t last = name.find_last_not_of(digits);
  if (last == name.npos) return std::nullopt;
  Organ organ{static_cast<std::uint32_t>(*plant), std::string(name.substr(0, last + 1)), 0};
  if (last + 1 < name.size()) {
    const bool is_negative = organ.name.ends_with("_-");
    if (is_negative) organ.name.pop_back();
    if (organ.name.size() > 1 && organ.name.ends_with('_')) organ.name.pop_back();
    const auto rank = parse_integer(name.substr(last + 1));
    if (!rank || *rank > std::numeric_limits<int>::max()) return std::nullopt;
    organ.rank = static_cast<int>(is_negative ? -*rank : *rank);
  }
  return organ;
}

std::string node_name(const Organ& organ) {
  constexpr std::string_view joining = "0123456789_.-";  // characters that would run into the rank
  const bool joins = !organ.name.empty() && joining.find(organ.name.back()) != joining.npos;
  const bool ends_in_digit = joins && std::isdigit(static_cast<unsigned char>(organ.name.back())) != 0;
  if (organ.rank == 0 && !ends_in_digit) return fmt::format("plant{}_{}", organ.plant, organ.name);
  return fmt::format("plant{}_{}{}{}", organ.plant, organ.name, joins || organ.rank < 0 ? "_" : "", organ.rank);
}

}  // namespace sunfleck
