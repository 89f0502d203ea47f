#include "files/formats/mesh/dae_reader.h"

#include "base/file.h"
#include "base/log.h"
#include "base/text_reader.h"
#include "files/formats/mesh/dae_geometry.h"
#include "files/formats/mesh/mesh_builder.h"
#include "files/formats/mesh/organ_name.h"
#include "files/formats/mesh/xml_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <optional>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace sunfleck {

namespace {

// Nodes that instances repeat may make a scene this much larger than its file; see most_vertices.
constexpr std::size_t harmless_growth = 16;
constexpr std::size_t harmless_count = std::size_t{1} << 20;
constexpr int deepest_instance = 100;

struct DaeVisit {
  pugi::xml_node node;
  glm::dmat4 to_scene{1.0};
  std::optional<std::uint32_t> object;  // the builder's object of the nearest node with a name
  bool names_organ = false;             // that name is one like plant1_leaf7
  int instances = 0;                    // how many <instance_node> lead here
};

class DaeReader {
 public:
  explicit DaeReader(const MeshSource& source)
      : source_(source),
        xml_(source),
        root_(xml_.root("COLLADA")),
        builder_(source),
        most_(std::max(harmless_count, harmless_growth * source.bytes.size())) {}

  DaeMesh read() {
    find_elements();
    const DaeFrame frame = read_frame();
    std::vector<DaeVisit> open;
    if (const pugi::xml_node instance = root_.child("scene").child("instance_visual_scene"))
      push_children(open,
                    {dae_target(xml_, elements_, instance, "url", "visual_scene"), frame.to_scene, std::nullopt, false, 0});
    while (!open.empty()) {
      const DaeVisit visit = open.back();
      open.pop_back();
      if (++visits_ > most_) refuse_growth(visit.node);
      enter(visit, open);
    }
    return {builder_.take(), frame.up};
  }

 private:
  struct DaeFrame {
    glm::dmat4 to_scene{1.0};
    FileAxis up = FileAxis::y;
  };

  void find_elements() {
    root_.parent().find_node([&](const pugi::xml_node& element) {
      if (const pugi::xml_attribute id = element.attribute("id")) elements_.try_emplace(id.value(), element);
      return false;
    });
  }

  // COLLADA 1.4.1, <asset>: metres per unit, and which axis is up; y by default. With x up, -y points to the right.
  DaeFrame read_frame() const {
    const pugi::xml_node asset = root_.child("asset");
    double unit_m = 1.0;
    if (const pugi::xml_attribute meter = asset.child("unit").attribute("meter")) {
      const std::optional<double> value = parse_number(trimmed(meter.value()));
      if (!value || !(*value > 0.0 && *value < 1e9))
        xml_.refuse_at(asset.child("unit"), fmt::format("meter = {}", in_quotes(meter.value())),
                       "must be metres per unit, above 0");
      unit_m = *value;
    }
    const std::string_view up = trimmed(asset.child("up_axis").child_value());
    if (!up.empty() && up != "X_UP" && up != "Y_UP" && up != "Z_UP")
      xml_.refuse_at(asset.child("up_axis"), fmt::format("up_axis {}", in_quotes(up)), "must be X_UP, Y_UP or Z_UP");
    const glm::dmat4 x_up(glm::dvec4(0, 1, 0, 0), glm::dvec4(-1, 0, 0, 0), glm::dvec4(0, 0, 1, 0), glm::dvec4(0, 0, 0, 1));
    const glm::dmat4 scale = glm::scale(glm::dmat4(1.0), glm::dvec3(unit_m));
    return {up == "X_UP" ? scale * x_up : scale, up == "Z_UP" ? FileAxis::z : FileAxis::y};
  }

  [[noreturn]] void refuse_growth(pugi::xml_node node) const {
    xml_.refuse_at(node, "the nodes repeat one another without end", fmt::format("more than {} in a small file", most_),
                   "apply the instances and export the file again");
  }

  // Pushes the nodes in reverse, so that they come off the stack in the order of the file.
  static void push_children(std::vector<DaeVisit>& open, const DaeVisit& parent) {
    for (pugi::xml_node child = parent.node.last_child(); child; child = child.previous_sibling())
      if (child.name() == std::string_view("node") || child.name() == std::string_view("instance_node"))
        open.push_back({child, parent.to_scene, parent.object, parent.names_organ, parent.instances});
  }

  void enter(DaeVisit visit, std::vector<DaeVisit>& open) {
    if (visit.node.name() == std::string_view("instance_node")) {
      if (++visit.instances > deepest_instance) refuse_growth(visit.node);
      visit.node = dae_target(xml_, elements_, visit.node, "url", "node");
      open.push_back(visit);
      return;
    }
    visit.to_scene = visit.to_scene * local_transform(visit.node);
    const std::string_view name = trimmed(name_of(visit.node));
    const bool names_organ = organ_from_name(name).has_value();
    if (names_organ || (!name.empty() && !visit.names_organ)) {
      visit.object = builder_.add_object(name);
      visit.names_organ = names_organ;
    }
    for (const pugi::xml_node instance : visit.node.children("instance_geometry")) add_geometry(instance, visit);
    if (visit.node.child("instance_controller"))
      warn(printable(
          fmt::format("{}: node {}: skinned or morphed geometry is not read", source_.file.string(), in_quotes(name))));
    push_children(open, visit);
  }

  // Returns the name of an element, or else its id; it may have neither.
  static std::string_view name_of(pugi::xml_node element) {
    const std::string_view name = element.attribute("name").value();
    return trimmed(name).empty() ? element.attribute("id").value() : name;
  }

  // COLLADA 1.4.1, <node>: the transforms apply to columns, the last one first.
  glm::dmat4 local_transform(pugi::xml_node node) const {
    glm::dmat4 transform(1.0);
    for (const pugi::xml_node element : node.children()) {
      const std::string_view kind = element.name();
      if (kind == "matrix") {
        const std::vector<double> m = xml_.numbers(element, 16);
        glm::dmat4 matrix;
        for (int i = 0; i < 16; ++i) matrix[i % 4][i / 4] = m[static_cast<std::size_t>(i)];
        transform *= matrix;
      } else if (kind == "translate") {
        const std::vector<double> t = xml_.numbers(element, 3);
        transform = glm::translate(transform, {t[0], t[1], t[2]});
      } else if (kind == "scale") {
        const std::vector<double> s = xml_.numbers(element, 3);
        transform = glm::scale(transform, {s[0], s[1], s[2]});
      } else if (kind == "rotate") {
        const std::vector<double> r = xml_.numbers(element, 4);
        const glm::dvec3 axis(r[0], r[1], r[2]);
        if (!(glm::length(axis) > 0.0)) xml_.refuse_at(element, "a rotation about no axis", "its first three numbers are 0");
        transform = glm::rotate(transform, glm::radians(r[3]), glm::normalize(axis));
      } else if (kind == "lookat" || kind == "skew") {
        xml_.refuse_at(element, fmt::format("a transform <{}>", kind), "it is not supported", "export it as a matrix");
      }
    }
    return transform;
  }

  void add_geometry(pugi::xml_node instance, const DaeVisit& visit) {
    const pugi::xml_node element = dae_target(xml_, elements_, instance, "url", "geometry");
    const auto [entry, is_new] = geometries_.try_emplace(element.attribute("id").value());
    if (is_new) entry->second = read_dae_geometry(xml_, elements_, element, numbers_left_);
    const DaeGeometry& geometry = entry->second;
    if (builder_.vertex_count() + geometry.positions.size() > most_) refuse_growth(instance);
    const std::uint32_t object = visit.object ? *visit.object : builder_.add_object(trimmed(name_of(element)));
    const auto first = static_cast<std::uint32_t>(builder_.vertex_count());
    builder_.reserve_vertices(geometry.positions.size());
    for (const glm::dvec3& position : geometry.positions) {
      const glm::dvec3 moved = visit.to_scene * glm::dvec4(position, 1.0);
      if (!std::isfinite(moved.x + moved.y + moved.z))
        xml_.refuse_at(instance, "a position that is not finite", "a number of the position or of its nodes is too large");
      static_cast<void>(builder_.add_vertex(moved));
    }
    const bool is_mirrored = glm::determinant(glm::dmat3(visit.to_scene)) < 0.0;
    const MaterialBindings bindings = material_bindings(instance);
    for (const DaePolygons& part : geometry.parts) {
      if (part.sizes.empty()) continue;
      const std::uint32_t optics = material_of(bindings, part.material);
      builder_.add_polygons(part.sizes, part.corners, {first, is_mirrored}, optics, builder_.object_organ(object, optics));
    }
  }

  // What an instance binds to the symbols of a geometry.
  using MaterialBindings = std::unordered_map<std::string_view, pugi::xml_node>;

  static MaterialBindings material_bindings(pugi::xml_node instance) {
    MaterialBindings bindings;
    for (const pugi::xml_node binding :
         instance.child("bind_material").child("technique_common").children("instance_material")) {
      bindings.insert_or_assign(binding.attribute("symbol").value(), binding);
    }
    return bindings;
  }

  // Returns the optics of the material that is bound to the symbol, or else of the symbol itself.
  std::uint32_t material_of(const MaterialBindings& bindings, std::string_view symbol) {
    std::string_view name;
    if (const auto bound = bindings.find(symbol); bound != bindings.end())
      name = trimmed(name_of(dae_target(xml_, elements_, bound->second, "target", "material")));
    if (name.empty()) name = trimmed(symbol);
    return name.empty() ? builder_.default_optics(0) : builder_.optics(name);
  }

  const MeshSource& source_;
  XmlFile xml_;
  pugi::xml_node root_;
  MeshBuilder builder_;
  std::size_t most_;  // visits and vertices
  std::size_t numbers_left_ = 3 * most_;
  std::size_t visits_ = 0;  // nodes entered so far
  DaeElements elements_;
  std::unordered_map<std::string_view, DaeGeometry> geometries_;  // by id
};

}  // namespace

DaeMesh read_dae(const MeshSource& source) {
  return DaeReader(source).read();
}

}  // namespace sunfleck
