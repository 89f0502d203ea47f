#include "files/formats/mesh/ply_reader.h"

#include "base/text_reader.h"
#include "files/formats/mesh/mesh_builder.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

namespace sunfleck {

namespace {

static_assert(std::endian::native == std::endian::little, "binary PLY numbers are read as stored in memory");

enum class PlyEncoding { ascii, little_endian, big_endian };

enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

struct PlyProperty {
  std::string_view name;
  PlyType type = PlyType::float32;   // type of the value, or of a list's entries
  std::optional<PlyType> list_size;  // set for a list
};

struct PlyElement {
  std::string_view name;
  std::size_t count = 0;
  std::vector<PlyProperty> properties;
};

struct PlyHeader {
  PlyEncoding encoding = PlyEncoding::ascii;
  std::vector<PlyElement> elements;
  std::string_view body;
  std::size_t lines = 0;  // lines of the header
};

std::optional<PlyType> type_named(std::string_view name) {
  struct Names {
    std::string_view old_name, new_name;
    PlyType type;
  };
  static constexpr Names names[] = {{"char", "int8", PlyType::int8},        {"uchar", "uint8", PlyType::uint8},
                                    {"short", "int16", PlyType::int16},     {"ushort", "uint16", PlyType::uint16},
                                    {"int", "int32", PlyType::int32},       {"uint", "uint32", PlyType::uint32},
                                    {"float", "float32", PlyType::float32}, {"double", "float64", PlyType::float64}};
  for (const Names& known : names)
    if (name == known.old_name || name == known.new_name) return known.type;
  return std::nullopt;
}

std::size_t size_of(PlyType type) {
  constexpr std::array<std::size_t, 8> sizes{1, 1, 2, 2, 4, 4, 4, 8};
  return sizes[static_cast<std::size_t>(type)];
}

class PlyHeaderReader {
 public:
  explicit PlyHeaderReader(const MeshSource& source) : source_(source), lines_(source.bytes) {}

  PlyHeader read() {
    if (!lines_.next() || trimmed(lines_.line()) != "ply")
      refuse(source_, 1, "does not begin with ply", "every PLY file must", "export the file again");
    bool has_format = false;
    while (lines_.next()) {
      std::string_view rest = lines_.line();
      const std::string_view key = next_word(rest);
      if (key == "end_header") {
        if (!has_format) bad_line("the format line is missing");
        header_.body = lines_.rest();
        header_.lines = lines_.number();
        return std::move(header_);
      }
      if (key == "format") {
        read_format(rest);
        has_format = true;
      } else if (key == "element") {
        read_element(rest);
      } else if (key == "property") {
        read_property(rest);
      } else if (!key.empty() && key != "comment" && key != "obj_info") {
        bad_line("not a word of a PLY header");
      }
    }
    refuse(source_, lines_.number(), "the header does not end", "end_header is missing", "export the file again");
  }

 private:
  [[noreturn]] void bad_line(std::string_view why) {
    refuse(source_, lines_.number(), fmt::format("header line {}", in_quotes(lines_.line())), why, "export the file again");
  }

  void read_format(std::string_view rest) {
    const std::string_view name = next_word(rest);
    if (name == "ascii")
      header_.encoding = PlyEncoding::ascii;
    else if (name == "binary_little_endian")
      header_.encoding = PlyEncoding::little_endian;
    else if (name == "binary_big_endian")
      header_.encoding = PlyEncoding::big_endian;
    else
      bad_line("must be ascii, binary_little_endian or binary_big_endian");
    if (next_word(rest) != "1.0") bad_line("the version must be 1.0");
  }

  void read_element(std::string_view rest) {
    PlyElement element;
    element.name = next_word(rest);
    const std::optional<std::int64_t> count = parse_integer(next_word(rest));
    if (element.name.empty() || !count || *count < 0) bad_line("must be element NAME COUNT");
    element.count = static_cast<std::size_t>(*count);
    header_.elements.push_back(std::move(element));
  }

  void read_property(std::string_view rest) {
    if (header_.elements.empty()) bad_line("a property must follow an element");
    PlyProperty property;
    std::string_view type = next_word(rest);
    if (type == "list") {
      property.list_size = type_named(next_word(rest));
      if (!property.list_size || *property.list_size >= PlyType::float32) bad_line("the size of a list needs an integer type");
      type = next_word(rest);
    }
    const std::optional<PlyType> known = type_named(type);
    property.name = next_word(rest);
    if (!known || property.name.empty()) bad_line("must be property TYPE NAME or property list TYPE TYPE NAME");
    property.type = *known;
    header_.elements.back().properties.push_back(property);
  }

  const MeshSource& source_;
  LineReader lines_;
  PlyHeader header_;
};

// The numbers of the body in order, in any encoding. In a text file, numbers may be spread over lines freely.
class PlyBody {
 public:
  PlyBody(const MeshSource& source, const PlyHeader& header)
      : source_(source), encoding_(header.encoding), header_lines_(header.lines), lines_(header.body), rest_(header.body) {
    if (encoding_ == PlyEncoding::ascii) rest_ = {};
  }

  double next(PlyType type) { return encoding_ == PlyEncoding::ascii ? next_text() : next_binary(type); }

  // Returns the line of the last number; 0 in binary files.
  [[nodiscard]] std::size_t line() const { return encoding_ == PlyEncoding::ascii ? header_lines_ + lines_.number() : 0; }

  // Returns an upper bound for the numbers left: each takes a byte and, in a text file, a blank.
  [[nodiscard]] std::size_t bytes_left() const { return rest_.size() + lines_.rest().size(); }

 private:
  [[noreturn]] void refuse_end() const {
    refuse(source_, line(), "the file ends too early", "the header announces more numbers", "export the file again");
  }

  double next_text() {
    std::string_view word = next_word(rest_);
    while (word.empty()) {
      if (!lines_.next()) refuse_end();
      rest_ = lines_.line();
      word = next_word(rest_);
    }
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

class PlyReader {
 public:
  explicit PlyReader(const MeshSource& source)
      : source_(source), header_(PlyHeaderReader(source).read()), body_(source, header_), builder_(source) {}

  Mesh read() {
    for (const PlyElement& element : header_.elements) check_element(element);
    builder_.reserve_vertices(vertices_);
    for (const PlyElement& element : header_.elements) {
      if (element.properties.empty()) continue;
      for (std::size_t i = 0; i < element.count; ++i) {
        if (element.name == "vertex")
          read_vertex(element, i);
        else
          read_lists(element);
      }
    }
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

  void read_vertex(const PlyElement& element, std::size_t number) {
    glm::dvec3 position(0.0);
    for (const PlyProperty& property : element.properties) {
      if (property.list_size) {
        skip_list(property);
        continue;
      }
      const double value = body_.next(property.type);
      if (property.name.size() != 1 || property.name[0] < 'x' || property.name[0] > 'z') continue;
      if (!std::isfinite(value))
        refuse(source_, body_.line(), fmt::format("vertex {}: {} = {}", number, property.name, value), "not a finite number",
               "export the file again");
      position[property.name[0] - 'x'] = value;
    }
    static_cast<void>(builder_.add_vertex(position));
  }

  void read_lists(const PlyElement& element) {
    for (const PlyProperty& property : element.properties) {
      if (!property.list_size)
        static_cast<void>(body_.next(property.type));
      else if (element.name == "face" && (property.name == "vertex_indices" || property.name == "vertex_index"))
        read_polygon(property);
      else
        skip_list(property);
    }
  }

  std::size_t list_size(const PlyProperty& property) {
    const double size = body_.next(*property.list_size);
    if (!(size >= 0.0 && size <= static_cast<double>(body_.bytes_left())) || size != std::floor(size))
      refuse(source_, body_.line(), fmt::format("a list of {} numbers", size), "the file ends before the end of the list",
             "export the file again");
    return static_cast<std::size_t>(size);
  }

  void skip_list(const PlyProperty& property) {
    for (std::size_t left = list_size(property); left > 0; --left) static_cast<void>(body_.next(property.type));
  }

  void read_polygon(const PlyProperty& property) {
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
    const std::uint32_t optics = builder_.default_optics(body_.line());
    builder_.add_polygon(corners_, optics, builder_.default_organ(optics));
  }

  const MeshSource& source_;
  PlyHeader header_;
  PlyBody body_;
  MeshBuilder builder_;
  std::size_t vertices_ = 0;        // vertices in the whole file
  std::size_t promised_bytes_ = 0;  // fewest bytes that the header has announced so far
  std::vector<std::uint32_t> corners_;
};

}  // namespace

Mesh read_ply(const MeshSource& source) {
  return PlyReader(source).read();
}

}  // namespace sunfleck
