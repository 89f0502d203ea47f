#include "physics/canopy/role.h"

#include <algorithm>
#include <cctype>
#include <string>
#include <utility>
#include <vector>

namespace sunfleck {
namespace {

using RoleOfWord = std::pair<std::string_view, Role>;

// Words that also count at the beginning or the end of a longer word: flagleaf, leafblade, mainstem.
constexpr RoleOfWord parts[] = {{"leaf", Role::leaf},      {"leaves", Role::leaf},  {"blade", Role::leaf},
                                {"lamina", Role::leaf},    {"petiole", Role::stem}, {"stem", Role::stem},
                                {"internode", Role::stem}, {"trunk", Role::stem},   {"branch", Role::stem},
                                {"fruit", Role::fruit},    {"tassel", Role::fruit}, {"flower", Role::fruit},
                                {"luminaire", Role::lamp}};

// Words that count as whole words and in the plural, because longer words contain them by accident: bear, clamp, wallet.
constexpr RoleOfWord words[] = {{"stalk", Role::stem},        {"culm", Role::stem},
                                {"twig", Role::stem},         {"wood", Role::stem},
                                {"bark", Role::stem},         {"metamer", Role::stem},
                                {"sheath", Role::stem},       {"rachis", Role::stem},
                                {"peduncle", Role::stem},     {"shoot", Role::stem},
                                {"ear", Role::fruit},         {"cob", Role::fruit},
                                {"pod", Role::fruit},         {"berry", Role::fruit},
                                {"berries", Role::fruit},     {"panicle", Role::fruit},
                                {"spike", Role::fruit},       {"grain", Role::fruit},
                                {"boll", Role::fruit},        {"inflorescence", Role::fruit},
                                {"panel", Role::structure},   {"wall", Role::structure},
                                {"floor", Role::structure},   {"ceiling", Role::structure},
                                {"roof", Role::structure},    {"pot", Role::structure},
                                {"post", Role::structure},    {"pole", Role::structure},
                                {"wire", Role::structure},    {"trellis", Role::structure},
                                {"bench", Role::structure},   {"gutter", Role::structure},
                                {"frame", Role::structure},   {"structure", Role::structure},
                                {"chamber", Role::structure}, {"fence", Role::structure},
                                {"lamp", Role::lamp},         {"led", Role::lamp},
                                {"bulb", Role::lamp},         {"soil", Role::soil}};

// Words that mean the soil where they are the whole name: a ground cover is a plant.
constexpr std::string_view soil_alone[] = {"ground", "earth"};

bool is_letter(char c) {
  return std::isalpha(static_cast<unsigned char>(c)) != 0;
}

std::vector<std::string> words_of(std::string_view name) {
  std::vector<std::string> found;
  bool inside = false;
  bool small = false;  // the letter before is a small one
  for (const char c : name) {
    const bool capital = std::isupper(static_cast<unsigned char>(c)) != 0;
    if (is_letter(c)) {
      if (!inside || (small && capital)) found.emplace_back();
      found.back() += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    }
    inside = is_letter(c);
    small = inside && !capital;
  }
  return found;
}

std::optional<Role> role_of_word(std::string_view word) {
  for (const auto& [known, role] : words) {
    if (word == known || (word.starts_with(known) && word.substr(known.size()) == "s")) return role;
  }
  if (word.ends_with("system") || word.ends_with("systems")) return std::nullopt;  // holds no stem
  for (const auto& [part, role] : parts) {
    const std::string_view singular = word.ends_with('s') ? word.substr(0, word.size() - 1) : word;
    if (word.starts_with(part) || word.ends_with(part) || singular.ends_with(part)) return role;
  }
  return std::nullopt;
}

}  // namespace

std::optional<Role> role_from_name(std::string_view name) {
  const std::vector<std::string> found = words_of(name);
  if (found.size() == 1 && std::find(std::begin(soil_alone), std::end(soil_alone), found.front()) != std::end(soil_alone)) {
    return Role::soil;
  }
  for (auto word = found.rbegin(); word != found.rend(); ++word) {
    if (const auto role = role_of_word(*word)) return role;
  }
  return std::nullopt;
}

}  // namespace sunfleck
