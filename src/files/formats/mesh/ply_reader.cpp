#include "files/formats/mesh/ply_reader.h"

#include "base/file.h"
#include "base/log.h"
#include "base/text_reader.h"
#include "files/formats/mesh/mesh_builder.h"
#include "files/formats/mesh/ply_colours.h"
#include "files/formats/mesh/ply_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sunfleck {

namespace {

static_assert(std::endian::native == std::endian::little, "binary PLY numbers are read as stored in memory");

std::size_t size_of(PlyType type) {
  constexpr std::array<std::size_t, 8> sizes{1, 1, 2, 2, 4, 4, 4, 8};
  return sizes[static_cast<std::size_t>(type)];
}

// Returns a component of a colour, given as a whole number in 0..255 or 0..65535 or as a fraction, in 0..255.
std::uint32_t colour_component(double value, PlyType type) {
  const bool is_fraction = type == PlyType::float32 || type == PlyType::float64;
  const double scaled = is_fraction ? 255.0 * value : type == PlyType::uint16 ? value / 257.0 : value;
  return std::isnan(scaled) ? 0U : static_cast<std::uint32_t>(std::lround(std::clamp(scaled, 0.0, 255.0)));
}

// The numbers of the body in order, in any encoding. In a text file, numbers may be spread over lines freely.
class PlyBody {
 public:
  PlyBody(const MeshSource& source, const PlyHeader& header)
      : source_(source), encoding_(header.encoding), header_lines_(header.lines), lines_(header.body), rest_(header.body) {
    if (encoding_ == PlyEncoding::ascii) rest_ = {};
  }

  double next(PlyType type) { return encoding_ == PlyEncoding::ascii ? next_text() : next_binary(type); }

  // Passes over a number, which may be anything in a text file: programs write nan where they know no value.
  void skip(PlyType type) {
    if (encoding_ == PlyEncoding::ascii)
      static_cast<void>(next_text_word());
    else
      static_cast<void>(next_binary(type));
  }

  // Returns the line of the last number; 0 in binary files.
  [[nodiscard]] std::size_t line() const { return encoding_ == PlyEncoding::ascii ? header_lines_ + lines_.number() : 0; }

  // Returns an upper bound for the numbers left: each takes a byte and, in a text file, a blank.
  [[nodiscard]] std::size_t bytes_left() const { return rest_.size() + lines_.rest().size(); }

 private:
  [[noreturn]] void refuse_end() const {
    refuse(source_, line(), "the file ends too early", "the header announces more numbers", "export the file again");
  }

  std::string_view next_text_word() {
    std::string_view word = next_word(rest_);
    while (word.empty()) {
      if (!lines_.next()) refuse_end();
      rest_ = lines_.line();
      word = next_word(rest_);
    }
    return word;
  }

  double next_text() {
    const std::string_view word = next_text_word();
    const std::optional<double> number = parse_number(word);
    if (!number) refuse(source_, line(), in_quotes(word), "not a finite number", "correct the number");
    return *number;
  }

  template <class T>
  static double value_of(const char* bytes) {
    T value;
    std::memcpy(&value, bytes, sizeof value);
    return static_cast<double>(value);
  }

  double next_binary(PlyType type) {
    std::array<char, 8> bytes{};
    const std::size_t size = size_of(type);
    if (rest_.size() < size) refuse_end();
    std::copy_n(rest_.begin(), size, bytes.begin());
    rest_.remove_prefix(size);
    if (encoding_ == PlyEncoding::big_endian) std::reverse(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
    switch (type) {
      case PlyType::int8:
        return value_of<std::int8_t>(bytes.data());
      case PlyType::uint8:
        return value_of<std::uint8_t>(bytes.data());
      case PlyType::int16:
        return value_of<std::int16_t>(bytes.data());
      case PlyType::uint16:
        return value_of<std::uint16_t>(bytes.data());
      case PlyType::int32:
        return value_of<std::int32_t>(bytes.data());
      case PlyType::uint32:
        return value_of<std::uint32_t>(bytes.data());
      case PlyType::float32:
        return value_of<float>(bytes.data());
      case PlyType::float64:
        break;
    }
    return value_of<double>(bytes.data());
  }

  const MeshSource& source_;
  PlyEncoding encoding_;
  std::size_t header_lines_;
  LineReader lines_;
  std::string_view rest_;
};

// The numbers of a vertex or a face that say which organ it belongs to.
struct PlyNames {
  static constexpr std::uint32_t no_name = std::numeric_limits<std::uint32_t>::max();

  std::uint32_t colour = 0;  // red, green, blue in 8 bits each
  std::uint32_t organ = no_name, optics = no_name;

  void read(const PlyProperty& property, double value) {
    if (property.use == PlyUse::organ) organ = whole(value);
    if (property.use == PlyUse::optics) optics = whole(value);
    if (property.use == PlyUse::red) colour |= colour_component(value, property.type) << 16U;
    if (property.use == PlyUse::green) colour |= colour_component(value, property.type) << 8U;
    if (property.use == PlyUse::blue) colour |= colour_component(value, property.type);
  }

 private:
  static std::uint32_t whole(double value) {
    return value >= 0.0 && value < no_name ? static_cast<std::uint32_t>(value) : no_name;
  }
};

class PlyReader {
 public:
  explicit PlyReader(const MeshSource& source)
      : source_(source), header_(read_ply_header(source)), body_(source, header_), builder_(source) {}

  Mesh read() {
    for (const PlyElement& element : header_.elements) check_element(element);
    expect_faces();
    builder_.reserve_vertices(vertices_);
    for (const auto& [number, name] : header_.organs) objects_.emplace(number, builder_.add_object(name));
    takes_colours_ = header_.organs.empty() && header_.optics.empty() &&
                     std::any_of(header_.elements.begin(), header_.elements.end(),
                                 [](const PlyElement& element) { return element.has_colour(); });
    for (const PlyElement& element : header_.elements) {
      if (element.properties.empty()) continue;
      const bool coloured = element.has_colour();
      for (std::size_t i = 0; i < element.count; ++i) {
        if (element.name == "vertex")
          read_vertex(element, i, coloured);
        else
          read_face(element, coloured);
      }
    }
    if (takes_colours_) name_by_colour();
    return builder_.take();
  }

 private:
  // Refuses counts that exceed the bytes present, before allocating memory for them.
  void check_element(const PlyElement& element) {
    std::size_t each = 0;
    for (const PlyProperty& property : element.properties) each += least_bytes(property);
    if (each > 0 && element.count > (body_.bytes_left() - promised_bytes_) / each)
      refuse(source_, 0, fmt::format("element {} {}", in_quotes(element.name), element.count),
             fmt::format("only {} bytes follow", body_.bytes_left() - promised_bytes_), "export the file again");
    promised_bytes_ += each * element.count;
    if (element.name != "vertex") return;
    check_vertex(element);
    vertices_ += element.count;
  }

  // Refuses a file whose surfaces are lists of another name, or strips.
  void expect_faces() const {
    for (const PlyElement& element : header_.elements) {
      if (element.has(PlyUse::corners)) return;
    }
    for (const PlyElement& element : header_.elements) {
      for (const PlyProperty& property : element.properties) {
        if (!property.list_size || element.count == 0) continue;
        refuse(source_, 0, "no faces found",
               fmt::format("element {} has the list {}; faces have vertex_indices or vertex_index", in_quotes(element.name),
                           in_quotes(property.name)),
               "rename it in the header, or export faces of triangles");
      }
    }
  }

  // Returns the fewest bytes that a property can take. A list may be empty; in a text file, a blank follows every number but
  // the last.
  [[nodiscard]] std::size_t least_bytes(const PlyProperty& property) const {
    return header_.encoding == PlyEncoding::ascii ? 1 : size_of(property.list_size.value_or(property.type));
  }

  void check_vertex(const PlyElement& element) {
    for (const std::string_view axis : {"x", "y", "z"})
      if (std::none_of(element.properties.begin(), element.properties.end(),
                       [&](const PlyProperty& p) { return p.name == axis && !p.list_size; }))
        refuse(source_, 0, fmt::format("vertices without {}", axis), "every vertex needs x, y and z", "export the file again");
  }

  void read_vertex(const PlyElement& element, std::size_t number, bool coloured) {
    glm::dvec3 position(0.0);
    PlyNames names;
    for (const PlyProperty& property : element.properties) {
      if (property.list_size || property.use == PlyUse::none) {
        skip(property);
        continue;
      }
      const double value = body_.next(property.type);
      names.read(property, value);
      if (property.use < PlyUse::x || property.use > PlyUse::z) continue;
      if (!std::isfinite(value))
        refuse(source_, body_.line(), fmt::format("vertex {}: {} = {}", number, property.name, value), "not a finite number",
               "export the file again");
      position[static_cast<int>(property.use) - static_cast<int>(PlyUse::x)] = value;
    }
    static_cast<void>(builder_.add_vertex(position));
    if (coloured) colours_.add_vertex(names.colour);
  }

  void read_face(const PlyElement& element, bool coloured) {
    PlyNames names;
    corners_.clear();
    for (const PlyProperty& property : element.properties) {
      if (property.use == PlyUse::corners)
        read_corners(property);
      else if (property.list_size || property.use == PlyUse::none)
        skip(property);
      else
        names.read(property, body_.next(property.type));
    }
    if (corners_.empty()) return;
    if (takes_colours_) {
      builder_.add_polygon(corners_, 0, 0);  // until all colours are known
      colours_.add_face(corners_, coloured ? std::optional(names.colour) : std::nullopt);
      if (first_face_line_ == 0) first_face_line_ = body_.line();
      return;
    }
    const auto material = header_.optics.find(names.optics);
    const std::uint32_t optics =
        material == header_.optics.end() ? builder_.default_optics(body_.line()) : builder_.optics(material->second);
    const auto object = objects_.find(names.organ);
    builder_.add_polygon(
        corners_, optics,
        object == objects_.end() ? builder_.default_organ(optics) : builder_.object_organ(object->second, optics));
  }

  // Gives the triangles the names of their colours, or the default names if the colours name nothing.
  void name_by_colour() {
    const std::vector<std::string> names = colours_.names();
    if (colours_.mixed_faces() > 0)
      warn(
          printable(fmt::format("{}: its vertex colours name no organs (corners of different colours in {} of its faces); "
                                "give every face one colour, or add split = \"parts\" to the scene's [[geometry]]",
                                source_.file.string(), colours_.mixed_faces())));
    if (names.empty() && builder_.triangle_count() == 0) return;
    if (names.empty()) {
      const std::uint32_t optics = builder_.default_optics(first_face_line_);
      const std::uint32_t organ = builder_.default_organ(optics);
      for (std::size_t t = 0; t < builder_.triangle_count(); ++t) builder_.set_surface(t, optics, organ);
      return;
    }
    std::vector<std::pair<std::uint32_t, std::uint32_t>> surfaces;  // [colour]
    for (const std::string& name : names) {
      const std::uint32_t optics = builder_.optics(source_.keeps_colours ? name : source_.optics.value_or(name));
      surfaces.emplace_back(optics, builder_.organ({1, name, 0}));
    }
    for (std::size_t t = 0; t < builder_.triangle_count(); ++t) {
      const auto [optics, organ] = surfaces[colours_.of_triangle()[t]];
      builder_.set_surface(t, optics, organ);
    }
  }

  std::size_t list_size(const PlyProperty& property) {
    const double size = body_.next(*property.list_size);
    if (!(size >= 0.0 && size <= static_cast<double>(body_.bytes_left())) || size != std::floor(size))
      refuse(source_, body_.line(), fmt::format("a list of {} numbers", size),
             fmt::format("their number must be a whole one, and only {} bytes are left", body_.bytes_left()),
             "export the file again");
    return static_cast<std::size_t>(size);
  }

  void skip(const PlyProperty& property) {
    for (std::size_t left = property.list_size ? list_size(property) : 1; left > 0; --left) body_.skip(property.type);
  }

  void read_corners(const PlyProperty& property) {
    const std::size_t size = list_size(property);
    if (size < 3)
      refuse(source_, body_.line(), fmt::format("a face of {} corners", size), "a face needs at least 3",
             "remove or complete it");
    corners_.clear();
    for (std::size_t i = 0; i < size; ++i) {
      const double corner = body_.next(property.type);
      if (!(corner >= 0.0 && corner < static_cast<double>(vertices_)) || corner != std::floor(corner))
        refuse(source_, body_.line(), fmt::format("corner {}", corner),
               fmt::format("must be a vertex number below {}", vertices_), "export the file again");
      corners_.push_back(static_cast<std::uint32_t>(corner));
    }
  }

  const MeshSource& source_;
  PlyHeader header_;
  PlyBody body_;
  MeshBuilder builder_;
  PlyColours colours_;
  bool takes_colours_ = false;
  std::size_t first_face_line_ = 0;
  std::map<std::uint32_t, std::uint32_t> objects_;  // the builder's objects, by organ number of the header
  std::size_t vertices_ = 0;                        // vertices in the whole file
  std::size_t promised_bytes_ = 0;                  // fewest bytes that the header has announced so far
  std::vector<std::uint32_t> corners_;
};

}  // namespace

Mesh read_ply(const MeshSource& source) {
  return PlyReader(source).read();
}

}  // namespace sunfleck
