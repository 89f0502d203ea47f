#include "physics/canopy/maize.h"

#include "base/check.h"
#include "physics/canopy/maize_plant.h"

namespace sunfleck {
namespace {

constexpr std::uint32_t leaf_optics = 0;
constexpr std::uint32_t stem_optics = 1;  // of all parts that are too thick to transmit light

// Adds an organ and returns its number.
std::uint32_t add_organ(Mesh& mesh, std::uint32_t plant, const char* name, int rank = 0) {
  mesh.organs.push_back({plant, name, rank});
  return static_cast<std::uint32_t>(mesh.organs.size() - 1);
}

void add_plant(Mesh& mesh, const MaizePlant& plant, std::uint32_t number, const glm::dvec3& position_m,
               const MaizeDetail& detail) {
  const std::size_t first_vertex = mesh.vertices.size();
  for (const MaizeLeaf& leaf : plant.leaves) {
    add_blade(mesh, leaf.blade, detail, {add_organ(mesh, number, "leaf", leaf.rank), leaf_optics});
  }
  add_tube(mesh, plant.stem, detail, {add_organ(mesh, number, "stem"), stem_optics});
  const std::uint32_t ear = add_organ(mesh, number, "ear");
  add_tube(mesh, plant.ear, detail, {ear, stem_optics});
  for (const Blade& tip : plant.husk_tips) add_blade(mesh, tip, detail, {ear, leaf_optics});
  const std::uint32_t tassel = add_organ(mesh, number, "tassel");
  for (const Tube& part : plant.tassel) add_tube(mesh, part, detail, {tassel, stem_optics});
  for (std::size_t v = first_vertex; v < mesh.vertices.size(); ++v) mesh.vertices[v] += position_m;
}

}  // namespace

Mesh make_maize(const MaizeStand& stand, const MaizeDetail& detail) {
  EXPECT(stand.rows, >, 0);
  EXPECT(stand.per_row, >, 0);
  Mesh mesh;
  mesh.optics_names = {"leaf", "stem"};
  std::uint32_t number = 0;
  for (int row = 0; row < stand.rows; ++row) {
    for (int i = 0; i < stand.per_row; ++i) {
      const glm::dvec3 position_m((i + 0.5) * stand.spacing_in_row_m, 0.0, (row + 0.5) * stand.spacing_between_rows_m);
      ++number;
      add_plant(mesh, grow_maize_plant(stand.seed, number), number, position_m, detail);
    }
  }
  return mesh;
}

Mesh make_maize(const MaizeStand& stand) {
  return make_maize(stand, MaizeDetail{});
}

}  // namespace sunfleck
