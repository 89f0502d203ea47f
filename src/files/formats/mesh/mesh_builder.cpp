#include "files/formats/mesh/mesh_builder.h"

#include "base/check.h"
#include "base/file.h"
#include "base/text.h"
#include "base/text_reader.h"
#include "files/formats/mesh/organ_name.h"
#include "files/formats/mesh/organ_split.h"
#include "files/formats/mesh/polygon_cut.h"

#include <fmt/format.h>

#include <algorithm>

namespace sunfleck {

namespace {

constexpr std::size_t longest_name = 200;
constexpr std::size_t most_vertices = std::size_t{1} << 28;  // 6 GiB of positions

}  // namespace

void MeshBuilder::reserve_vertices(std::size_t count) {
  const std::size_t wanted = mesh_.vertices.size() + count;
  if (count > most_vertices || wanted > most_vertices)
    refuse(source_, 0, fmt::format("more than {} vertices", most_vertices), "the limit for one file", "split the file");
  if (wanted > mesh_.vertices.capacity()) mesh_.vertices.reserve(std::max(wanted, 2 * mesh_.vertices.capacity()));
}

std::uint32_t MeshBuilder::add_vertex(const glm::dvec3& position) {
  if (mesh_.vertices.size() == mesh_.vertices.capacity()) reserve_vertices(1);
  mesh_.vertices.push_back(position);
  return static_cast<std::uint32_t>(mesh_.vertices.size() - 1);
}

std::uint32_t MeshBuilder::optics(std::string_view name) {
  if (last_optics_ < mesh_.optics_names.size() && mesh_.optics_names[last_optics_] == name) return last_optics_;
  if (const auto known = optics_.find(name); known != optics_.end()) return last_optics_ = known->second;
  check_name("material", name);
  last_optics_ = static_cast<std::uint32_t>(mesh_.optics_names.size());
  mesh_.optics_names.emplace_back(name);
  optics_.emplace(name, last_optics_);
  return last_optics_;
}

std::uint32_t MeshBuilder::default_optics(std::size_t line) {
  if (!source_.optics)
    refuse(source_, line, "triangles without a material", "the file names no material here",
           "add optics = \"NAME\" to this file's [[geometry]] in the scene");
  return optics(*source_.optics);
}

std::uint32_t MeshBuilder::organ(const Organ& organ) {
  has_given_organs_ = true;
  const std::size_t known = mesh_.organs.size();
  const std::uint32_t number = find_organ(organ);
  if (source_.named != nullptr) source_.named->objects += mesh_.organs.size() - known;
  return number;
}

std::uint32_t MeshBuilder::find_organ(const Organ& organ) {
  if (last_organ_ < mesh_.organs.size() && mesh_.organs[last_organ_] == organ) return last_organ_;
  const auto [entry, is_new] =
      organs_.try_emplace({organ.plant, organ.name, organ.rank}, static_cast<std::uint32_t>(mesh_.organs.size()));
  if (is_new) {
    check_name("organ", organ.name);
    mesh_.organs.push_back(organ);
  }
  return last_organ_ = entry->second;
}

void MeshBuilder::check_name(std::string_view kind, std::string_view name) const {
  const auto bad = [&](std::string_view why, std::string_view cure) {
    refuse(source_, 0, fmt::format("{} {}", kind, in_quotes(name)), why, cure);
  };
  if (name.size() > longest_name) bad(fmt::format("a name may have at most {} bytes", longest_name), "shorten it");
  if (!is_utf8(name)) bad("it is not UTF-8", "save the file as UTF-8");
  if (printable(name) != name) bad("a name must be one line without control characters", "rename it");
}

std::uint32_t MeshBuilder::default_organ(std::uint32_t optics) {
  return find_organ({1, mesh_.optics_names[optics], 0});
}

std::uint32_t MeshBuilder::add_object(std::string_view name) {
  objects_.push_back({printable(is_utf8(name) ? std::string(name) : utf8_of_latin1(name)), std::nullopt});
  return static_cast<std::uint32_t>(objects_.size() - 1);
}

std::uint32_t MeshBuilder::object_organ(std::uint32_t object, std::uint32_t optics, std::uint32_t plant, int rank) {
  Object& known = objects_.at(object);
  if (known.name.empty()) return default_organ(optics);
  if (!known.organ) {
    if (const std::optional<Organ> given = organ_from_name(known.name)) {
      known.organ = organ(*given);
    } else {
      known.organ = find_organ({plant, free_name(plant, known.name), rank});
      if (source_.named != nullptr) ++source_.named->objects;
      only_object_ = known.organ;
      ++named_organs_;
    }
  }
  return *known.organ;
}

std::string MeshBuilder::free_name(std::uint32_t plant, const std::string& name) {
  const auto [entry, is_new] = objects_named_.try_emplace({plant, name}, 1);
  if (is_new) return name;
  for (;;) {
    std::string numbered = fmt::format("{} {}", name, ++entry->second);
    if (objects_named_.try_emplace({plant, numbered}, 1).second) return numbered;
  }
}

void MeshBuilder::set_surface(std::size_t triangle, std::uint32_t optics, std::uint32_t organ) {
  mesh_.optics_of.at(triangle) = optics;
  mesh_.organ_of.at(triangle) = organ;
}

Mesh MeshBuilder::take() {
  if (named_organs_ == 1 && !has_given_organs_) name_after_materials(mesh_, *only_object_);
  return std::move(mesh_);
}

void MeshBuilder::add_polygon(std::span<const std::uint32_t> corners, std::uint32_t optics, std::uint32_t organ,
                              std::optional<std::uint64_t> label) {
  DCHECK(corners.size(), >=, 3U);
  if (mesh_.triangles.size() + corners.size() > most_vertices)
    refuse(source_, 0, fmt::format("more than {} triangles", most_vertices), "the limit for one file", "split the file");
  const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    mesh_.triangles.emplace_back(a, b, c);
    mesh_.optics_of.push_back(optics);
    mesh_.organ_of.push_back(organ);
    if (label) mesh_.labels.push_back(*label);
  };
  std::vector<glm::dvec3> places;
  for (std::size_t i = 0; corners.size() > 3 && i < corners.size(); ++i) places.push_back(mesh_.vertices.at(corners[i]));
  if (!fan_folds(places)) {
    for (std::size_t i = 2; i < corners.size(); ++i) add(corners[0], corners[i - 1], corners[i]);
    return;
  }
  if (corners.size() > most_corners_with_ears)
    refuse(source_, 0, fmt::format("a polygon of {} corners that is not convex", corners.size()),
           fmt::format("at most {} are supported", most_corners_with_ears), "triangulate it");
  for (const CornerTriangle& ear : cut_ears(places)) add(corners[ear[0]], corners[ear[1]], corners[ear[2]]);
}

void MeshBuilder::add_polygons(std::span<const std::size_t> sizes, std::span<const std::uint32_t> corners,
                               const PlacedMesh& mesh, std::uint32_t optics, std::uint32_t organ) {
  std::vector<std::uint32_t> polygon;
  for (const std::size_t size : sizes) {
    polygon.clear();
    for (const std::uint32_t corner : corners.first(size)) polygon.push_back(mesh.first_vertex + corner);
    corners = corners.subspan(size);
    if (mesh.is_mirrored) std::reverse(polygon.begin() + 1, polygon.end());
    add_polygon(polygon, optics, organ);
  }
}

}  // namespace sunfleck
