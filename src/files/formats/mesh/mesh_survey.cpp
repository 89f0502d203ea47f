#include "files/formats/mesh/mesh_survey.h"

#include "base/check.h"
#include "base/text.h"
#include "files/formats/mesh/connected_pieces.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <utility>

namespace sunfleck {

namespace {

using AreaByRole = std::array<double, role_names.size()>;
using Corners = std::array<glm::dvec3, 3>;

constexpr double flatness_of_sheets = 0.3;  // least MeshShare::flatness

Corners corners_of(const Mesh& mesh, std::size_t t) {
  const glm::uvec3& c = mesh.triangles[t];
  return {mesh.vertices[c.x], mesh.vertices[c.y], mesh.vertices[c.z]};
}

// Returns area times normal.
glm::dvec3 area_vector(const Corners& c) {
  return 0.5 * glm::cross(c[1] - c[0], c[2] - c[0]);
}

double longest_edge(const Corners& c) {
  return std::max({glm::distance(c[0], c[1]), glm::distance(c[1], c[2]), glm::distance(c[2], c[0])});
}

// The two places of an edge, the lower one first.
using Edge = std::pair<std::uint32_t, std::uint32_t>;

struct EdgeUse {
  Edge edge;
  std::uint32_t triangle = 0;
  bool is_rising = false;  // the triangle runs from the lower to the higher place
};

class Surveyor {
 public:
  Surveyor(const Mesh& mesh, const KnownFrame& known)
      : mesh_(mesh), known_(known), places_(places_of_vertices(mesh)), pieces_(connected_pieces(mesh, places_)) {}

  MeshSurvey survey() {
    EXPECT(mesh_.triangles.empty(), ==, false);
    found_.vertices = mesh_.vertices.size();
    found_.triangles = mesh_.triangles.size();
    name_roles();
    measure_shape();
    measure_plant();
    find_leaf_pieces();
    found_.frame = guess_frame(found_.shape, known_);
    count_organs();
    count_shares();
    count_defects();
    count_edges();
    measure_below_ground();
    return std::move(found_);
  }

 private:
  void name_roles() {
    for (const Organ& organ : mesh_.organs) organ_roles_.push_back(role_from_name(organ.name));
    for (const std::string& name : mesh_.optics_names) optics_roles_.push_back(role_from_name(name));
  }

  // Returns the role that the name of a triangle's organ or else of its material suggests.
  [[nodiscard]] std::optional<Role> named_role(std::size_t t) const {
    const std::optional<Role>& by_organ = organ_roles_[mesh_.organ_of[t]];
    return by_organ ? by_organ : optics_roles_[mesh_.optics_of[t]];
  }

  void measure_shape() {
    ShapeFigures& shape = found_.shape;
    shape.lo = shape.hi = corners_of(mesh_, 0)[0];
    glm::dvec3 net{0.0};
    piece_vectors_.assign(pieces_.count, glm::dvec3(0.0));
    piece_areas_.assign(pieces_.count, 0.0);
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      const Corners corners = corners_of(mesh_, t);
      for (const glm::dvec3& corner : corners) {
        shape.lo = glm::min(shape.lo, corner);
        shape.hi = glm::max(shape.hi, corner);
      }
      const glm::dvec3 vector = area_vector(corners);
      areas_.push_back(glm::length(vector));
      found_.area += areas_.back();
      net += vector;
      shape.facing += glm::abs(vector);
      piece_vectors_[pieces_.piece_of[t]] += vector;
      piece_areas_[pieces_.piece_of[t]] += areas_.back();
    }
    if (found_.area > 0.0) {
      shape.net_facing = glm::abs(net) / found_.area;
      shape.facing /= found_.area;
    }
    shape.pieces = pieces_.count;
  }

  void measure_plant() {
    ShapeFigures& shape = found_.shape;
    bool any = false;
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      if (!is_vegetation(named_role(t).value_or(Role::leaf))) continue;
      const Corners corners = corners_of(mesh_, t);
      if (!std::exchange(any, true)) shape.plant_lo = shape.plant_hi = corners[0];
      for (const glm::dvec3& corner : corners) {
        shape.plant_lo = glm::min(shape.plant_lo, corner);
        shape.plant_hi = glm::max(shape.plant_hi, corner);
      }
    }
    if (any) return;
    shape.plant_lo = shape.lo;
    shape.plant_hi = shape.hi;
  }

  // Pieces are leaves if a name says so. Where none does, the sheets among pieces without a known word are, or else all of these.
  void find_leaf_pieces() {
    std::vector<std::optional<Role>> roles(pieces_.count);  // of the first triangle with one
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      std::optional<Role>& role = roles[pieces_.piece_of[t]];
      if (!role) role = named_role(t);
    }
    std::vector<double> leaves, sheets, unnamed;
    for (std::size_t p = 0; p < pieces_.count; ++p) {
      const double area = piece_areas_[p];
      if (roles[p] == Role::leaf) leaves.push_back(area);
      if (roles[p]) continue;
      unnamed.push_back(area);
      if (glm::length(piece_vectors_[p]) > flatness_of_sheets * area) sheets.push_back(area);
    }
    std::vector<double>& areas = !leaves.empty() ? leaves : !sheets.empty() ? sheets : unnamed;
    found_.shape.leaf_pieces = areas.size();
    std::sort(areas.begin(), areas.end());
    const double all = std::accumulate(areas.begin(), areas.end(), 0.0);
    double sum = 0.0;
    for (const double area : areas) {
      sum += area;
      found_.shape.usual_leaf = area;
      if (2.0 * sum >= all) break;
    }
  }

  void count_organs() {
    std::set<std::uint32_t> plants, organs;
    for (const std::uint32_t organ : mesh_.organ_of) {
      organs.insert(organ);
      plants.insert(mesh_.organs[organ].plant);
    }
    found_.organs = organs.size();
    found_.plants = plants.size() - plants.count(0);
  }

  // Returns the shares by a property of the triangles, which `name_of` gives.
  template <class NameOf>
  [[nodiscard]] std::vector<MeshShare> shares_by(const NameOf& name_of) const {
    std::vector<MeshShare> shares;
    std::map<std::string, std::size_t, std::less<>> numbers;
    std::vector<std::set<std::uint32_t>> organs, pieces;
    std::vector<AreaByRole> named_areas;
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      const std::string_view name = name_of(t);
      auto number = numbers.find(name);
      if (number == numbers.end()) {
        number = numbers.emplace(name, shares.size()).first;
        shares.push_back({.name = std::string(name)});
        organs.emplace_back();
        pieces.emplace_back();
        named_areas.push_back({});
      }
      MeshShare& share = shares[number->second];
      ++share.triangles;
      share.area += areas_[t];
      if (const auto& role = organ_roles_[mesh_.organ_of[t]])
        named_areas[number->second][static_cast<std::size_t>(*role)] += areas_[t];
      organs[number->second].insert(mesh_.organ_of[t]);
      pieces[number->second].insert(pieces_.piece_of[t]);
    }
    for (std::size_t i = 0; i < shares.size(); ++i) {
      shares[i].organs = organs[i].size();
      shares[i].pieces = pieces[i].size();
      double net = 0.0;
      for (const std::uint32_t piece : pieces[i]) net += glm::length(piece_vectors_[piece]);
      shares[i].flatness = shares[i].area > 0.0 ? net / shares[i].area : 0.0;
    }
    find_roles(shares, named_areas);
    return shares;
  }

  // `named_areas` has the area by role of the organs of each share whose names suggest one.
  static void find_roles(std::vector<MeshShare>& shares, const std::vector<AreaByRole>& named_areas) {
    for (std::size_t i = 0; i < shares.size(); ++i) {
      MeshShare& share = shares[i];
      const auto largest = std::max_element(named_areas[i].begin(), named_areas[i].end());
      if (const auto named = role_from_name(share.name)) {
        share.role = *named;
        share.role_from = RoleSource::name;
      } else if (*largest > 0.0) {
        share.role = static_cast<Role>(largest - named_areas[i].begin());
        share.role_from = RoleSource::organs;
      } else {
        share.role = share.flatness > flatness_of_sheets ? Role::leaf : Role::stem;
      }
    }
    if (std::any_of(shares.begin(), shares.end(), [](const MeshShare& share) { return share.role == Role::leaf; })) return;
    for (MeshShare& share : shares)
      if (share.role_from == RoleSource::shape) share.role = Role::leaf;
  }

  void count_shares() {
    found_.materials = shares_by([&](std::size_t t) -> std::string_view { return mesh_.optics_names[mesh_.optics_of[t]]; });
    found_.families = shares_by([&](std::size_t t) { return family_of(mesh_.organs[mesh_.organ_of[t]].name); });
  }

  [[nodiscard]] bool is_flat(std::size_t t) const {
    constexpr double least_share = 1e-12;
    const glm::dvec3 extent = found_.shape.hi - found_.shape.lo;
    const double largest = std::max({extent.x, extent.y, extent.z});
    return areas_[t] <= least_share * largest * largest;
  }

  [[nodiscard]] std::array<std::uint32_t, 3> sorted_places(std::size_t t) const {
    const glm::uvec3& c = mesh_.triangles[t];
    std::array<std::uint32_t, 3> places = {places_[c.x], places_[c.y], places_[c.z]};
    std::sort(places.begin(), places.end());
    return places;
  }

  void count_defects() {
    constexpr double slenderness = 100.0;
    std::vector<bool> is_defective(mesh_.triangles.size(), false);
    std::vector<std::pair<std::array<std::uint32_t, 3>, std::size_t>> seen;
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      is_defective[t] = is_flat(t);
      if (is_defective[t]) {
        ++found_.defects.flat_triangles;
        continue;
      }
      seen.emplace_back(sorted_places(t), t);
      const double longest = longest_edge(corners_of(mesh_, t));
      if (longest * longest <= slenderness * 2.0 * areas_[t]) continue;
      ++found_.defects.slivers;
      is_defective[t] = true;
    }
    std::sort(seen.begin(), seen.end());
    for (std::size_t i = 1; i < seen.size(); ++i) {
      if (seen[i].first != seen[i - 1].first) continue;
      ++found_.defects.coincident;
      is_defective[seen[i].second] = true;
    }
    name_organs(is_defective);
    count_unused_vertices();
  }

  void name_organs(const std::vector<bool>& is_defective) {
    std::set<std::string> named;
    for (std::size_t t = 0; t < is_defective.size(); ++t) {
      const std::string& name = mesh_.organs[mesh_.organ_of[t]].name;
      if (is_defective[t] && named.insert(name).second) found_.defects.organs.push_back(name);
    }
  }

  void count_unused_vertices() {
    std::vector<bool> is_used(mesh_.vertices.size(), false);
    for (const glm::uvec3& c : mesh_.triangles) is_used[c.x] = is_used[c.y] = is_used[c.z] = true;
    found_.defects.unused_vertices = static_cast<std::size_t>(std::count(is_used.begin(), is_used.end(), false));
  }

  [[nodiscard]] std::vector<EdgeUse> uses_of_edges() const {
    std::vector<EdgeUse> uses;
    uses.reserve(3 * mesh_.triangles.size());
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
      if (is_flat(t)) continue;
      const glm::uvec3& c = mesh_.triangles[t];
      for (const auto& [from, to] : {Edge(c.x, c.y), Edge(c.y, c.z), Edge(c.z, c.x)}) {
        const std::uint32_t a = places_[from], b = places_[to];
        uses.push_back({std::minmax(a, b), t, a < b});
      }
    }
    std::sort(uses.begin(), uses.end(), [](const EdgeUse& a, const EdgeUse& b) { return a.edge < b.edge; });
    return uses;
  }

  // Counts crowded and flipped edges, and closed pieces.
  void count_edges() {
    const std::vector<EdgeUse> uses = uses_of_edges();
    std::vector<bool> closed(pieces_.count, false);
    for (const EdgeUse& use : uses) closed[pieces_.piece_of[use.triangle]] = true;
    for (std::size_t first = 0, next = 0; first < uses.size(); first = next) {
      while (next < uses.size() && uses[next].edge == uses[first].edge) ++next;
      if (next - first > 2) ++found_.defects.crowded_edges;
      std::map<std::uint32_t, std::size_t> by_piece;
      for (std::size_t i = first; i < next; ++i) ++by_piece[pieces_.piece_of[uses[i].triangle]];
      if (next - first == 2 && by_piece.size() == 1 && uses[first].is_rising == uses[first + 1].is_rising)
        ++found_.defects.flipped_edges;
      for (const auto& [piece, count] : by_piece)
        if (count != 2) closed[piece] = false;
    }
    found_.closed_pieces = static_cast<std::size_t>(std::count(closed.begin(), closed.end(), true));
  }

  void measure_below_ground() {
    const int up = static_cast<int>(found_.frame.up);
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      const Corners corners = corners_of(mesh_, t);
      if (corners[0][up] + corners[1][up] + corners[2][up] < 0.0) found_.area_below_ground += areas_[t];
    }
  }

  const Mesh& mesh_;
  const KnownFrame& known_;
  const std::vector<std::uint32_t> places_;
  const ConnectedPieces pieces_;
  std::vector<double> areas_;              // [triangle]
  std::vector<glm::dvec3> piece_vectors_;  // [piece]
  std::vector<double> piece_areas_;        // [piece]
  // [organ] and [optics], as far as their names suggest one
  std::vector<std::optional<Role>> organ_roles_, optics_roles_;
  MeshSurvey found_;
};

constexpr std::string_view colour_prefix = "colour_";  // see ply_colours.h

bool is_collada(const std::filesystem::path& file) {
  return lower_case(file.extension().string()) == ".dae";
}

}  // namespace

std::string_view role_source_name(RoleSource source) {
  constexpr std::array<std::string_view, 3> names = {"name", "organs", "shape"};
  return names[static_cast<std::size_t>(source)];
}

bool MeshSurvey::needs_split() const {
  return organs == families.size() && shape.pieces > organs && triangles >= 2 * shape.pieces;
}

KnownFrame frame_of_format(const std::filesystem::path& file) {
  const std::string name = lower_case(file.filename().string());
  if (name.ends_with(".glb") || name.ends_with(".gltf")) return {FileAxis::y, 1.0, "glTF defines metres and y up"};
  if (is_can_file(file)) return {FileAxis::z, std::nullopt, "a .can has z up"};
  if (name.ends_with(".opf")) return {FileAxis::z, 1.0, "an .opf has z up and centimetres, which are read as metres"};
  if (is_collada(file)) return {FileAxis::y, 1.0, "a .dae names its axis and unit; it is read with y up, in metres"};
  return {};
}

std::string_view family_of(std::string_view name) {
  constexpr std::string_view digits = "0123456789", separators = "._- #";
  std::string_view family = name;
  if (name.starts_with(colour_prefix)) return name;  // its digits are the colour
  const std::size_t last = family.find_last_not_of(digits);
  if (last == family.npos) return name;
  if (last + 1 == family.size()) return name;
  const std::size_t end = family.find_last_not_of(separators, last);
  return end == family.npos ? name : family.substr(0, end + 1);
}

MeshSurvey survey_mesh(const Mesh& mesh, const KnownFrame& known) {
  return Surveyor(mesh, known).survey();
}

Mesh read_mesh_as_is(const std::filesystem::path& file, bool allow_outside, SourceFiles* files, NamedParts* named) {
  MeshImport import{.optics = std::string(no_material), .up = FileAxis::y, .scale = 1.0, .allow_outside = allow_outside};
  import.named = named;
  if (is_collada(file)) import.up.reset();
  Mesh mesh = read_mesh(file, import, files);
  // The colours of a .ply are its materials unless the scene gives optics.
  const bool coloured = std::all_of(mesh.organs.begin(), mesh.organs.end(),
                                    [](const Organ& organ) { return organ.name.starts_with(colour_prefix); });
  if (!coloured || mesh.optics_names != std::vector<std::string>{std::string(no_material)}) return mesh;
  import.optics.reset();
  import.named = nullptr;
  return read_mesh(file, import, files);
}

}  // namespace sunfleck
