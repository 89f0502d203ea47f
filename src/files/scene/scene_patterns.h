#pragma once
// Reads `optics` of a [[geometry]] and gives its surfaces their optics by name.

#include "files/scene/toml_view.h"
#include "physics/canopy/mesh.h"

#include <string>
#include <string_view>
#include <vector>

namespace sunfleck {

// The material of triangles for which a file names none, where `optics` is a table of patterns.
inline constexpr std::string_view unnamed_material = "unnamed";

// Surfaces whose material or organ has a name that matches the pattern have these optics. An organ with a rank also has the
// name NAME RANK, such as `leaf 7`.
struct OpticsRule {
  std::string pattern;
  std::string optics;
};

// Returns whether the whole name matches, ignoring the case of ASCII letters: `*` stands for any characters, also for none, and
// `?` for one.
[[nodiscard]] bool matches_pattern(std::string_view pattern, std::string_view name);

// Returns the rules of `optics`, in the order in which they are written: a single text is one rule for all surfaces. No rules
// without `optics`.
[[nodiscard]] std::vector<OpticsRule> read_optics_rules(const TomlTable& geometry);

// Gives each triangle the optics of the first rule whose pattern matches the name of its material or of its organ. Without
// rules the optics remain those that the materials name. Adds warnings about patterns that match no name. Refuses a mesh with
// materials that no rule covers.
void apply_optics_rules(const TomlTable& geometry, const std::vector<OpticsRule>& rules, Mesh& mesh,
                        std::vector<std::string>& warnings);

}  // namespace sunfleck
