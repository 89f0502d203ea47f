#include "files/formats/mesh/opf_reader.h"

#include "base/text_reader.h"
#include "files/formats/mesh/mesh_builder.h"
#include "files/formats/mesh/xml_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <limits>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace sunfleck {

namespace {

struct OpfMesh {
  std::vector<glm::dvec3> points;
  std::vector<std::uint32_t> corners;     // of all faces
  std::vector<std::size_t> face_corners;  // [face], how many
  bool tapers = true;
  double x_lo = 0.0, x_hi = 0.0;

  // Returns how far a point lies along the mesh, from 0 at its least x to 1 at its largest.
  [[nodiscard]] double share_of_length(double x) const { return x_hi > x_lo ? (x - x_lo) / (x_hi - x_lo) : 0.0; }
};

// The geometry of an organ.
struct OpfPlacement {
  glm::dmat4 to_plant{1.0};
  double lower = 1.0, upper = 1.0;  // the factors of y and z at the mesh's least and largest x
};

class OpfReader {
 public:
  explicit OpfReader(const MeshSource& source) : xml_(source), builder_(source) {}

  Mesh read() {
    const pugi::xml_node root = xml_.root("opf");
    for (const pugi::xml_node mesh : root.child("meshBDD").children("mesh"))
      meshes_.insert_or_assign(number_of(mesh), read_mesh(mesh));
    for (const pugi::xml_node shape : root.child("shapeBDD").children("shape"))
      mesh_of_shape_.insert_or_assign(number_of(shape), whole_number(shape.child("meshIndex")));
    for (const pugi::xml_node plant : root.children("topology")) read_organs(plant);
    return builder_.take();
  }

 private:
  // Returns the number in an element's attribute Id.
  std::int64_t number_of(pugi::xml_node element) const {
    const std::optional<std::int64_t> number = parse_integer(element.attribute("Id").value());
    if (!number) xml_.refuse_at(element, fmt::format("a <{}> without a number", element.name()), "it needs an Id");
    return *number;
  }

  std::int64_t whole_number(pugi::xml_node element) const {
    const std::vector<std::int64_t> numbers = xml_.integers(element);
    if (numbers.size() != 1) xml_.refuse_at(element, fmt::format("{} numbers", numbers.size()), "it needs one");
    return numbers.front();
  }

  OpfMesh read_mesh(pugi::xml_node element) const {
    OpfMesh mesh;
    mesh.tapers = element.attribute("enableScale").as_bool(true);
    const pugi::xml_node points = element.child("points");
    const std::vector<double> numbers = xml_.numbers(points);
    if (numbers.size() % 3 != 0) xml_.refuse_at(points, fmt::format("{} coordinates", numbers.size()), "a point has three");
    for (std::size_t i = 0; i < numbers.size(); i += 3) mesh.points.emplace_back(numbers[i], numbers[i + 1], numbers[i + 2]);
    const auto [least, largest] = std::minmax_element(mesh.points.begin(), mesh.points.end(),
                                                      [](const glm::dvec3& a, const glm::dvec3& b) { return a.x < b.x; });
    if (!mesh.points.empty()) {
      mesh.x_lo = least->x;
      mesh.x_hi = largest->x;
    }
    for (const pugi::xml_node face : element.child("faces").children("face")) {
      const std::vector<std::int64_t> corners = xml_.integers(face);
      if (corners.size() < 3)
        xml_.refuse_at(face, fmt::format("a face of {} corners", corners.size()), "a face needs at least 3");
      for (const std::int64_t corner : corners) {
        if (corner < 0 || corner >= static_cast<std::int64_t>(mesh.points.size()))
          xml_.refuse_at(face, fmt::format("corner {}", corner),
                         fmt::format("must be a point number below {}", mesh.points.size()));
        mesh.corners.push_back(static_cast<std::uint32_t>(corner));
      }
      mesh.face_corners.push_back(corners.size());
    }
    return mesh;
  }

  // Reads all organs below the plant, in the order of the file.
  void read_organs(pugi::xml_node plant) {
    plant.find_node([&](const pugi::xml_node& element) {
      if (element.name() == std::string_view("geometry")) read_organ(element);
      return false;
    });
  }

  void read_organ(pugi::xml_node geometry) {
    const pugi::xml_node shape = geometry.child("shapeIndex");
    if (!shape) return;
    const OpfMesh& mesh = mesh_of(shape);
    const OpfPlacement placement = read_placement(geometry);
    const Organ organ = organ_of(geometry.parent());
    const std::uint32_t optics = builder_.optics(organ.name);
    const std::uint32_t number = builder_.organ(organ);
    const auto first = static_cast<std::uint32_t>(builder_.vertex_count());
    builder_.reserve_vertices(mesh.points.size());
    for (const glm::dvec3& point : mesh.points)
      static_cast<void>(builder_.add_vertex(placed(geometry, mesh, placement, point)));
    const bool is_mirrored = glm::determinant(glm::dmat3(placement.to_plant)) < 0.0;
    builder_.add_polygons(mesh.face_corners, mesh.corners, {first, is_mirrored}, optics, number);
  }

  const OpfMesh& mesh_of(pugi::xml_node shape) const {
    const std::int64_t number = whole_number(shape);
    const auto mesh_number = mesh_of_shape_.find(number);
    if (mesh_number == mesh_of_shape_.end())
      xml_.refuse_at(shape, fmt::format("shape {}", number), "there is no shape of that Id in shapeBDD");
    const auto mesh = meshes_.find(mesh_number->second);
    if (mesh == meshes_.end())
      xml_.refuse_at(shape, fmt::format("mesh {} of shape {}", mesh_number->second, number),
                     "there is no mesh of that Id in meshBDD");
    return mesh->second;
  }

  OpfPlacement read_placement(pugi::xml_node geometry) const {
    const pugi::xml_node matrix = geometry.child("mat");
    if (!matrix) xml_.refuse_at(geometry, "a <geometry> without <mat>", "an organ needs its position");
    const std::vector<double> m = xml_.numbers(matrix, 12);
    OpfPlacement placement;
    for (std::size_t k = 0; k < m.size(); ++k) placement.to_plant[static_cast<int>(k % 4)][static_cast<int>(k / 4)] = m[k];
    if (const pugi::xml_node lower = geometry.child("dDwn")) placement.lower = xml_.numbers(lower, 1).front();
    if (const pugi::xml_node upper = geometry.child("dUp")) placement.upper = xml_.numbers(upper, 1).front();
    return placement;
  }

  glm::dvec3 placed(pugi::xml_node geometry, const OpfMesh& mesh, const OpfPlacement& placement,
                    const glm::dvec3& point) const {
    const double factor =
        mesh.tapers ? placement.lower + (placement.upper - placement.lower) * mesh.share_of_length(point.x) : 1.0;
    const glm::dvec3 moved = placement.to_plant * glm::dvec4(point.x, factor * point.y, factor * point.z, 1.0);
    if (!std::isfinite(moved.x + moved.y + moved.z))
      xml_.refuse_at(geometry, "a point that is not finite", "its numbers are too large");
    return moved;
  }

  Organ organ_of(pugi::xml_node element) const {
    const std::string_view name = trimmed(element.attribute("class").value());
    if (name.empty())
      xml_.refuse_at(element, fmt::format("an organ <{}> without a class", element.name()), "the class is its name");
    const std::string_view id = element.attribute("id").value();
    const std::int64_t rank = parse_integer(id).value_or(-1);
    if (!id.empty() && (rank < 0 || rank > std::numeric_limits<int>::max()))
      xml_.refuse_at(element, fmt::format("id {}", in_quotes(id)), "must be a whole number below 2147483648");
    return {1, std::string(name), id.empty() ? 0 : static_cast<int>(rank)};
  }

  XmlFile xml_;
  MeshBuilder builder_;
  std::unordered_map<std::int64_t, OpfMesh> meshes_;
  std::unordered_map<std::int64_t, std::int64_t> mesh_of_shape_;
};

}  // namespace

Mesh read_opf(const MeshSource& source) {
  return OpfReader(source).read();
}

}  // namespace sunfleck
