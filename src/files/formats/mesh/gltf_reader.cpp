#include "files/formats/mesh/gltf_reader.h"

#include "base/log.h"
#include "base/text.h"
#include "base/text_reader.h"
#include "files/formats/mesh/gltf_document.h"
#include "files/formats/mesh/mesh_builder.h"
#include "files/formats/mesh/organ_name.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
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

// glTF 2.0, sections 3.6.2.2 and 3.7.2.1. The integers are unsigned.
constexpr std::size_t byte_type = 5121, short_type = 5123, int_type = 5125, float_type = 5126;
constexpr int triangles_mode = 4, strip_mode = 5, fan_mode = 6;

// Instances are geometry even if the file declares them optional.
constexpr const char* instances = "EXT_mesh_gpu_instancing";

// The known part of a node's organ; children inherit whatever they do not specify themselves.
struct OrganHint {
  std::optional<std::uint32_t> plant;
  std::optional<std::string> name;
  std::optional<int> rank;
  std::optional<std::uint32_t> object;  // the builder's object of the nearest name that is none like plant1_leaf7
};

struct NodeVisit {
  int node = 0;
  glm::dmat4 to_scene{1.0};
  OrganHint organ;
};

class GltfReader {
 public:
  explicit GltfReader(const MeshSource& source)
      : source_(source), document_(open_gltf(source)), file_(source, document_.json, "the file"), builder_(source) {}

  Mesh read() {
    for (const std::string& name : file_.get<std::vector<std::string>>("extensionsRequired")) refuse_if_unread(name);
    warn_of_cutouts();
    visited_.assign(file_.count("nodes"), false);
    std::vector<NodeVisit> open;
    push(open, roots(), NodeVisit{});
    while (!open.empty()) {
      const NodeVisit visit = open.back();
      open.pop_back();
      enter(visit, open);
    }
    warn_of_poses();
    return builder_.take();
  }

 private:
  // Extensions that say nothing about surfaces or where they stand begin with these words.
  void refuse_if_unread(std::string_view extension) const {
    constexpr std::array<std::string_view, 7> harmless{"KHR_materials_", "KHR_texture_", "KHR_lights_",  "KHR_xmp",
                                                       "EXT_texture_",   "EXT_lights_",  "MSFT_texture_"};
    if (std::any_of(harmless.begin(), harmless.end(), [&](std::string_view word) { return extension.starts_with(word); }))
      return;
    refuse(source_, 0, fmt::format("needs the extension {}", in_quotes(extension)), "it is not supported",
           "export the file without it");
  }

  void warn_of_poses() const {
    if (posed_ == 0) return;
    warn(printable(
        fmt::format("{}: skins and morph targets are not read ({}); the triangles are those of the mesh at rest; apply "
                    "the pose before you export the file",
                    source_.file.string(), counted(posed_, "node"))));
  }

  // Returns whether a skin or the weights of morph targets move the node's triangles.
  static bool is_posed(const GltfObject& node, const GltfObject& mesh) {
    if (node.find("skin") != nullptr) return true;
    const auto of_mesh = mesh.get<std::vector<double>>("weights");
    const auto weights = node.get<std::vector<double>>("weights", of_mesh);
    return std::any_of(weights.begin(), weights.end(), [](double weight) { return weight != 0.0; });
  }

  void warn_of_cutouts() const {
    for (std::size_t i = 0; i < file_.count("materials"); ++i) {
      const GltfObject material = file_.item("materials", static_cast<int>(i), "material");
      if (material.get<std::string>("alphaMode", "OPAQUE") == "OPAQUE") continue;
      if (material.inside("pbrMetallicRoughness").find("baseColorTexture") == nullptr) continue;
      warn(fmt::format("{}: material {}: its transparency texture is not read; its triangles count as opaque",
                       source_.file.string(), in_quotes(material.get<std::string>("name"))));
    }
  }

  // Returns the nodes of the default scene, otherwise those of the first scene, otherwise all nodes without a parent.
  std::vector<int> roots() const {
    if (file_.find("scene") != nullptr || file_.count("scenes") > 0)
      return file_.item("scenes", file_.get("scene", 0), "scene").get<std::vector<int>>("nodes");
    std::vector<bool> is_child(visited_.size(), false);
    for (std::size_t i = 0; i < is_child.size(); ++i)
      for (const int child : file_.item("nodes", static_cast<int>(i), "node").get<std::vector<int>>("children")) {
        static_cast<void>(file_.item("nodes", child, "node"));
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
    const GltfObject node = file_.item("nodes", visit.node, "node");
    const auto number = static_cast<std::size_t>(visit.node);
    if (visited_[number])
      refuse(source_, 0, fmt::format("node {} is reached twice", visit.node), "nodes must form trees, without cycles",
             write_again);
    visited_[number] = true;
    if (node.inside("extensions").find(instances) != nullptr) refuse_if_unread(instances);
    visit.to_scene = visit.to_scene * local_transform(node, visit.node);
    read_organ(node, visit);
    if (node.find("mesh") != nullptr) {
      const GltfObject mesh = file_.item("meshes", node.get("mesh", -1), "mesh");
      positions_.clear();
      if (is_posed(node, mesh)) ++posed_;
      if (const auto name = mesh.get<std::string>("name"); node.get<std::string>("name").empty() && !name.empty())
        visit.organ.object = builder_.add_object(name);
      for (std::size_t i = 0; i < mesh.count("primitives"); ++i)
        read_primitive(mesh.item("primitives", static_cast<int>(i), "primitive"), visit);
    }
    push(open, node.get<std::vector<int>>("children"), visit);
  }

  glm::dmat4 local_transform(const GltfObject& node, int number) const {
    const auto numbers = [&](const char* key, std::size_t size) {
      std::vector<double> values = node.get<std::vector<double>>(key);
      if (!values.empty() && values.size() != size)
        refuse(source_, 0, fmt::format("node {}: {} has {} numbers", number, key, values.size()),
               fmt::format("it needs {}", size), write_again);
      return values;
    };
    if (const std::vector<double> m = numbers("matrix", 16); !m.empty()) return glm::make_mat4(m.data());
    glm::dmat4 transform(1.0);
    if (const std::vector<double> t = numbers("translation", 3); !t.empty())
      transform[3] = glm::dvec4(glm::make_vec3(t.data()), 1.0);
    if (const std::vector<double> r = numbers("rotation", 4); !r.empty()) {  // x, y, z, w
      const double length = std::hypot(std::hypot(r[0], r[1]), std::hypot(r[2], r[3]));
      if (!(std::abs(length - 1.0) < 0.01))
        refuse(source_, 0, fmt::format("node {}: a rotation of length {}", number, length), "must be a unit quaternion",
               write_again);
      transform *= glm::mat4_cast(glm::dquat(r[3] / length, r[0] / length, r[1] / length, r[2] / length));
    }
    if (const std::vector<double> s = numbers("scale", 3); !s.empty())
      for (int axis = 0; axis < 3; ++axis) transform[axis] *= s[static_cast<std::size_t>(axis)];
    return transform;
  }

  // Reads the organ from the extras, or from the node's name if there are none.
  void read_organ(const GltfObject& node, NodeVisit& visit) {
    const json* extras = node.find("extras");
    bool found = false;
    if (extras != nullptr && extras->is_object()) {
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
    const auto name = node.get<std::string>("name");
    const std::optional<Organ> named = organ_from_name(name);
    if (named && !found) visit.organ = {named->plant, named->name, named->rank, std::nullopt};
    if (!named && !name.empty()) visit.organ.object = builder_.add_object(name);
  }

  struct Numbers {
    const char* data = nullptr;
    std::size_t count = 0, stride = 0;
  };

  // Returns the bytes of an accessor, after checking that all its elements lie in its view and the view in its buffer.
  Numbers numbers(int index, const GltfObject& accessor, std::size_t element_bytes) const {
    const auto bad = [&](std::string_view why) { refuse(source_, 0, fmt::format("accessor {}", index), why, write_again); };
    if (accessor.find("sparse") != nullptr) bad("sparse accessors are not supported");
    const int number = accessor.get("bufferView", -1);
    const GltfObject view = file_.item("bufferViews", number, "bufferView");
    const int buffer = view.get("buffer", -1);
    if (buffer < 0 || static_cast<std::size_t>(buffer) >= document_.buffers.size())
      bad(fmt::format("bufferView {} needs buffer {}, but the file has {}", number, buffer, document_.buffers.size()));
    std::string_view bytes = document_.buffers[static_cast<std::size_t>(buffer)];
    const std::size_t first = view.get<std::size_t>("byteOffset"), length = view.get<std::size_t>("byteLength");
    if (first > bytes.size() || length > bytes.size() - first)
      bad(fmt::format("bufferView {} ends beyond its buffer of {} bytes", number, bytes.size()));
    bytes = bytes.substr(first, length);
    const std::size_t given = view.get<std::size_t>("byteStride"), stride = given == 0 ? element_bytes : given;
    if (given % 4 != 0 || given > 252)
      bad(fmt::format("bufferView {}: byteStride {} must be a multiple of 4 up to 252", number, given));
    if (stride < element_bytes) bad("its elements overlap");
    const std::size_t count = accessor.get<std::size_t>("count"), offset = accessor.get<std::size_t>("byteOffset");
    if (count == 0) bad("it is empty");
    if (offset > bytes.size() || bytes.size() - offset < element_bytes ||
        count - 1 > (bytes.size() - offset - element_bytes) / stride)
      bad(fmt::format("its {} elements end beyond bufferView {}", count, number));
    return {bytes.data() + offset, count, stride};
  }

  struct VertexRange {
    std::uint32_t first = 0;
    std::size_t count = 0;
  };

  // Adds each accessor only once per node, because primitives of a mesh often share their positions.
  VertexRange read_positions(int index, const glm::dmat4& to_scene) {
    if (const auto known = positions_.find(index); known != positions_.end()) return known->second;
    const GltfObject accessor = file_.item("accessors", index, "accessor");
    if (accessor.get<std::string>("type") != "VEC3" || accessor.get<std::size_t>("componentType") != float_type)
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
    const GltfObject accessor = file_.item("accessors", index, "accessor");
    const std::size_t type = accessor.get<std::size_t>("componentType");
    const std::size_t bytes = type == byte_type ? 1 : type == short_type ? 2 : type == int_type ? 4 : 0;
    if (accessor.get<std::string>("type") != "SCALAR" || bytes == 0)
      refuse(source_, 0, fmt::format("accessor {}", index), "indices must be SCALAR of an unsigned integer", write_again);
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

  void read_primitive(const GltfObject& primitive, const NodeVisit& visit) {
    const int mode = primitive.get("mode", triangles_mode);
    if (mode < triangles_mode) return;  // points and lines have no surface
    if (mode > fan_mode)
      refuse(source_, 0, fmt::format("node {}: a primitive of mode {}", visit.node, mode), "must lie in 0..6", write_again);
    const int positions = primitive.inside("attributes").get("POSITION", -1);
    if (positions < 0)
      refuse(source_, 0, fmt::format("node {}: a primitive without POSITION", visit.node), "it has no positions", write_again);
    const VertexRange range = read_positions(positions, visit.to_scene);
    std::vector<std::uint32_t> corners;
    if (primitive.find("indices") != nullptr) {
      corners = read_indices(primitive.get("indices", -1), range.count);
    } else {
      corners.resize(range.count);
      for (std::size_t i = 0; i < corners.size(); ++i) corners[i] = static_cast<std::uint32_t>(i);
    }
    if (corners.size() < 3 || (mode == triangles_mode && corners.size() % 3 != 0))
      refuse(source_, 0, fmt::format("node {}: a primitive of {} corners", visit.node, corners.size()),
             "they do not form whole triangles", write_again);
    for (std::uint32_t& corner : corners) corner += range.first;
    add_triangles(mode, corners, material(primitive), visit);
  }

  std::uint32_t material(const GltfObject& primitive) {
    if (primitive.find("material") == nullptr) return builder_.default_optics(0);
    const auto name = file_.item("materials", primitive.get("material", -1), "material").get<std::string>("name");
    return name.empty() ? builder_.default_optics(0) : builder_.optics(name);
  }

  // glTF 2.0, section 3.7.4: a mirroring transform (negative determinant) reverses the winding, so that the front stays the
  // front.
  void add_triangles(int mode, std::span<const std::uint32_t> corners, std::uint32_t optics, const NodeVisit& visit) {
    const std::uint32_t organ = organ_of(visit.organ, optics);
    const bool mirrored = glm::determinant(glm::dmat3(visit.to_scene)) < 0.0;
    const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
      const std::uint32_t triangle[] = {a, mirrored ? c : b, mirrored ? b : c};
      builder_.add_polygon(triangle, optics, organ);
    };
    if (mode == triangles_mode)
      for (std::size_t i = 0; i + 2 < corners.size(); i += 3) add(corners[i], corners[i + 1], corners[i + 2]);
    else if (mode == strip_mode)
      for (std::size_t i = 0; i + 2 < corners.size(); ++i) add(corners[i], corners[i + 1 + i % 2], corners[i + 2 - i % 2]);
    else
      for (std::size_t i = 1; i + 1 < corners.size(); ++i) add(corners[0], corners[i], corners[i + 1]);
  }

  std::uint32_t organ_of(const OrganHint& hint, std::uint32_t optics) {
    const std::uint32_t plant = hint.plant.value_or(1);
    const int rank = hint.rank.value_or(0);
    if (!hint.name && hint.object) return builder_.object_organ(*hint.object, optics, plant, rank);
    if (!hint.name && !hint.plant && !hint.rank) return builder_.default_organ(optics);
    return builder_.organ({plant, hint.name.value_or(builder_.optics_name(optics)), rank});
  }

  const MeshSource& source_;
  GltfDocument document_;
  GltfObject file_;
  MeshBuilder builder_;
  std::vector<bool> visited_;
  std::size_t posed_ = 0;                           // nodes with a skin, or with weights of morph targets
  std::unordered_map<int, VertexRange> positions_;  // of the current node, by accessor
};

}  // namespace

Mesh read_gltf(const MeshSource& source) {
  return GltfReader(source).read();
}

}  // namespace sunfleck
