#include "files/formats/mesh/organ_split.h"

#include "files/formats/mesh/connected_pieces.h"

#include <fmt/format.h>

#include <cstddef>
#include <map>
#include <set>
#include <span>
#include <tuple>
#include <utility>

namespace sunfleck {

namespace {

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

// Returns the triangles grouped by connected pieces of one organ and optics.
Grouping pieces_of(const Mesh& mesh) {
  ConnectedPieces pieces = connected_pieces(mesh, places_of_vertices(mesh));
  Grouping result{std::move(pieces.piece_of), {}};
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    // Pieces are numbered by their first triangles.
    if (result.group_of[t] == result.groups.size()) result.groups.push_back({mesh.organ_of[t], mesh.optics_of[t]});
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

const std::vector<std::string>& organ_split_names() {
  static const std::vector<std::string> names = {"names", "materials", "parts"};
  return names;
}

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
