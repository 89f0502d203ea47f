#include "files/formats/mesh/connected_pieces.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <tuple>

namespace sunfleck {

namespace {

// Returns the first member of the set that `member` belongs to, and shortens the way to it.
std::uint32_t root_of(std::vector<std::uint32_t>& parents, std::uint32_t member) {
  while (parents[member] != member) {
    parents[member] = parents[parents[member]];
    member = parents[member];
  }
  return member;
}

void join(std::vector<std::uint32_t>& parents, std::uint32_t a, std::uint32_t b) {
  a = root_of(parents, a);
  b = root_of(parents, b);
  parents[std::max(a, b)] = std::min(a, b);
}

}  // namespace

std::vector<std::uint32_t> places_of_vertices(const Mesh& mesh) {
  const auto key = [&](std::uint32_t vertex) {
    const glm::dvec3& v = mesh.vertices[vertex];
    return std::tuple(v.x, v.y, v.z);
  };
  std::vector<std::uint32_t> order(mesh.vertices.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
  std::vector<std::uint32_t> places(mesh.vertices.size());
  std::uint32_t place = 0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (i > 0 && key(order[i - 1]) != key(order[i])) ++place;
    places[order[i]] = place;
  }
  return places;
}

ConnectedPieces connected_pieces(const Mesh& mesh, const std::vector<std::uint32_t>& places) {
  struct Corner {
    std::uint32_t place, organ, optics, triangle;
    [[nodiscard]] auto surface() const { return std::tuple(place, organ, optics); }
  };
  std::vector<Corner> corners;
  corners.reserve(3 * mesh.triangles.size());
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    for (int k = 0; k < 3; ++k) corners.push_back({places[mesh.triangles[t][k]], mesh.organ_of[t], mesh.optics_of[t], t});
  }
  std::sort(corners.begin(), corners.end(), [](const Corner& a, const Corner& b) { return a.surface() < b.surface(); });
  std::vector<std::uint32_t> parents(mesh.triangles.size());
  std::iota(parents.begin(), parents.end(), 0U);
  for (std::size_t i = 1; i < corners.size(); ++i) {
    if (corners[i - 1].surface() == corners[i].surface()) join(parents, corners[i - 1].triangle, corners[i].triangle);
  }
  constexpr std::uint32_t unnumbered = std::numeric_limits<std::uint32_t>::max();
  ConnectedPieces pieces;
  pieces.piece_of.resize(mesh.triangles.size());
  std::vector<std::uint32_t> numbers(mesh.triangles.size(), unnumbered);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    std::uint32_t& number = numbers[root_of(parents, t)];
    if (number == unnumbered) number = static_cast<std::uint32_t>(pieces.count++);
    pieces.piece_of[t] = number;
  }
  return pieces;
}

}  // namespace sunfleck
