#include "files/formats/mesh/dae_geometry.h"

#include "base/text_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <span>
#include <string>

namespace sunfleck {

namespace {

class DaeGeometryReader {
 public:
  DaeGeometryReader(const XmlFile& xml, const DaeElements& elements, std::size_t& numbers_left)
      : xml_(xml), elements_(elements), numbers_left_(numbers_left) {}

  DaeGeometry read(pugi::xml_node mesh) {
    for (const pugi::xml_node element : mesh.children()) {
      const std::string_view name = element.name();
      if (name == "triangles" || name == "polylist" || name == "polygons" || name == "trifans" || name == "tristrips")
        read_primitive(element, name);
    }
    return std::move(geometry_);
  }

 private:
  // The numbers of <p>: groups of `stride`, of which one is a corner's position.
  struct Layout {
    std::size_t stride = 1, offset = 0;
    std::size_t first = 0, count = 0;  // of the positions
  };

  std::size_t size_attribute(pugi::xml_node element, const char* name, std::size_t otherwise) const {
    constexpr std::int64_t most = 1'000'000'000;
    const pugi::xml_attribute attribute = element.attribute(name);
    if (!attribute) return otherwise;
    const std::optional<std::int64_t> value = parse_integer(attribute.value());
    if (!value || *value < 0 || *value > most)
      xml_.refuse_at(element, fmt::format("{} = {}", name, in_quotes(attribute.value())), "must be a whole number in 0..1e9");
    return static_cast<std::size_t>(*value);
  }

  Layout layout_of(pugi::xml_node primitive) {
    Layout layout;
    bool found = false;
    for (const pugi::xml_node input : primitive.children("input")) {
      const std::size_t offset = size_attribute(input, "offset", 0);
      layout.stride = std::max(layout.stride, offset + 1);
      if (input.attribute("semantic").value() != std::string_view("VERTEX")) continue;
      const pugi::xml_node vertices = dae_target(xml_, elements_, input, "source", "vertices");
      layout.offset = offset;
      const auto [entry, is_new] = positions_.try_emplace(vertices.attribute("id").value());
      if (is_new) entry->second = read_positions(vertices);
      layout.first = entry->second.first;
      layout.count = entry->second.count;
      found = true;
    }
    if (!found) xml_.refuse_at(primitive, fmt::format("<{}> without vertices", primitive.name()), "it needs an input VERTEX");
    return layout;
  }

  struct Range {
    std::size_t first = 0, count = 0;
  };

  Range read_positions(pugi::xml_node vertices) {
    const pugi::xml_node input = vertices.find_child_by_attribute("input", "semantic", "POSITION");
    if (!input) xml_.refuse_at(vertices, "<vertices> without positions", "it needs an input POSITION");
    const pugi::xml_node source = dae_target(xml_, elements_, input, "source", "source");
    const pugi::xml_node accessor = source.child("technique_common").child("accessor");
    if (!accessor) xml_.refuse_at(source, "a source of positions without an accessor", "it says how to read them");
    const std::vector<double> numbers = xml_.numbers(dae_target(xml_, elements_, accessor, "source", "float_array"));
    if (numbers.size() > numbers_left_)
      xml_.refuse_at(vertices, "too many <vertices> share their positions",
                     "read one by one they are much larger than the file",
                     "export the file again, with one <vertices> for each mesh");
    numbers_left_ -= numbers.size();
    const std::size_t stride = size_attribute(accessor, "stride", 1), offset = size_attribute(accessor, "offset", 0);
    const std::size_t count = size_attribute(accessor, "count", 0);
    if (stride < 3) xml_.refuse_at(accessor, fmt::format("positions with stride {}", stride), "a position has three numbers");
    if (count > 0 &&
        (offset > numbers.size() || numbers.size() - offset < 3 || (numbers.size() - offset - 3) / stride < count - 1))
      xml_.refuse_at(accessor, fmt::format("{} positions", count), fmt::format("its array has {} numbers", numbers.size()));
    const Range range{geometry_.positions.size(), count};
    for (std::size_t i = 0; i < count; ++i) {
      const double* position = &numbers[offset + i * stride];
      geometry_.positions.emplace_back(position[0], position[1], position[2]);
    }
    return range;
  }

  void read_primitive(pugi::xml_node primitive, std::string_view kind) {
    const Layout layout = layout_of(primitive);
    geometry_.parts.push_back({primitive.attribute("material").value(), {}, {}});
    if (primitive.child("ph")) xml_.refuse_at(primitive, "a polygon with holes", "it is not supported", "triangulate it");
    std::vector<std::int64_t> sizes;
    if (kind == "polylist") sizes = xml_.integers(primitive.child("vcount"));
    for (const pugi::xml_node list : primitive.children("p")) {
      const std::vector<std::uint32_t> corners = corners_of(list, layout);
      if (kind == "polygons")
        add_polygon(list, corners);
      else if (kind == "polylist")
        add_polylist(list, corners, sizes);
      else if (kind == "triangles")
        add_triangles(list, corners);
      else
        add_strip(list, corners, kind == "tristrips");
    }
  }

  std::vector<std::uint32_t> corners_of(pugi::xml_node list, const Layout& layout) const {
    const std::vector<std::int64_t> numbers = xml_.integers(list);
    if (numbers.size() % layout.stride != 0)
      xml_.refuse_at(list, fmt::format("{} numbers", numbers.size()), fmt::format("every corner has {}", layout.stride));
    std::vector<std::uint32_t> corners;
    for (std::size_t i = layout.offset; i < numbers.size(); i += layout.stride) {
      if (numbers[i] < 0 || numbers[i] >= static_cast<std::int64_t>(layout.count))
        xml_.refuse_at(list, fmt::format("corner {}", numbers[i]),
                       fmt::format("must be a vertex number below {}", layout.count));
      corners.push_back(static_cast<std::uint32_t>(layout.first + static_cast<std::size_t>(numbers[i])));
    }
    return corners;
  }

  void add_polygon(pugi::xml_node list, std::span<const std::uint32_t> corners) {
    if (corners.size() < 3) xml_.refuse_at(list, fmt::format("a polygon of {} corners", corners.size()), "it needs at least 3");
    DaePolygons& part = geometry_.parts.back();
    part.corners.insert(part.corners.end(), corners.begin(), corners.end());
    part.sizes.push_back(corners.size());
  }

  void add_polylist(pugi::xml_node list, std::span<const std::uint32_t> corners, std::span<const std::int64_t> sizes) {
    for (const std::int64_t size : sizes) {
      if (size < 0 || size > static_cast<std::int64_t>(corners.size()))
        xml_.refuse_at(list, fmt::format("a polygon of {} corners", size), fmt::format("only {} are left", corners.size()));
      add_polygon(list, corners.first(static_cast<std::size_t>(size)));
      corners = corners.subspan(static_cast<std::size_t>(size));
    }
    if (!corners.empty()) xml_.refuse_at(list, fmt::format("{} corners too many", corners.size()), "vcount asks for fewer");
  }

  void add_triangles(pugi::xml_node list, std::span<const std::uint32_t> corners) {
    if (corners.size() % 3 != 0) xml_.refuse_at(list, fmt::format("{} corners", corners.size()), "a triangle has three");
    for (; !corners.empty(); corners = corners.subspan(3)) add_polygon(list, corners.first(3));
  }

  // In a strip, every other triangle is reversed, so that all face the same way.
  void add_strip(pugi::xml_node list, std::span<const std::uint32_t> corners, bool is_strip) {
    for (std::size_t i = 0; i + 2 < corners.size(); ++i) {
      const std::uint32_t fan[] = {corners[0], corners[i + 1], corners[i + 2]};
      const std::uint32_t strip[] = {corners[i], corners[i + 1 + i % 2], corners[i + 2 - i % 2]};
      add_polygon(list, is_strip ? strip : fan);
    }
  }

  const XmlFile& xml_;
  const DaeElements& elements_;
  std::size_t& numbers_left_;
  DaeGeometry geometry_;
  std::unordered_map<std::string_view, Range> positions_;  // of <vertices>, by id
};

}  // namespace

pugi::xml_node dae_target(const XmlFile& xml, const DaeElements& elements, pugi::xml_node from, std::string_view attribute,
                          std::string_view name) {
  const std::string_view reference = from.attribute(std::string(attribute).c_str()).value();
  const auto refuse = [&](std::string_view why) {
    xml.refuse_at(from, fmt::format("<{}> refers to {}", from.name(), in_quotes(reference)), why);
  };
  if (!reference.starts_with('#')) refuse("only elements of the same file can be read");
  const auto found = elements.find(reference.substr(1));
  if (found == elements.end() || found->second.name() != name) refuse(fmt::format("there is no <{}> of that id", name));
  return found->second;
}

DaeGeometry read_dae_geometry(const XmlFile& xml, const DaeElements& elements, pugi::xml_node geometry,
                              std::size_t& numbers_left) {
  return DaeGeometryReader(xml, elements, numbers_left).read(geometry.child("mesh"));
}

}  // namespace sunfleck
