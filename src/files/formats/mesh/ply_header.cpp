#include "files/formats/mesh/ply_header.h"

#include "base/text_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

namespace sunfleck {

namespace {

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

PlyUse use_of(std::string_view element, const PlyProperty& property) {
  const bool is_vertex = element == "vertex";
  const bool is_face = element == "face";
  struct Name {
    std::string_view name;
    PlyUse use;
    bool known;
  };
  const bool is_list = property.list_size.has_value();
  const bool has_colour = (is_vertex || is_face) && !is_list;
  const Name names[] = {{"x", PlyUse::x, is_vertex && !is_list},
                        {"y", PlyUse::y, is_vertex && !is_list},
                        {"z", PlyUse::z, is_vertex && !is_list},
                        {"red", PlyUse::red, has_colour},
                        {"green", PlyUse::green, has_colour},
                        {"blue", PlyUse::blue, has_colour},
                        {"diffuse_red", PlyUse::red, has_colour},
                        {"diffuse_green", PlyUse::green, has_colour},
                        {"diffuse_blue", PlyUse::blue, has_colour},
                        {"vertex_indices", PlyUse::corners, is_face && is_list},
                        {"vertex_index", PlyUse::corners, is_face && is_list},
                        {"organ", PlyUse::organ, is_face && !is_list},
                        {"optics", PlyUse::optics, is_face && !is_list}};
  for (const Name& known : names)
    if (known.known && known.name == property.name) return known.use;
  return PlyUse::none;
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
      } else if (key == "comment") {
        read_comment(rest);
      } else if (!key.empty() && key != "obj_info") {
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

  // Reads the names that sunfleck writes; other comments are for people.
  void read_comment(std::string_view rest) {
    const std::string_view kind = next_word(rest);
    const std::optional<std::int64_t> number = parse_integer(next_word(rest));
    const std::string_view name = trimmed(rest);
    if (!number || *number < 0 || *number > std::numeric_limits<std::uint32_t>::max() || name.empty()) return;
    if (kind == "organ") header_.organs.emplace(static_cast<std::uint32_t>(*number), name);
    if (kind == "optics") header_.optics.emplace(static_cast<std::uint32_t>(*number), name);
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
    property.use = use_of(header_.elements.back().name, property);
    header_.elements.back().properties.push_back(property);
  }

  const MeshSource& source_;
  LineReader lines_;
  PlyHeader header_;
};

}  // namespace

bool PlyElement::has(PlyUse use) const {
  return std::any_of(properties.begin(), properties.end(), [&](const PlyProperty& property) { return property.use == use; });
}

bool PlyElement::has_colour() const {
  return has(PlyUse::red) && has(PlyUse::green) && has(PlyUse::blue);
}

PlyHeader read_ply_header(const MeshSource& source) {
  return PlyHeaderReader(source).read();
}

}  // namespace sunfleck
