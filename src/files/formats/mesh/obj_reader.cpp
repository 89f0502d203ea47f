#include "files/formats/mesh/obj_reader.h"

#include "base/check.h"
#include "base/text_reader.h"
#include "files/formats/mesh/mesh_builder.h"
#include "files/formats/mesh/organ_name.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tiny_obj_loader.h>

#include <cstdint>
#include <limits>
#include <optional>
#include <set>
#include <span>
#include <sstream>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

namespace sunfleck {

namespace {

// "default" is the group of all that is in no group.
bool is_group_name(std::string_view name) {
  return !name.empty() && name != "default";
}

// Checks the text before tinyobjloader parses it: that library replaces an unreadable number by 0, reports no line numbers, and
// lets exponents overflow. The positions are also taken from here, in double precision and correctly rounded.
class ObjText {
 public:
  explicit ObjText(const MeshSource& source) : source_(source) {}

  struct Checked {
    std::vector<glm::dvec3> positions;  // all positions, in order
    // The lines left for tinyobjloader: faces with corners in range, their materials, objects and groups, and, for negative
    // corners, one dummy position per position.
    std::string faces;
    bool groups_are_organs = false;  // otherwise objects are, for faces that have both
    NamedParts named;
  };

  Checked check() {
    if (source_.bytes.find('\0') != source_.bytes.npos)
      refuse(source_, 0, "contains a zero byte", "an OBJ file is text", "export it again as OBJ");
    if (source_.bytes.find_first_of("\f\v") != source_.bytes.npos)
      refuse(source_, 0, "contains a form feed or vertical tab", "only blanks and tabs separate the words of an OBJ file",
             "export it again as OBJ");
    LineReader lines(source_.bytes);
    while (lines.next()) check_line(lines.number(), lines.line());
    if (highest_ > static_cast<std::int64_t>(positions_.size())) refuse_corner(highest_line_, fmt::to_string(highest_));
    return {std::move(positions_), std::move(faces_), groups_.size() >= objects_.size(), {objects_.size(), groups_.size()}};
  }

 private:
  void check_line(std::size_t line, std::string_view rest) {
    const std::string_view whole = trimmed(rest);
    const std::string_view key = next_word(rest);
    if ((key == "v" || key == "f") && whole.ends_with('\\'))
      refuse(source_, line, "line ends in a backslash", "continued lines are not supported", "join it with the next line");
    if (key == "v") {
      glm::dvec3 position;
      for (int axis = 0; axis < 3; ++axis) position[axis] = coordinate(source_, line, rest);
      positions_.push_back(position);
      faces_ += "v 0 0 0\n";
    } else if (key == "f" || key == "usemtl" || key == "o" || key == "g") {
      if (key == "f") check_face(line, rest);
      if (key == "usemtl") has_material_ = !trimmed(rest).empty();
      if (key == "o") {
        object_ = trimmed(rest);
        group_ = {};
      }
      if (key == "g") group_ = trimmed(rest);
      faces_.append(key).append(" ").append(trimmed(rest)).append("\n");
    }
  }

  void check_face(std::size_t line, std::string_view rest) {
    if (!has_material_ && !source_.optics) static_cast<void>(MeshBuilder(source_).default_optics(line));
    if (!object_.empty()) objects_.insert(object_);
    if (is_group_name(group_)) groups_.insert(group_);
    int corners = 0;
    for (std::string_view word = next_word(rest); !word.empty(); word = next_word(rest), ++corners) {
      const std::optional<std::int64_t> number = vertex_number(word);
      const auto so_far = static_cast<std::int64_t>(positions_.size());
      if (!number || *number == 0 || *number < -so_far || *number > std::numeric_limits<int>::max()) refuse_corner(line, word);
      if (*number > highest_) {
        highest_ = *number;
        highest_line_ = line;
      }
    }
    if (corners < 3)
      refuse(source_, line, fmt::format("a face of {} corners", corners), "a face needs at least 3", "remove or complete it");
  }

  // Returns the vertex number of a corner like 7, 7/3, 7//5 or 7/3/5; nothing for any other word.
  static std::optional<std::int64_t> vertex_number(std::string_view word) {
    const std::size_t slash = word.find('/');
    const std::optional<std::int64_t> number = parse_integer(word.substr(0, slash));
    int parts = 1;
    for (std::size_t at = slash; at != word.npos; ++parts) {
      const std::size_t next = word.find('/', at + 1);
      const std::string_view part = word.substr(at + 1, next == word.npos ? next : next - at - 1);
      if (!part.empty() && !parse_integer(part)) return std::nullopt;
      at = next;
    }
    return parts <= 3 ? number : std::nullopt;
  }

  [[noreturn]] void refuse_corner(std::size_t line, std::string_view word) {
    refuse(source_, line, fmt::format("corner {}", in_quotes(word)),
           fmt::format("must be a vertex number in 1..{}, or negative to count back", positions_.size()),
           "export the file again");
  }

  const MeshSource& source_;
  std::vector<glm::dvec3> positions_;
  std::string faces_;
  std::int64_t highest_ = 0;  // the highest corner number; the corner may precede its vertex
  std::size_t highest_line_ = 0;
  bool has_material_ = false;
  std::string_view object_, group_;
  std::set<std::string_view> objects_, groups_;  // names that faces have
};

// Adds faces with their state: the last material, object and group.
class ObjFaces {
 public:
  ObjFaces(const MeshSource& source, std::span<const glm::dvec3> positions, bool groups_are_organs)
      : builder_(source), groups_are_organs_(groups_are_organs) {
    builder_.reserve_vertices(positions.size());
    for (const glm::dvec3& position : positions) static_cast<void>(builder_.add_vertex(position));
  }

  void count_vertex() { ++vertices_; }

  // Negative numbers count back from the last vertex so far.
  void add_face(std::span<const tinyobj::index_t> indices) {
    corners_.clear();
    for (const tinyobj::index_t& index : indices) {
      const int number = index.vertex_index;
      corners_.push_back(number > 0 ? static_cast<std::uint32_t>(number - 1) : static_cast<std::uint32_t>(vertices_ + number));
      ENSURE(corners_.back(), <, builder_.vertex_count());
    }
    const std::uint32_t optics = material_.empty() ? builder_.default_optics(0) : builder_.optics(material_);
    builder_.add_polygon(corners_, optics, organ(optics));
  }

  void use_material(std::string_view name) { material_ = trimmed(name); }

  void begin_object(std::string_view name) {
    object_ = named(trimmed(name));
    group_ = {};
  }

  void begin_group(std::span<const char*> names) {
    group_ = named(fmt::format("{}", fmt::join(names, " ")));
    if (!is_group_name(group_.name)) group_ = {};
    group_.organ.reset();
    for (const char* name : names)
      if (!group_.organ) group_.organ = organ_from_name(name);
  }

  Mesh take() { return builder_.take(); }

 private:
  struct Named {
    std::string name;
    std::optional<Organ> organ;           // of a name like plant1_leaf7
    std::optional<std::uint32_t> number;  // of the builder's object
  };

  static Named named(std::string_view name) { return {std::string(name), organ_from_name(name), std::nullopt}; }

  // Names like plant1_leaf7 come first. Of two other names, the one of the kind that distinguishes more faces counts.
  std::uint32_t organ(std::uint32_t optics) {
    if (group_.organ || object_.organ) return builder_.organ(group_.organ ? *group_.organ : *object_.organ);
    const bool takes_group = object_.name.empty() || (groups_are_organs_ && !group_.name.empty());
    Named& chosen = takes_group ? group_ : object_;
    if (chosen.name.empty()) return builder_.default_organ(optics);
    if (!chosen.number) {
      const auto [entry, is_new] = numbers_.try_emplace(chosen.name, 0);
      if (is_new) entry->second = builder_.add_object(chosen.name);
      chosen.number = entry->second;
    }
    return builder_.object_organ(*chosen.number, optics);
  }

  MeshBuilder builder_;
  bool groups_are_organs_;
  std::int64_t vertices_ = 0;
  std::vector<std::uint32_t> corners_;
  std::string material_;
  Named object_, group_;
  std::unordered_map<std::string, std::uint32_t> numbers_;  // objects and groups of one name are one organ
};

ObjFaces& faces(void* user) {
  return *static_cast<ObjFaces*>(user);
}

}  // namespace

// Uses tinyobjloader's callbacks instead of its LoadObj: they give the names of materials even if the .mtl is missing, and
// polygons and faces unchanged in file order.
Mesh read_obj(const MeshSource& source) {
  ObjText::Checked text = ObjText(source).check();
  ObjFaces mesh(source, text.positions, text.groups_are_organs);
  tinyobj::callback_t callback;
  callback.vertex_cb = [](void* user, float, float, float, float) { faces(user).count_vertex(); };
  callback.index_cb = [](void* user, tinyobj::index_t* indices, int count) {
    faces(user).add_face({indices, static_cast<std::size_t>(count)});
  };
  callback.usemtl_cb = [](void* user, const char* name, int) { faces(user).use_material(name); };
  callback.group_cb = [](void* user, const char** names, int count) {
    faces(user).begin_group({names, static_cast<std::size_t>(count)});
  };
  callback.object_cb = [](void* user, const char* name) { faces(user).begin_object(name); };
  std::istringstream faces_only(std::move(text.faces));
  std::string warnings, errors;
  if (!tinyobj::LoadObjWithCallback(faces_only, callback, &mesh, nullptr, &warnings, &errors))
    refuse(source, 0, "cannot be read as OBJ", errors, "export the file again");
  if (source.named != nullptr) *source.named = text.named;
  return mesh.take();
}

}  // namespace sunfleck
