#pragma once
// Builds a mesh while its file is read.

#include "files/formats/mesh/mesh_source.h"
#include "physics/canopy/mesh.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

namespace sunfleck {

// Builds a mesh in the order of the file, with one entry for each optics name and each organ.
class MeshBuilder {
 public:
  explicit MeshBuilder(const MeshSource& source) : source_(source) {}

  // Refuses `count` more vertices if there would be over 2^28 of them. Triangles have the same limit.
  void reserve_vertices(std::size_t count);
  std::uint32_t add_vertex(const glm::dvec3& position);
  [[nodiscard]] std::size_t vertex_count() const { return mesh_.vertices.size(); }

  // Returns the index of an optics name. Names end up in tables and in files for other programs, so a new one must be a single
  // line of UTF-8 with at most 200 bytes.
  [[nodiscard]] std::uint32_t optics(std::string_view name);
  [[nodiscard]] const std::string& optics_name(std::uint32_t optics) const { return mesh_.optics_names[optics]; }
  // Returns the optics of triangles without a material; refuses if the scene names none. `line` is used as in refuse.
  [[nodiscard]] std::uint32_t default_optics(std::size_t line);
  [[nodiscard]] std::uint32_t organ(const Organ& organ);
  // Returns the organ of triangles that have none: plant 1, named after the optics, rank 0.
  [[nodiscard]] std::uint32_t default_organ(std::uint32_t optics);

  // Returns the number of a further object of the file, for object_organ. The name may be empty.
  [[nodiscard]] std::uint32_t add_object(std::string_view name);
  // Returns the organ of an object: what organ_from_name reads from its name, or else the plant, the name itself and the rank;
  // the default organ if it has no name. The second object of one name and plant gets the name `leaf 2`, and so on. Characters
  // that a table cannot hold become `?`.
  [[nodiscard]] std::uint32_t object_organ(std::uint32_t object, std::uint32_t optics, std::uint32_t plant = 1, int rank = 0);

  // Adds a polygon, cut into the triangle fan about its first corner or, where that would fold over itself, by cut_ears
  // (polygon_cut.h). It needs at least three valid vertex numbers. Either all polygons of a file have labels or none has.
  void add_polygon(std::span<const std::uint32_t> corners, std::uint32_t optics, std::uint32_t organ,
                   std::optional<std::uint64_t> label = std::nullopt);

  // Adds polygons of a placed mesh: the corners of all of them one after the other, counted from the mesh's first vertex, and how
  // many each polygon has. In a mirrored mesh they are reversed, so that the front stays the front.
  struct PlacedMesh {
    std::uint32_t first_vertex = 0;
    bool is_mirrored = false;
  };
  void add_polygons(std::span<const std::size_t> sizes, std::span<const std::uint32_t> corners, const PlacedMesh& mesh,
                    std::uint32_t optics, std::uint32_t organ);

  [[nodiscard]] std::size_t triangle_count() const { return mesh_.triangles.size(); }
  // Replaces the optics and the organ of a triangle.
  void set_surface(std::size_t triangle, std::uint32_t optics, std::uint32_t organ);

  // Returns the mesh. If the file names a single object that has several materials, its organs are named after them.
  [[nodiscard]] Mesh take();

 private:
  struct Object {
    std::string name;
    std::optional<std::uint32_t> organ;  // set once it is used
  };

  [[nodiscard]] std::uint32_t find_organ(const Organ& organ);
  [[nodiscard]] std::string free_name(std::uint32_t plant, const std::string& name);
  void check_name(std::string_view kind, std::string_view name) const;

  const MeshSource& source_;
  Mesh mesh_;
  std::map<std::string, std::uint32_t, std::less<>> optics_;
  std::map<std::tuple<std::uint32_t, std::string, int>, std::uint32_t> organs_;
  std::vector<Object> objects_;
  std::map<std::pair<std::uint32_t, std::string>, int> objects_named_;  // the highest number behind each name
  std::optional<std::uint32_t> only_object_;                            // the organ of the last object with a name of its own
  std::size_t named_organs_ = 0;                                        // objects with names of their own that have an organ
  bool has_given_organs_ = false;
  std::uint32_t last_optics_ = 0, last_organ_ = 0;  // most triangles share those of the one before
};

}  // namespace sunfleck
