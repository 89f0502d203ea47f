#include "physics/canopy/role.h"

#include "base/text.h"

#include <algorithm>
#include <span>
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
                                {"fruit", Role::fruit},    {"tassel", Role::fruit}, {"luminaire", Role::lamp}};

// Words that count as whole words and in the plural, because longer words contain them by accident: bear, clamp, wallet,
// sunflower.
constexpr std::string_view stems[] = {"stalk",   "culm",   "twig",   "wood",     "bark",
                                      "metamer", "sheath", "rachis", "peduncle", "shoot"};
constexpr std::string_view fruits[] = {"ear",   "cob",   "pod",  "berry",         "berries", "panicle",
                                       "spike", "grain", "boll", "inflorescence", "flower"};
constexpr std::string_view structures[] = {"panel",  "wall",  "floor",     "ceiling", "roof",    "pot",
                                           "post",   "pole",  "stake",     "wire",    "trellis", "bench",
                                           "gutter", "frame", "structure", "chamber", "fence",   "flowerpot"};
constexpr std::string_view lamps[] = {"lamp", "led"};
constexpr std::string_view soils[] = {"soil"};

using WordsOfRole = std::pair<std::span<const std::string_view>, Role>;
constexpr WordsOfRole words[] = {
    {stems, Role::stem}, {fruits, Role::fruit}, {structures, Role::structure}, {lamps, Role::lamp}, {soils, Role::soil}};

// Words for whole plants. What comes before them tells their kind or place: a pole bean is no pole, a pot plant no pot.
constexpr std::string_view plants[] = {"plant", "crop", "tree", "shrub", "bush", "vine", "weed", "grass", "bean", "seedling"};

// Words that mean the soil where they are the whole name: a ground cover is a plant.
constexpr std::string_view soil_alone[] = {"ground", "earth"};

std::vector<std::string> words_of(std::string_view name) {
  std::vector<std::string> found;
  bool inside = false;
  bool small = false;  // the letter before is a small one
  for (const char c : name) {
    if (is_letter(c)) {
      if (!inside || (small && is_capital(c))) found.emplace_back();
      found.back() += c;
    }
    inside = is_letter(c);
    small = inside && !is_capital(c);
  }
  for (std::string& word : found) word = lower_case(word);
  return found;
}

bool is_word_or_plural(std::string_view word, std::string_view known) {
  if (!word.starts_with(known)) return false;
  const std::string_view ending = word.substr(known.size());
  return ending.empty() || ending == "s" || ending == "es";
}

bool is_one_of(std::span<const std::string_view> list, std::string_view word) {
  return std::any_of(list.begin(), list.end(), [&](std::string_view known) { return is_word_or_plural(word, known); });
}

std::optional<Role> role_of_word(std::string_view word) {
  for (const auto& [list, role] : words) {
    if (is_one_of(list, word)) return role;
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
  bool plant = false;
  for (auto word = found.rbegin(); word != found.rend(); ++word) {
    plant = plant || is_one_of(plants, *word);
    const auto role = role_of_word(*word);
    if (role && plant && !is_vegetation(*role)) return std::nullopt;
    if (role) return role;
  }
  return std::nullopt;
}

}  // namespace sunfleck
