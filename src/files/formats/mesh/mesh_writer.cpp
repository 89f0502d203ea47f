#include "files/formats/mesh/mesh_writer.h"

#include "base/check.h"
#include "base/error.h"
#include "base/file.h"
#include "base/text.h"
#include "files/formats/mesh/gltf_parts.h"
#include "files/formats/mesh/mesh_text.h"
#include "files/formats/mesh/organ_name.h"
#include "physics/canopy/axes.h"
#include "physics/canopy/canopy.h"

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <glm/common.hpp>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace sunfleck {

namespace {

// The triangles of one organ, by optics and in the order of the mesh.
using Groups = std::map<std::uint32_t, std::vector<std::size_t>>;

class GltfWriter {
 public:
  GltfWriter(const Mesh& mesh, Axes axes)
      : mesh_(mesh),
        axes_(axes),
        origin_m_(glm::round(y_up_direction(axes, mesh_origin_m(mesh)))),
        new_number_(mesh.vertices.size(), unused) {
    model_.asset.version = "2.0";
    model_.asset.generator = "sunfleck";
    model_.buffers.emplace_back();
    model_.scenes.emplace_back();
    model_.defaultScene = 0;
    for (const std::string& name : mesh.optics_names) {
      tinygltf::Material material;
      material.name = name;
      material.doubleSided = true;  // a leaf has two faces
      model_.materials.push_back(material);
    }
  }

  tinygltf::Model take() {
    std::vector<Groups> organs(mesh_.organs.size());
    for (std::size_t i = 0; i < mesh_.triangles.size(); ++i) organs.at(mesh_.organ_of[i])[mesh_.optics_of[i]].push_back(i);
    for (std::size_t i = 0; i < organs.size(); ++i)
      if (!organs[i].empty()) add_organ(mesh_.organs[i], organs[i]);
    if (model_.nodes.empty()) {  // glTF forbids empty lists
      model_.buffers.clear();
      model_.scenes.clear();
      model_.defaultScene = -1;
    }
    return std::move(model_);
  }

 private:
  static constexpr std::uint32_t unused = std::numeric_limits<std::uint32_t>::max();

  void add_organ(const Organ& organ, const Groups& groups) {
    std::vector<std::uint32_t> vertices;  // vertices of the mesh, in the order of first use
    tinygltf::Mesh shape;
    for (const auto& [optics, triangles] : groups) {
      std::vector<std::uint32_t> indices;
      for (const std::size_t triangle : triangles)
        for (int corner = 0; corner < 3; ++corner) {
          const std::uint32_t vertex = mesh_.triangles[triangle][corner];
          if (new_number_.at(vertex) == unused) {
            new_number_[vertex] = static_cast<std::uint32_t>(vertices.size());
            vertices.push_back(vertex);
          }
          indices.push_back(new_number_[vertex]);
        }
      tinygltf::Primitive primitive;
      primitive.mode = TINYGLTF_MODE_TRIANGLES;
      primitive.material = static_cast<int>(optics);
      primitive.indices = add_indices(indices);
      shape.primitives.push_back(primitive);
    }
    const int positions = add_corners(vertices);
    for (tinygltf::Primitive& primitive : shape.primitives) primitive.attributes["POSITION"] = positions;
    for (const std::uint32_t vertex : vertices) new_number_[vertex] = unused;

    tinygltf::Node node;
    node.name = node_name(organ);
    node.extras = organ_extras(organ);
    if (origin_m_ != glm::dvec3(0.0)) node.translation = {origin_m_.x, origin_m_.y, origin_m_.z};
    node.mesh = static_cast<int>(model_.meshes.size());
    shape.name = node.name;
    model_.scenes[0].nodes.push_back(static_cast<int>(model_.nodes.size()));
    model_.meshes.push_back(std::move(shape));
    model_.nodes.push_back(std::move(node));
  }

  int add_indices(const std::vector<std::uint32_t>& indices) {
    tinygltf::Accessor accessor;
    accessor.type = TINYGLTF_TYPE_SCALAR;
    accessor.componentType = TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
    return add_piece<std::uint32_t>(model_, indices, TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER, accessor);
  }

  int add_corners(const std::vector<std::uint32_t>& vertices) {
    std::vector<std::array<float, 3>> positions;
    for (const std::uint32_t vertex : vertices) {
      const glm::vec3 position(y_up_direction(axes_, mesh_.vertices[vertex]) - origin_m_);
      positions.push_back({position.x, position.y, position.z});
    }
    return add_positions(model_, positions);
  }

  const Mesh& mesh_;
  const Axes axes_;
  const glm::dvec3 origin_m_;              // of the positions, which are in single precision; each node moves them there
  std::vector<std::uint32_t> new_number_;  // [mesh vertex], number within the current organ
  tinygltf::Model model_;
};

// Returns the ending in lower case.
std::string ending_of(const std::filesystem::path& file) {
  return lower_case(file.extension().string());
}

}  // namespace

bool is_writable_mesh(const std::filesystem::path& file) {
  const std::string ending = ending_of(file);
  return ending == ".glb" || ending == ".gltf" || ending == ".obj" || ending == ".ply" || ending == ".can";
}

void write_mesh(const Mesh& mesh, const std::filesystem::path& file, Axes axes) {
  const std::string ending = ending_of(file);
  if (!is_writable_mesh(file))
    throw_input(fmt::format("{}: unknown kind of mesh", printable(file.string())),
                fmt::format("its name ends in '{}'", printable(ending)),
                fmt::format("use a name that ends in {}", writable_meshes));
  if (ending == ".obj")
    write_file(file, obj_text(mesh, axes));
  else if (ending == ".ply")
    write_file(file, ply_mesh_bytes(mesh, axes));
  else if (ending == ".can")
    write_file(file, can_text(mesh));
  else
    write_gltf(mesh, file, axes);
}

void write_gltf(const Mesh& mesh, const std::filesystem::path& file, Axes axes) {
  const std::string ending = ending_of(file);
  const std::string name = printable(file.string());
  if (ending != ".glb" && ending != ".gltf")
    throw_input(fmt::format("{}: cannot be written as glTF", name), fmt::format("its name ends in '{}'", printable(ending)),
                "use a name that ends in .glb or .gltf");
  EXPECT(mesh.optics_of.size(), ==, mesh.triangles.size());
  EXPECT(mesh.organ_of.size(), ==, mesh.triangles.size());
  const tinygltf::Model model = GltfWriter(mesh, axes).take();
  write_file(file, gltf_bytes(model, ending == ".glb" ? GltfForm::binary : GltfForm::text, name));
}

}  // namespace sunfleck
