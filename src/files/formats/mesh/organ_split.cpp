#include "files/formats/mesh/organ_split.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <span>
#include <string>
#include <tuple>
#include <unordered_map>
#include <utility>
#include <vector>

namespace sunfleck {

namespace {

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

using OrganKey = std::tuple<std::uint32_t, std::string, int>;

OrganKey key_of(const Organ& organ) {
  return {organ.plant, organ.name, organ.rank};
}

// A class of triangles of one organ.
struct Group {
  std::uint32_t organ = 0;
  std::uint32_t optics = 0;
};

struct Grouping {
  std::vector<std::uint32_t> group_of;  // [triangle]
  std::vector<Group> groups;            // in the order of their first triangles
};

// Returns the triangles grouped by organ and optics.
Grouping surfaces_of(const Mesh& mesh) {
  Grouping result;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> known;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto [entry, is_new] =
        known.try_emplace({mesh.organ_of[t], mesh.optics_of[t]}, static_cast<std::uint32_t>(result.groups.size()));
    if (is_new) result.groups.push_back({mesh.organ_of[t], mesh.optics_of[t]});
    result.group_of.push_back(entry->second);
  }
  return result;
}

// Returns for each vertex the lowest number in the order of positions; vertices at one position have the same number.
std::vector<std::uint32_t> numbers_of_positions(const Mesh& mesh) {
  const auto key = [&](std::uint32_t v) { return std::tie(mesh.vertices[v].x, mesh.vertices[v].y, mesh.vertices[v].z); };
  std::vector<std::uint32_t> order(mesh.vertices.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
  std::vector<std::uint32_t> numbers(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool is_same = i > 0 && key(order[i]) == key(order[i - 1]);
    numbers[order[i]] = is_same ? numbers[order[i - 1]] : static_cast<std::uint32_t>(i);
  }
  return numbers;
}

// Sets of triangles, each represented by its first one.
class TriangleSets {
 public:
  explicit TriangleSets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0U); }

  std::uint32_t first(std::uint32_t triangle) {
    while (parent_[triangle] != triangle) triangle = parent_[triangle] = parent_[parent_[triangle]];
    return triangle;
  }

  void join(std::uint32_t a, std::uint32_t b) {
    const auto [low, high] = std::minmax({first(a), first(b)});
    parent_[high] = low;
  }

 private:
  std::vector<std::uint32_t> parent_;
};

// Returns the triangles grouped by connected pieces of one organ and optics.
Grouping pieces_of(const Mesh& mesh) {
  const std::vector<std::uint32_t> surface_of = surfaces_of(mesh).group_of;
  const std::vector<std::uint32_t> position_of = numbers_of_positions(mesh);
  TriangleSets sets(mesh.triangles.size());
  std::unordered_map<std::uint64_t, std::uint32_t> triangle_at;  // by surface and position
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    for (int corner = 0; corner < 3; ++corner) {
      const std::uint64_t place = std::uint64_t{surface_of[t]} << 32U | position_of[mesh.triangles[t][corner]];
      sets.join(t, triangle_at.try_emplace(place, t).first->second);
    }
  Grouping result;
  std::vector<std::uint32_t> number(mesh.triangles.size(), none);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    std::uint32_t& group = number[sets.first(t)];
    if (group == none) {
      group = static_cast<std::uint32_t>(result.groups.size());
      result.groups.push_back({mesh.organ_of[t], mesh.optics_of[t]});
    }
    result.group_of.push_back(group);
  }
  return result;
}

// Returns how many groups each organ has.
std::vector<std::size_t> groups_per_organ(const Mesh& mesh, std::span<const Group> groups) {
  std::vector<std::size_t> count(mesh.organs.size());
  for (const Group& group : groups) ++count[group.organ];
  return count;
}

// Replaces the organs by those of the groups. Equal ones become one organ.
void regroup(Mesh& mesh, const Grouping& grouping, std::span<const Organ> organ_of_group) {
  std::map<OrganKey, std::uint32_t> known;
  std::vector<std::uint32_t> number(organ_of_group.size());
  mesh.organs.clear();
  for (std::size_t g = 0; g < number.size(); ++g) {
    const auto [entry, is_new] = known.try_emplace(key_of(organ_of_group[g]), static_cast<std::uint32_t>(mesh.organs.size()));
    if (is_new) mesh.organs.push_back(organ_of_group[g]);
    number[g] = entry->second;
  }
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) mesh.organ_of[t] = number[grouping.group_of[t]];
}

void split_by_materials(Mesh& mesh) {
  const Grouping surfaces = surfaces_of(mesh);
  const std::vector<std::size_t> count = groups_per_organ(mesh, surfaces.groups);
  std::vector<Organ> organs;
  for (const Group& group : surfaces.groups) {
    organs.push_back(mesh.organs[group.organ]);
    if (count[group.organ] > 1) organs.back().name += " " + mesh.optics_names[group.optics];
  }
  regroup(mesh, surfaces, organs);
}

// Numbers the pieces of an organ.
class PieceNames {
 public:
  explicit PieceNames(const Mesh& mesh) : next_(mesh.organs.size()) {
    for (const Organ& organ : mesh.organs) {
      ++of_name_[{organ.plant, organ.name}];
      taken_.insert(key_of(organ));
    }
  }

  Organ next(const Mesh& mesh, std::uint32_t number) {
    Organ piece = mesh.organs[number];
    const bool takes_rank = piece.rank == 0 && of_name_[{piece.plant, piece.name}] == 1;
    do {
      const std::uint32_t count = ++next_[number];
      if (takes_rank)
        piece.rank = static_cast<int>(count);
      else
        piece.name = fmt::format("{} {}", mesh.organs[number].name, count);
    } while (!taken_.insert(key_of(piece)).second);
    return piece;
  }

 private:
  std::vector<std::uint32_t> next_;  // [organ], pieces named so far
  std::map<std::pair<std::uint32_t, std::string>, std::size_t> of_name_;
  std::set<OrganKey> taken_;
};

void split_by_parts(Mesh& mesh) {
  const Grouping pieces = pieces_of(mesh);
  const std::vector<std::size_t> count = groups_per_organ(mesh, pieces.groups);
  PieceNames names(mesh);
  std::vector<Organ> organs;
  for (const Group& group : pieces.groups)
    organs.push_back(count[group.organ] > 1 ? names.next(mesh, group.organ) : mesh.organs[group.organ]);
  regroup(mesh, pieces, organs);
}

}  // namespace

void split_organs(Mesh& mesh, OrganSplit split) {
  if (split == OrganSplit::materials) split_by_materials(mesh);
  if (split == OrganSplit::parts) split_by_parts(mesh);
}

void name_after_materials(Mesh& mesh, std::uint32_t organ) {
  const Grouping surfaces = surfaces_of(mesh);
  if (groups_per_organ(mesh, surfaces.groups)[organ] < 2) return;
  std::vector<Organ> organs;
  for (const Group& group : surfaces.groups) {
    organs.push_back(mesh.organs[group.organ]);
    if (group.organ == organ) organs.back().name = mesh.optics_names[group.optics];
  }
  regroup(mesh, surfaces, organs);
}

}  // namespace sunfleck
