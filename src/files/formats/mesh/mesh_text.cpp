#include "files/formats/mesh/mesh_text.h"

#include "base/byte_text.h"
#include "base/check.h"
#include "base/error.h"
#include "files/formats/mesh/caribu_label.h"
#include "files/formats/mesh/organ_name.h"
#include "physics/canopy/axes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>
#include <limits>
#include <map>
#include <set>
#include <string_view>

namespace sunfleck {

namespace {

void check_arrays(const Mesh& mesh) {
  EXPECT(mesh.optics_of.size(), ==, mesh.triangles.size());
  EXPECT(mesh.organ_of.size(), ==, mesh.triangles.size());
  EXPECT(mesh.labels.empty() || mesh.labels.size() == mesh.triangles.size(), ==, true);
  constexpr std::size_t most = std::numeric_limits<std::int32_t>::max();  // programs store vertex numbers as int
  if (std::max(mesh.vertices.size(), mesh.triangles.size()) > most)
    throw_failure(fmt::format("a mesh of {} triangles", mesh.triangles.size()), fmt::format("a file may hold at most {}", most),
                  "write it in parts");
}

// The labels of a mesh's triangles.
class Labels {
 public:
  explicit Labels(const Mesh& mesh) : mesh_(mesh) {
    for (const Organ& organ : mesh.organs) organ_roles_.push_back(role_from_name(organ.name));
    for (const std::string& name : mesh.optics_names) optics_roles_.push_back(role_from_name(name));
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const Organ organ = organ_of(t);
      if (organ.role == Role::leaf) plants_with_leaves_.insert(organ.plant);
    }
  }

  // Returns the label of a triangle, which has this number in its organ. As in a run, what no name describes is a leaf, or a stem
  // if its plant has leaves.
  [[nodiscard]] std::string of(std::size_t triangle, std::size_t number_in_organ) const {
    const std::uint64_t label = mesh_.labels.empty() ? no_label : mesh_.labels[triangle];
    if (label != no_label) return caribu_label_as_read(mesh_.organs[mesh_.organ_of[triangle]], label);
    Organ organ = organ_of(triangle);
    if (!organ.role) organ.role = plants_with_leaves_.contains(organ.plant) ? Role::stem : Role::leaf;
    return caribu_label(organ, number_in_organ);
  }

 private:
  // Returns what the label states, with the role that its name suggests: the optics of a surface, so that an ear with optics
  // `leaf2` is a leaf of species 2, or the organ of a surface whose optics name no part of a plant, such as `green`.
  [[nodiscard]] Organ organ_of(std::size_t triangle) const {
    const std::uint32_t number = mesh_.organ_of[triangle], optics = mesh_.optics_of[triangle];
    const Organ& organ = mesh_.organs[number];
    if (optics_roles_[optics]) return {organ.plant, mesh_.optics_names[optics], organ.rank, optics_roles_[optics]};
    return {organ.plant, organ.name, organ.rank, organ_roles_[number]};
  }

  const Mesh& mesh_;
  std::vector<std::optional<Role>> organ_roles_, optics_roles_;  // [organ] and [optics], as far as their names suggest one
  std::set<std::uint32_t> plants_with_leaves_;
};

// Returns whether reading the label back yields optics of this name.
bool survives_label(const std::string& optics) {
  constexpr std::string_view species = "23456789";
  const bool known = optics.starts_with("leaf") || optics.starts_with("stem");
  const bool numbered = optics.size() == 5 && species.find(optics[4]) != species.npos;
  return optics == "soil" || (known && (optics.size() == 4 || numbered));
}

}  // namespace

std::string obj_text(const Mesh& mesh, Axes axes) {
  check_arrays(mesh);
  std::string text = fmt::format("# sunfleck: {}; m\n", axes_text(axes));
  const auto end = std::back_inserter(text);
  for (const glm::dvec3& vertex_m : mesh.vertices) {
    const glm::dvec3 v = user_direction(axes, vertex_m);
    fmt::format_to(end, "v {} {} {}\n", v.x, v.y, v.z);
  }
  constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
  std::uint32_t organ = none, optics = none;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (organ != mesh.organ_of[t]) text += "o " + node_name(mesh.organs[mesh.organ_of[t]]) + "\n";
    if (optics != mesh.optics_of[t]) text += "usemtl " + mesh.optics_names[mesh.optics_of[t]] + "\n";
    organ = mesh.organ_of[t];
    optics = mesh.optics_of[t];
    const glm::uvec3& corners = mesh.triangles[t];
    fmt::format_to(end, "f {} {} {}\n", corners.x + 1, corners.y + 1, corners.z + 1);
  }
  return text;
}

std::string ply_mesh_bytes(const Mesh& mesh, Axes axes) {
  check_arrays(mesh);
  std::string bytes = fmt::format("ply\nformat binary_little_endian 1.0\ncomment sunfleck: {}; m\n", axes_text(axes));
  for (std::size_t i = 0; i < mesh.organs.size(); ++i)
    bytes += fmt::format("comment organ {} {}\n", i, node_name(mesh.organs[i]));
  for (std::size_t i = 0; i < mesh.optics_names.size(); ++i)
    bytes += fmt::format("comment optics {} {}\n", i, mesh.optics_names[i]);
  bytes += fmt::format("element vertex {}\nproperty double x\nproperty double y\nproperty double z\n", mesh.vertices.size());
  bytes += fmt::format(
      "element face {}\nproperty list uchar int vertex_indices\nproperty uint plant\nproperty int rank\nproperty uint organ\n"
      "property uint optics\nend_header\n",
      mesh.triangles.size());
  for (const glm::dvec3& vertex_m : mesh.vertices) {
    const glm::dvec3 v = user_direction(axes, vertex_m);
    append_bytes(bytes, std::array{v.x, v.y, v.z});
  }
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const glm::uvec3& corners = mesh.triangles[t];
    const Organ& organ = mesh.organs[mesh.organ_of[t]];
    append_bytes(bytes, std::uint8_t{3});
    append_bytes(bytes, std::array{corners.x, corners.y, corners.z});
    append_bytes(bytes, organ.plant);
    append_bytes(bytes, std::int32_t{organ.rank});
    append_bytes(bytes, std::array{mesh.organ_of[t], mesh.optics_of[t]});
  }
  return bytes;
}

std::string can_text(const Mesh& mesh) {
  check_arrays(mesh);
  std::string text = "# sunfleck: x east, y north, z up; m\n";
  const Labels labels(mesh);
  std::vector<std::size_t> next_number(mesh.organs.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    text += "p 1 " + labels.of(t, next_number[mesh.organ_of[t]]++) + " 3";
    for (int corner = 0; corner < 3; ++corner) {
      const glm::dvec3& v = mesh.vertices[mesh.triangles[t][corner]];
      fmt::format_to(std::back_inserter(text), " {} {} {}", 0.0 - v.z, 0.0 - v.x, v.y);  // no -0
    }
    text += '\n';
  }
  return text;
}

std::size_t organs_merged_in_can(const Mesh& mesh) {
  constexpr std::size_t number_digits = 3;  // of the triangle in its organ
  const Labels labels(mesh);
  std::map<std::string, std::set<std::uint32_t>> organs_of;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    std::string label = labels.of(t, 0);
    label.resize(label.size() - number_digits);
    organs_of[label].insert(mesh.organ_of[t]);
  }
  std::set<std::uint32_t> merged;
  for (const auto& [label, organs] : organs_of) {
    if (organs.size() > 1) merged.insert(organs.begin(), organs.end());
  }
  return merged.size();
}

std::vector<std::string> optics_lost_in_can(const Mesh& mesh) {
  std::vector<bool> used(mesh.optics_names.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    if (mesh.labels.empty() || mesh.labels[t] == no_label) used[mesh.optics_of[t]] = true;
  std::vector<std::string> lost;
  for (std::size_t i = 0; i < used.size(); ++i)
    if (used[i] && !survives_label(mesh.optics_names[i])) lost.push_back(mesh.optics_names[i]);
  return lost;
}

}  // namespace sunfleck
