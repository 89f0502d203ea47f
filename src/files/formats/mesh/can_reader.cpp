#include "files/formats/mesh/can_reader.h"

#include "base/text_reader.h"
#include "files/formats/mesh/inflate_gzip.h"
#include "files/formats/mesh/mesh_builder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sunfleck {

namespace {

constexpr std::size_t most_text_bytes = std::size_t{4} << 30;  // about 40 million polygons
// Gzip shrinks polygons as text to a third or a tenth. Content that grows by more than most_growth, beyond a harmless size, is
// not such text.
constexpr std::size_t most_growth = 100;
constexpr std::size_t harmless_bytes = std::size_t{256} << 20;
constexpr std::size_t most_corners = 1000;

// The digits O PPPPP LLL EEE of a label.
struct CanLabel {
  std::uint64_t number = 0;
  std::uint32_t species = 0;  // 0 is soil
  std::uint32_t plant = 0;
  int leaf = 0;  // 0 is the stem
};

CanLabel parse_label(const MeshSource& source, std::size_t line, std::string_view word) {
  const std::optional<std::int64_t> digits = parse_integer(word);
  if (!digits || *digits < 0 || word.size() > 12 || word.find_first_not_of("0123456789") != word.npos)
    refuse(source, line, fmt::format("label {}", in_quotes(word)), "must be at most 12 digits, O PPPPP LLL EEE",
           "write species, plant, leaf and element number as one number");
  return {static_cast<std::uint64_t>(*digits), static_cast<std::uint32_t>(*digits / 100'000'000'000),
          static_cast<std::uint32_t>(*digits / 1'000'000 % 100'000), static_cast<int>(*digits / 1000 % 1000)};
}

Organ organ_of(const CanLabel& label) {
  if (label.species == 0) return {0, "soil", 0};
  std::string name = label.leaf == 0 ? "stem" : "leaf";
  if (label.species > 1) name += fmt::to_string(label.species);
  return {label.plant, name, label.leaf};
}

std::int64_t count_word(const MeshSource& source, std::size_t line, std::string_view& rest, std::string_view what,
                        std::int64_t least) {
  const std::string_view word = next_word(rest);
  const std::optional<std::int64_t> count = parse_integer(word);
  if (!count || *count < least || *count > static_cast<std::int64_t>(most_corners))
    refuse(source, line, fmt::format("{} {}", what, in_quotes(word)),
           fmt::format("must be a whole number in {}..{}", least, most_corners),
           "write: p 1 LABEL 3 x1 y1 z1 x2 y2 z2 x3 y3 z3");
  return *count;
}

class CanReader {
 public:
  explicit CanReader(const MeshSource& source) : source_(source), builder_(source) {}

  Mesh read(std::string_view text) {
    LineReader lines(text);
    while (lines.next()) {
      std::string_view rest = lines.line();
      const std::string_view key = next_word(rest);
      if (key.empty() || key.starts_with('#')) continue;
      if (key != "p")
        refuse(source_, lines.number(), fmt::format("line begins with {}", in_quotes(key)), "only polygons, p, are supported",
               "write: p 1 LABEL 3 x1 y1 z1 x2 y2 z2 x3 y3 z3");
      read_polygon(lines.number(), rest);
    }
    return builder_.take();
  }

 private:
  // Reads the words after `p`: the number of arguments, the arguments (the first one is the label), the number of corners, the
  // corners.
  void read_polygon(std::size_t line, std::string_view rest) {
    const std::int64_t arguments = count_word(source_, line, rest, "number of arguments", 1);
    const CanLabel label = parse_label(source_, line, next_word(rest));
    for (std::int64_t i = 1; i < arguments; ++i) static_cast<void>(next_word(rest));
    const std::int64_t corners = count_word(source_, line, rest, "number of corners", 3);
    corners_.clear();
    for (std::int64_t i = 0; i < corners; ++i) {
      glm::dvec3 position;
      for (int axis = 0; axis < 3; ++axis) position[axis] = coordinate(source_, line, rest);
      corners_.push_back(builder_.add_vertex(position));
    }
    if (const std::string_view more = next_word(rest); !more.empty() && !more.starts_with('#'))
      refuse(source_, line, fmt::format("{} after the last corner", in_quotes(more)),
             fmt::format("{} corners have {} coordinates", corners, 3 * corners), "correct the number of corners");
    const Organ organ = organ_of(label);
    builder_.add_polygon(corners_, builder_.optics(organ.name), builder_.organ(organ), label.number);
  }

  const MeshSource& source_;
  MeshBuilder builder_;
  std::vector<std::uint32_t> corners_;
};

}  // namespace

Mesh read_can(const MeshSource& source) {
  const bool named_gz = source.file.extension() == ".gz" || source.file.extension() == ".GZ";
  if (named_gz || source.bytes.starts_with("\x1f\x8b")) {
    const std::size_t limit = std::clamp(source.bytes.size(), harmless_bytes / most_growth, most_text_bytes / most_growth);
    return CanReader(source).read(inflate_gzip(source, limit * most_growth));
  }
  return CanReader(source).read(source.bytes);
}

}  // namespace sunfleck
