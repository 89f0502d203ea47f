#include "files/formats/mesh/caribu_label.h"

#include "base/error.h"
#include "base/text.h"
#include "physics/canopy/canopy.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

namespace sunfleck {

namespace {

constexpr std::uint32_t most_plant = 99'999;
constexpr int most_leaf = 999;

[[noreturn]] void refuse(const char* what, std::int64_t number, std::int64_t most) {
  throw_failure(fmt::format("{} {} has no label", what, number), fmt::format("CARIBU labels have numbers 0..{}", most),
                "choose another format");
}

// Returns the species, which has one digit: 2 for leaf2 and stem2, 1 for any other name. The numbers of other names count organs.
unsigned species_of(const std::string& name) {
  constexpr std::string_view species = "123456789";
  const std::string lower = lower_case(name);
  const bool numbered = lower.size() == 5 && (lower.starts_with("leaf") || lower.starts_with("stem"));
  return numbered && species.find(lower.back()) != species.npos ? static_cast<unsigned>(lower.back() - '0') : 1;
}

}  // namespace

std::string caribu_label(const Organ& organ, std::size_t number_in_organ) {
  constexpr std::size_t element_numbers = 1000;
  if (organ.plant > most_plant) refuse("plant", organ.plant, most_plant);
  if (organ.rank < 0 || organ.rank > most_leaf) refuse("leaf", organ.rank, most_leaf);
  const std::optional<Role> role = organ.role ? organ.role : role_from_name(organ.name);
  const unsigned species = role == Role::soil ? 0 : species_of(organ.name);
  const int leaf = role == Role::leaf ? std::max(organ.rank, 1) : 0;
  return fmt::format("{}{:05}{:03}{:03}", species, organ.plant, leaf, number_in_organ % element_numbers);
}

std::string caribu_label_as_read(const Organ& organ, std::uint64_t label) {
  constexpr std::uint64_t below_plant = 1'000'000;
  constexpr std::uint64_t plants = 100'000;
  if (organ.plant > most_plant) refuse("plant", organ.plant, most_plant);
  return fmt::format("{}{:05}{:06}", label / below_plant / plants, organ.plant, label % below_plant);
}

}  // namespace sunfleck
