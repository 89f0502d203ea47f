#include "files/scene/scene_patterns.h"

#include "base/file.h"
#include "base/text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <utility>

namespace sunfleck {

namespace {

constexpr std::size_t most_shown = 12;  // names in a message

std::u32string letters_of(std::string_view text) {
  const std::string lower = lower_case(text);
  std::u32string letters;
  for (std::string_view rest = lower; !rest.empty();) letters.push_back(take_code_point(rest).value_or(U'\uFFFD'));
  return letters;
}

// Returns the names for a message, the first ones if there are many.
std::string listed(const std::set<std::string>& names) {
  std::vector<std::string> shown;
  for (const std::string& name : names) {
    if (shown.size() == most_shown) break;
    shown.push_back(printable(name));
  }
  const std::string text = fmt::format("{}", fmt::join(shown, ", "));
  return names.size() > most_shown ? fmt::format("{} and {} more", text, names.size() - most_shown) : text;
}

// Returns the names by which patterns find an organ: its name, and if it has a rank, also NAME RANK, such as `leaf 7`.
std::vector<std::string> names_of(const Organ& organ) {
  if (organ.rank == 0) return {organ.name};
  return {organ.name, fmt::format("{} {}", organ.name, organ.rank)};
}

bool matches_any(const std::string& pattern, const std::vector<std::string>& names) {
  return std::any_of(names.begin(), names.end(), [&](const std::string& name) { return matches_pattern(pattern, name); });
}

// The pairs of material and organ that share triangles, each with the rule that applies.
class Choices {
 public:
  Choices(const std::vector<OpticsRule>& rules, const Mesh& mesh) : rules_(rules), mesh_(mesh) {
    for (const std::string& name : mesh.optics_names) by_material_.push_back(first_match({name}));
    for (const Organ& organ : mesh.organs) by_organ_.push_back(first_match(names_of(organ)));
  }

  // Returns the index of the first rule that covers the triangle.
  [[nodiscard]] std::optional<std::size_t> rule_of(std::size_t triangle) const {
    const auto& material = by_material_[mesh_.optics_of[triangle]];
    const auto& organ = by_organ_[mesh_.organ_of[triangle]];
    if (!material || !organ) return material ? material : organ;
    return std::min(*material, *organ);
  }

 private:
  [[nodiscard]] std::optional<std::size_t> first_match(const std::vector<std::string>& names) const {
    for (std::size_t r = 0; r < rules_.size(); ++r) {
      if (matches_any(rules_[r].pattern, names)) return r;
    }
    return std::nullopt;
  }

  const std::vector<OpticsRule>& rules_;
  const Mesh& mesh_;
  std::vector<std::optional<std::size_t>> by_material_, by_organ_;
};

void warn_of_idle_patterns(const TomlTable& geometry, const std::vector<OpticsRule>& rules, const Mesh& mesh,
                           std::vector<std::string>& warnings) {
  const std::set<std::string> materials(mesh.optics_names.begin(), mesh.optics_names.end());
  std::set<std::string> names = materials;
  for (const Organ& organ : mesh.organs) names.insert(organ.name);
  for (const OpticsRule& rule : rules) {
    if (matches_any(rule.pattern, {names.begin(), names.end()})) continue;
    const auto matches = [&](const Organ& organ) { return matches_any(rule.pattern, names_of(organ)); };
    if (std::any_of(mesh.organs.begin(), mesh.organs.end(), matches)) continue;
    warnings.push_back(fmt::format("{} matches nothing; the names there are: {}", geometry.table("optics")->place(rule.pattern),
                                   listed(names)));
  }
}

}  // namespace

bool matches_pattern(std::string_view pattern, std::string_view name) {
  const std::u32string wanted = letters_of(pattern);
  const std::u32string letters = letters_of(name);
  std::size_t p = 0, n = 0;
  std::size_t star = wanted.npos, behind_star = 0;  // the last `*`, and the letters that it stands for end here
  while (n < letters.size()) {
    if (p < wanted.size() && wanted[p] == U'*') {
      star = p++;
      behind_star = n;
    } else if (p < wanted.size() && (wanted[p] == U'?' || wanted[p] == letters[n])) {
      ++p;
      ++n;
    } else if (star != wanted.npos) {
      p = star + 1;
      n = ++behind_star;
    } else {
      return false;
    }
  }
  return wanted.find_first_not_of(U'*', p) == wanted.npos;
}

std::vector<OpticsRule> read_optics_rules(const TomlTable& geometry) {
  if (!geometry.has("optics")) return {};
  if (!geometry.is_table("optics") && !geometry.is_text("optics")) {
    geometry.refuse("optics", "it must be the name of an [optics.NAME], or a table of patterns",
                    "write \"leaf\", or { \"leaf*\" = \"leaf\", \"*\" = \"stem\" }");
  }
  if (!geometry.is_table("optics")) return {{"*", *geometry.text("optics")}};
  const TomlTable table = *geometry.table("optics");
  std::vector<OpticsRule> rules;
  for (const std::string& pattern : table.keys_as_written()) {
    if (!table.is_text(pattern)) {
      table.refuse(pattern, "a pattern needs the name of an [optics.NAME]",
                   "write \"*\" = \"leaf\" here, and its reflectance under [optics.leaf]");
    }
    rules.push_back({pattern, *table.text(pattern)});
  }
  if (rules.empty()) geometry.refuse("optics", "it has no pattern", "write { \"leaf*\" = \"leaf\", \"*\" = \"stem\" }");
  return rules;
}

void apply_optics_rules(const TomlTable& geometry, const std::vector<OpticsRule>& rules, Mesh& mesh,
                        std::vector<std::string>& warnings) {
  if (rules.empty()) return;
  if (geometry.is_table("optics")) warn_of_idle_patterns(geometry, rules, mesh, warnings);
  const Choices choices(rules, mesh);
  std::vector<std::string> names;
  std::map<std::string, std::uint32_t> number_of;
  std::vector<std::uint32_t> optics_of;
  optics_of.reserve(mesh.triangles.size());
  std::set<std::string> uncovered;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const std::optional<std::size_t> rule = choices.rule_of(t);
    if (!rule) {
      uncovered.insert(mesh.optics_names[mesh.optics_of[t]]);
      continue;
    }
    const auto [place, fresh] = number_of.try_emplace(rules[*rule].optics, static_cast<std::uint32_t>(names.size()));
    if (fresh) names.push_back(rules[*rule].optics);
    optics_of.push_back(place->second);
  }
  if (!uncovered.empty()) {
    geometry.refuse("optics", fmt::format("no pattern matches the materials {}", listed(uncovered)),
                    "add patterns for them, or \"*\" = \"NAME\" at the end for all the rest");
  }
  mesh.optics_names = std::move(names);
  mesh.optics_of = std::move(optics_of);
}

}  // namespace sunfleck
