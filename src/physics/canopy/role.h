#pragma once
// The roles of surfaces in a stand, and their recognition by name.

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace sunfleck {

// Leaf area index and sunlit leaf fractions are of leaves; leaves, stems and fruits together are the vegetation.
enum class Role : std::uint8_t { leaf, stem, fruit, structure, lamp, soil };

inline constexpr std::array<std::string_view, 6> role_names = {"leaf", "stem", "fruit", "structure", "lamp", "soil"};  // [role]

[[nodiscard]] constexpr std::string_view role_name(Role role) {
  return role_names[static_cast<std::size_t>(role)];
}

[[nodiscard]] constexpr bool is_vegetation(Role role) {
  return role == Role::leaf || role == Role::stem || role == Role::fruit;
}

// Returns the role that a name suggests, or nothing if it has no word that is known here. Ignores case. Words end at digits and
// other characters that are no letters, and where a capital follows a small letter; the last known word decides, because it is
// the head of an English compound: `stem_leaf` is a leaf. A word for a whole plant hides structures, lamps and soil before it.
[[nodiscard]] std::optional<Role> role_from_name(std::string_view name);

}  // namespace sunfleck
