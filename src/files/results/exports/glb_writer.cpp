#include "files/results/exports/glb_writer.h"

#include "base/error.h"
#include "base/file.h"
#include "base/text.h"
#include "files/formats/mesh/gltf_parts.h"
#include "files/formats/mesh/organ_name.h"
#include "files/results/exports/record_entries.h"
#include "physics/canopy/axes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace sunfleck {
namespace {

constexpr const char* file_name = "canopy.glb";

// Returns the name of a vertex attribute; custom names in glTF begin with `_` and are in capitals.
std::string attribute_of(const std::string& band, std::string_view ending) {
  return "_" + band + "_" + upper_case(ending);
}

// Builds a root node with the record, at the canopy's origin, with one child per organ and one primitive per optics name. In
// the user's axes east_north_up, the frame is x east, y up, z south from the south-west corner, because glTF has y up.
class CanopyWriter {
 public:
  explicit CanopyWriter(const ExportData& data) : data_(data) {
    model_.asset.version = "2.0";
    model_.asset.generator = "sunfleck";
    model_.scenes.emplace_back();
    model_.scenes[0].nodes = {0};
    model_.defaultScene = 0;
    for (const std::string& name : data.fields.optics_names) {
      tinygltf::Material material;
      material.name = printable(name);
      material.doubleSided = true;
      material.pbrMetallicRoughness.metallicFactor = 0.0;
      model_.materials.push_back(material);
    }
    add_root();
    if (data.fields.size() > 0) model_.buffers.emplace_back();
  }

  tinygltf::Model take() {
    const Canopy& canopy = data_.model.canopy;
    std::vector<std::map<std::uint16_t, std::vector<std::size_t>>> organs(canopy.organs.size());  // elements by optics
    for (std::size_t e = 0; e < canopy.size(); ++e) organs[canopy.organ_of[e]][canopy.optics_of[e]].push_back(e);
    for (std::size_t o = 0; o < organs.size(); ++o) {
      if (organs[o].empty()) continue;
      Organ organ = canopy.organs[o];
      organ.name = printable(organ.name);
      tinygltf::Mesh mesh;
      mesh.name = node_name(organ);
      for (const auto& [optics, elements] : organs[o]) mesh.primitives.push_back(primitive(optics, elements));
      add_node(organ, std::move(mesh));
    }
    return std::move(model_);
  }

 private:
  void add_root() {
    using tinygltf::Value;
    Value::Object extras;
    for (const RecordEntry& entry : record_entries(data_.record, data_.model)) extras[entry.key] = Value(entry.value);
    if (axes() == Axes::east_north_up) extras["axes"] = Value(std::string("x east, y up, z south; m"));
    Value::Object units{{"_AREA_M2", Value(std::string("m2"))}};
    for (std::size_t b = 0; b < data_.fields.light.size(); ++b) {
      for (const LightValues& column : data_.fields.light[b]) {
        units[attribute_of(data_.model.bands[b].name, ending(column.column))] = Value(std::string(light_units));
      }
    }
    extras["units"] = Value(std::move(units));
    extras["no_interval"] = Value(std::string("_ERROR is -1 where there were too few hits for a confidence interval"));
    tinygltf::Node root;
    root.name = "canopy";
    root.extras = Value(std::move(extras));
    const Plot& plot = data_.model.plot;
    const glm::dvec3 from_user_m = scene_direction(plot.axes, user_position_m(plot, data_.model.canopy.origin_m));
    const glm::dvec3 origin = y_up_direction(plot.axes, from_user_m);
    if (origin != glm::dvec3(0.0)) root.translation = {origin.x, origin.y, origin.z};
    model_.nodes.push_back(std::move(root));
  }

  void add_node(const Organ& organ, tinygltf::Mesh mesh) {
    tinygltf::Node node;
    node.name = mesh.name;
    node.extras = organ_extras(organ);
    node.mesh = static_cast<int>(model_.meshes.size());
    model_.meshes.push_back(std::move(mesh));
    model_.nodes[0].children.push_back(static_cast<int>(model_.nodes.size()));
    model_.nodes.push_back(std::move(node));
  }

  tinygltf::Primitive primitive(std::uint16_t optics, const std::vector<std::size_t>& elements) {
    tinygltf::Primitive shape;
    shape.mode = TINYGLTF_MODE_TRIANGLES;
    shape.material = optics;
    std::vector<std::array<float, 3>> positions;
    for (const std::size_t e : elements) {
      for (const glm::vec3& corner : data_.model.canopy.corners[e]) {
        const glm::vec3 position(y_up_direction(axes(), corner));
        positions.push_back({position.x, position.y, position.z});
      }
    }
    shape.attributes["POSITION"] = add_positions(model_, positions);
    if (!data_.colours.empty()) shape.attributes["COLOR_0"] = add_colours(elements);
    const ElementFields& fields = data_.fields;
    shape.attributes["_TRIANGLE"] = add_values(elements, [](std::size_t e) { return static_cast<double>(e); });
    shape.attributes["_AREA_M2"] = add_values(elements, [&](std::size_t e) { return fields.area_m2[e]; });
    for (std::size_t b = 0; b < fields.light.size(); ++b) {
      for (const LightValues& column : fields.light[b]) {
        shape.attributes[attribute_of(data_.model.bands[b].name, ending(column.column))] =
            add_values(elements, [&](std::size_t e) { return std::isnan(column.values[e]) ? -1.0 : column.values[e]; });
      }
    }
    return shape;
  }

  template <class ValueOf>
  int add_values(const std::vector<std::size_t>& elements, const ValueOf& value_of) {
    std::vector<float> values;
    for (const std::size_t e : elements) values.insert(values.end(), 3, static_cast<float>(value_of(e)));
    tinygltf::Accessor accessor;
    accessor.type = TINYGLTF_TYPE_SCALAR;
    accessor.componentType = TINYGLTF_COMPONENT_TYPE_FLOAT;
    return add_piece<float>(model_, values, TINYGLTF_TARGET_ARRAY_BUFFER, accessor);
  }

  int add_colours(const std::vector<std::size_t>& elements) {
    constexpr double full = 65535.0;
    std::vector<std::array<std::uint16_t, 4>> colours;
    for (const std::size_t e : elements) {
      const std::array<double, 3>& linear = data_.colours[e].linear;
      std::array<std::uint16_t, 4> colour{0, 0, 0, 65535};
      for (std::size_t c = 0; c < 3; ++c) {
        colour[c] = static_cast<std::uint16_t>(std::lround(full * std::clamp(linear[c], 0.0, 1.0)));
      }
      colours.insert(colours.end(), 3, colour);
    }
    tinygltf::Accessor accessor;
    accessor.type = TINYGLTF_TYPE_VEC4;
    accessor.componentType = TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT;
    accessor.normalized = true;
    return add_piece<std::array<std::uint16_t, 4>>(model_, colours, TINYGLTF_TARGET_ARRAY_BUFFER, accessor);
  }

  [[nodiscard]] Axes axes() const { return data_.model.plot.axes; }

  const ExportData& data_;
  tinygltf::Model model_;
};

}  // namespace

std::string glb_bytes(const ExportData& data) {
  // Beyond this, single precision cannot hold all triangle numbers.
  constexpr std::size_t most_triangles = std::size_t{1} << 24;
  if (data.fields.size() > most_triangles) {
    throw_failure(fmt::format("{}: {} triangles", file_name, data.fields.size()),
                  fmt::format("the format can number at most {}", most_triangles), "export vtp or nc");
  }
  return gltf_bytes(CanopyWriter(data).take(), GltfForm::binary, file_name);
}

}  // namespace sunfleck
