#include "files/formats/mesh/gltf_reader.h"

#include "base/log.h"
#include "base/text_reader.h"
#include "files/formats/mesh/gltf_document.h"
#include "files/formats/mesh/mesh_builder.h"
#include "files/formats/mesh/organ_name.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace sunfleck {

namespace {

using nlohmann::json;

constexpr std::string_view write_again = "export the file again";

// The known part of a node's organ; children inherit whatever they do not specify themselves.
struct OrganHint {
  std::optional<std::uint32_t> plant;
  std::optional<std::string> name;
  std::optional<int> rank;
};

struct NodeVisit {
  int node = 0;
  glm::dmat4 to_scene{1.0};
  OrganHint organ;
};

class GltfReader {
 public:
  explicit GltfReader(const MeshSource& source)
      : source_(source), document_(open_gltf(source)), model_(document_.model), builder_(source) {}

  Mesh read() {
    for (const tinygltf::Material& material : model_.materials)
      if (material.alphaMode != "OPAQUE" && material.pbrMetallicRoughness.baseColorTexture.index >= 0)
        warn(fmt::format("{}: material {}: its transparency texture is not read; its triangles count as opaque",
                         source_.file.string(), in_quotes(material.name)));
    visited_.assign(model_.nodes.size(), false);
    std::vector<NodeVisit> open;
    push(open, roots(), NodeVisit{});
    while (!open.empty()) {
      const NodeVisit visit = open.back();
      open.pop_back();
      enter(visit, open);
    }
    return builder_.take();
  }

 private:
  template <class T>
  const T& item(const std::vector<T>& items, int index, std::string_view what) const {
    if (index < 0 || static_cast<std::size_t>(index) >= items.size())
      refuse(source_, 0, fmt::format("{} {}", what, index), fmt::format("the file has {}", items.size()), write_again);
    return items[static_cast<std::size_t>(index)];
  }

  // Returns the nodes of the default scene, otherwise those of the first scene, otherwise all nodes without a parent.
  std::vector<int> roots() const {
    if (model_.defaultScene >= 0 || !model_.scenes.empty())
      return item(model_.scenes, std::max(model_.defaultScene, 0), "scene").nodes;
    std::vector<bool> is_child(model_.nodes.size(), false);
    for (const tinygltf::Node& node : model_.nodes)
      for (const int child : node.children) {
        static_cast<void>(item(model_.nodes, child, "node"));
        is_child[static_cast<std::size_t>(child)] = true;
      }
    std::vector<int> nodes;
    for (std::size_t i = 0; i < is_child.size(); ++i)
      if (!is_child[i]) nodes.push_back(static_cast<int>(i));
    return nodes;
  }

  // Pushes the nodes in reverse, so that they come off the stack in the order of the file.
  static void push(std::vector<NodeVisit>& open, const std::vector<int>& nodes, const NodeVisit& parent) {
    for (auto node = nodes.rbegin(); node != nodes.rend(); ++node) open.push_back({*node, parent.to_scene, parent.organ});
  }

  void enter(NodeVisit visit, std::vector<NodeVisit>& open) {
    const tinygltf::Node& node = item(model_.nodes, visit.node, "node");
    const auto number = static_cast<std::size_t>(visit.node);
    if (visited_[number])
      refuse(source_, 0, fmt::format("node {} is reached twice", visit.node), "nodes must form trees, without cycles",
             write_again);
    visited_[number] = true;
    visit.to_scene = visit.to_scene * local_transform(node, visit.node);
    read_organ(node, visit);
    if (node.mesh >= 0) {
      positions_.clear();
      for (const tinygltf::Primitive& primitive : item(model_.meshes, node.mesh, "mesh").primitives)
        read_primitive(primitive, visit);
    }
    push(open, node.children, visit);
  }

  glm::dmat4 local_transform(const tinygltf::Node& node, int number) const {
    const auto sized = [&](const std::vector<double>& values, std::size_t size, std::string_view what) {
      if (!values.empty() && values.size() != size)
        refuse(source_, 0, fmt::format("node {}: {} has {} numbers", number, what, values.size()),
               fmt::format("it needs {}", size), write_again);
      return !values.empty();
    };
    if (sized(node.matrix, 16, "matrix")) return glm::make_mat4(node.matrix.data());
    glm::dmat4 transform(1.0);
    if (sized(node.translation, 3, "translation")) transform[3] = glm::dvec4(glm::make_vec3(node.translation.data()), 1.0);
    if (sized(node.rotation, 4, "rotation")) {
      const std::vector<double>& r = node.rotation;  // x, y, z, w
      const double length = std::hypot(std::hypot(r[0], r[1]), std::hypot(r[2], r[3]));
      if (!(std::abs(length - 1.0) < 0.01))
        refuse(source_, 0, fmt::format("node {}: a rotation of length {}", number, length), "must be a unit quaternion",
               write_again);
      transform *= glm::mat4_cast(glm::dquat(r[3] / length, r[0] / length, r[1] / length, r[2] / length));
    }
    if (sized(node.scale, 3, "scale"))
      for (int axis = 0; axis < 3; ++axis) transform[axis] *= node.scale[static_cast<std::size_t>(axis)];
    return transform;
  }

  // Reads the organ from the extras, or from the node's name if there are none.
  void read_organ(const tinygltf::Node& node, NodeVisit& visit) const {
    const json& described = document_.json["nodes"][static_cast<std::size_t>(visit.node)];
    const auto extras = described.find("extras");
    bool found = false;
    if (extras != described.end() && extras->is_object()) {
      const auto refuse_value = [&](std::string_view key, const json& value, std::string_view rule) {
        refuse(source_, 0, fmt::format("node {}: extras.{} = {}", visit.node, key, in_quotes(value.dump())), rule,
               "write for example {\"plant\": 1, \"organ\": \"leaf\", \"rank\": 7}");
      };
      if (const auto plant = extras->find("plant"); plant != extras->end()) {
        const double value = plant->is_number() ? plant->get<double>() : -1.0;
        if (!(value >= 0.0 && value <= std::numeric_limits<std::uint32_t>::max()) || value != std::floor(value))
          refuse_value("plant", *plant, "must be a whole number in 0..4294967295");
        visit.organ.plant = static_cast<std::uint32_t>(value);
        found = true;
      }
      if (const auto organ = extras->find("organ"); organ != extras->end()) {
        if (!organ->is_string() || organ->get_ref<const std::string&>().empty())
          refuse_value("organ", *organ, "must be a name");
        visit.organ.name = organ->get<std::string>();
        found = true;
      }
      if (const auto rank = extras->find("rank"); rank != extras->end()) {
        const double value = rank->is_number() ? rank->get<double>() : 0.5;
        if (!(std::abs(value) <= std::numeric_limits<int>::max()) || value != std::floor(value))
          refuse_value("rank", *rank, "must be a whole number");
        visit.organ.rank = static_cast<int>(value);
        found = true;
      }
    }
    if (found) return;
    if (const std::optional<Organ> named = organ_from_name(node.name)) visit.organ = {named->plant, named->name, named->rank};
  }

  struct Numbers {
    const char* data = nullptr;
    std::size_t count = 0, stride = 0;
  };

  // Returns the bytes of an accessor, after checking that all its elements lie in its view and the view in its buffer.
  Numbers numbers(int index, const tinygltf::Accessor& accessor, std::size_t element_bytes) const {
    const auto bad = [&](std::string_view why) { refuse(source_, 0, fmt::format("accessor {}", index), why, write_again); };
    if (accessor.sparse.isSparse) bad("sparse accessors are not supported");
    const tinygltf::BufferView& view = item(model_.bufferViews, accessor.bufferView, "bufferView");
    const std::string_view buffer = item(document_.buffers, view.buffer, "buffer");
    if (view.byteOffset > buffer.size() || view.byteLength > buffer.size() - view.byteOffset)
      bad(fmt::format("bufferView {} ends beyond its buffer of {} bytes", accessor.bufferView, buffer.size()));
    const std::size_t stride = view.byteStride == 0 ? element_bytes : view.byteStride;
    if (stride < element_bytes) bad("its elements overlap");
    if (accessor.count == 0) bad("it is empty");
    if (accessor.byteOffset > view.byteLength || view.byteLength - accessor.byteOffset < element_bytes ||
        accessor.count - 1 > (view.byteLength - accessor.byteOffset - element_bytes) / stride)
      bad(fmt::format("its {} elements end beyond bufferView {}", accessor.count, accessor.bufferView));
    return {buffer.data() + view.byteOffset + accessor.byteOffset, accessor.count, stride};
  }

  struct VertexRange {
    std::uint32_t first = 0;
    std::size_t count = 0;
  };

  // Adds each accessor only once per node, because primitives of a mesh often share their positions.
  VertexRange read_positions(int index, const glm::dmat4& to_scene) {
    if (const auto known = positions_.find(index); known != positions_.end()) return known->second;
    const tinygltf::Accessor& accessor = item(model_.accessors, index, "accessor");
    if (accessor.type != TINYGLTF_TYPE_VEC3 || accessor.componentType != TINYGLTF_COMPONENT_TYPE_FLOAT)
      refuse(source_, 0, fmt::format("accessor {}", index), "positions must be VEC3 of float",
             "export it without quantization");
    const Numbers source = numbers(index, accessor, 3 * sizeof(float));
    const VertexRange range{static_cast<std::uint32_t>(builder_.vertex_count()), source.count};
    builder_.reserve_vertices(source.count);
    for (std::size_t i = 0; i < source.count; ++i) {
      glm::vec3 position;
      std::memcpy(&position, source.data + i * source.stride, sizeof position);
      const glm::dvec3 moved = to_scene * glm::dvec4(position, 1.0);
      if (!std::isfinite(moved.x) || !std::isfinite(moved.y) || !std::isfinite(moved.z))
        refuse(source_, 0, fmt::format("accessor {}: position {} is not finite", index, i),
               "the position or the transform of its node is infinite or nan", write_again);
      static_cast<void>(builder_.add_vertex(moved));
    }
    positions_.emplace(index, range);
    return range;
  }

  std::vector<std::uint32_t> read_indices(int index, std::size_t vertices) const {
    const tinygltf::Accessor& accessor = item(model_.accessors, index, "accessor");
    const int type = accessor.componentType;
    if (accessor.type != TINYGLTF_TYPE_SCALAR ||
        (type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE && type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT &&
         type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT))
      refuse(source_, 0, fmt::format("accessor {}", index), "indices must be SCALAR of an unsigned integer", write_again);
    const auto bytes = static_cast<std::size_t>(tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(type)));
    const Numbers source = numbers(index, accessor, bytes);
    std::vector<std::uint32_t> indices(source.count, 0);
    for (std::size_t i = 0; i < source.count; ++i) {
      std::memcpy(&indices[i], source.data + i * source.stride, bytes);
      if (indices[i] >= vertices)
        refuse(source_, 0, fmt::format("accessor {}: index {}", index, indices[i]),
               fmt::format("must be less than {}, the number of positions", vertices), write_again);
    }
    return indices;
  }

  void read_primitive(const tinygltf::Primitive& primitive, const NodeVisit& visit) {
    const int mode = primitive.mode;
    if (mode >= TINYGLTF_MODE_POINTS && mode < TINYGLTF_MODE_TRIANGLES) return;
    if (mode < TINYGLTF_MODE_POINTS || mode > TINYGLTF_MODE_TRIANGLE_FAN)
      refuse(source_, 0, fmt::format("node {}: a primitive of mode {}", visit.node, mode), "must lie in 0..6", write_again);
    const auto position = primitive.attributes.find("POSITION");
    if (position == primitive.attributes.end())
      refuse(source_, 0, fmt::format("node {}: a primitive without POSITION", visit.node), "it has no positions", write_again);
    const VertexRange range = read_positions(position->second, visit.to_scene);
    std::vector<std::uint32_t> corners;
    if (primitive.indices >= 0) {
      corners = read_indices(primitive.indices, range.count);
    } else {
      corners.resize(range.count);
      for (std::size_t i = 0; i < corners.size(); ++i) corners[i] = static_cast<std::uint32_t>(i);
    }
    if (corners.size() < 3 || (mode == TINYGLTF_MODE_TRIANGLES && corners.size() % 3 != 0))
      refuse(source_, 0, fmt::format("node {}: a primitive of {} corners", visit.node, corners.size()),
             "they do not form whole triangles", write_again);
    for (std::uint32_t& corner : corners) corner += range.first;
    add_triangles(mode, corners, material(primitive), visit);
  }

  std::uint32_t material(const tinygltf::Primitive& primitive) {
    if (primitive.material < 0) return builder_.default_optics(0);
    const std::string& name = item(model_.materials, primitive.material, "material").name;
    return name.empty() ? builder_.default_optics(0) : builder_.optics(name);
  }

  // glTF 2.0, section 3.7.4: a mirroring transform (negative determinant) reverses the winding, so that the front stays the
  // front.
  void add_triangles(int mode, std::span<const std::uint32_t> corners, std::uint32_t optics, const NodeVisit& visit) {
    const OrganHint& hint = visit.organ;
    const bool is_named = hint.plant || hint.name || hint.rank;
    const std::uint32_t organ =
        is_named
            ? builder_.organ({hint.plant.value_or(1), hint.name.value_or(builder_.optics_name(optics)), hint.rank.value_or(0)})
            : builder_.default_organ(optics);
    const bool mirrored = glm::determinant(glm::dmat3(visit.to_scene)) < 0.0;
    const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
      const std::uint32_t triangle[] = {a, mirrored ? c : b, mirrored ? b : c};
      builder_.add_polygon(triangle, optics, organ);
    };
    if (mode == TINYGLTF_MODE_TRIANGLES)
      for (std::size_t i = 0; i + 2 < corners.size(); i += 3) add(corners[i], corners[i + 1], corners[i + 2]);
    else if (mode == TINYGLTF_MODE_TRIANGLE_STRIP)
      for (std::size_t i = 0; i + 2 < corners.size(); ++i) add(corners[i], corners[i + 1 + i % 2], corners[i + 2 - i % 2]);
    else
      for (std::size_t i = 1; i + 1 < corners.size(); ++i) add(corners[0], corners[i], corners[i + 1]);
  }

  const MeshSource& source_;
  GltfDocument document_;
  const tinygltf::Model& model_;
  MeshBuilder builder_;
  std::vector<bool> visited_;
  std::unordered_map<int, VertexRange> positions_;  // of the current node, by accessor
};

}  // namespace

Mesh read_gltf(const MeshSource& source) {
  return GltfReader(source).read();
}

}  // namespace sunfleck
