#include "files/formats/mesh/stl_reader.h"

#include "base/text.h"
#include "base/text_reader.h"
#include "files/formats/mesh/mesh_builder.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

namespace sunfleck {

namespace {

static_assert(std::endian::native == std::endian::little, "binary STL numbers are read as stored in memory");

constexpr std::size_t header_bytes = 84;  // 80 bytes of comment, then the number of triangles
constexpr std::size_t facet_bytes = 50;   // normal, three corners, 2 bytes of attributes

std::uint32_t swapped(std::uint32_t word) {
  return word >> 24U | (word >> 8U & 0xFF00U) | (word << 8U & 0xFF0000U) | word << 24U;
}

std::uint32_t declared_facets(std::string_view bytes) {
  std::uint32_t count = 0;
  std::memcpy(&count, bytes.data() + header_bytes - sizeof count, sizeof count);
  return count;
}

// Compares the size, because binary files may begin with `solid` too. A text file cannot match: bytes 80..83, read as a number,
// would require more than 6 GB.
bool has_facets(std::string_view bytes, std::uint32_t count) {
  return bytes.size() == header_bytes + facet_bytes * std::size_t{count};
}

bool is_binary_stl(std::string_view bytes) {
  return bytes.size() >= header_bytes && has_facets(bytes, declared_facets(bytes));
}

class StlReader {
 public:
  explicit StlReader(const MeshSource& source) : source_(source), builder_(source) {}

  Mesh read_binary() {
    const std::uint32_t count = declared_facets(source_.bytes);
    if (count == 0) return {};
    const std::uint32_t optics = builder_.default_optics(0);
    const std::uint32_t organ = builder_.default_organ(optics);
    builder_.reserve_vertices(3 * std::size_t{count});
    for (std::uint32_t facet = 0; facet < count; ++facet) {
      std::array<float, 12> numbers{};
      std::memcpy(numbers.data(), source_.bytes.data() + header_bytes + facet_bytes * facet, sizeof numbers);
      corners_.clear();
      for (std::size_t i = 3; i < numbers.size(); i += 3) {
        const glm::dvec3 corner(numbers[i], numbers[i + 1], numbers[i + 2]);
        if (!std::isfinite(corner.x + corner.y + corner.z))
          refuse(source_, 0, fmt::format("triangle {}: a coordinate is not finite", facet + 1), "it is infinite or nan",
                 "export the file again");
        corners_.push_back(builder_.add_vertex(corner));
      }
      builder_.add_polygon(corners_, optics, organ);
    }
    return builder_.take();
  }

  Mesh read_text() {
    LineReader lines(source_.bytes);
    while (lines.next()) {
      std::string_view rest = lines.line();
      const std::string key = lower_case(next_word(rest));
      if (!key.empty()) read_line(lines.number(), key, rest);
    }
    if (state_ != State::outside)
      refuse(source_, lines.number(), "the file ends inside a solid", "endsolid is missing", "export the file again");
    return builder_.take();
  }

 private:
  enum class State { outside, solid, facet, loop, closed };

  // Reads one line of the grammar: solid { facet { outer loop { vertex vertex vertex } endloop } endfacet } endsolid
  void read_line(std::size_t line, std::string_view key, std::string_view rest) {
    if (key == "vertex" && state_ == State::loop) {
      glm::dvec3 corner;
      for (int axis = 0; axis < 3; ++axis) corner[axis] = coordinate(source_, line, rest);
      corners_.push_back(builder_.add_vertex(corner));
      return;
    }
    struct Step {
      std::string_view key;
      State from, to;
    };
    static constexpr Step steps[] = {{"solid", State::outside, State::solid},   {"facet", State::solid, State::facet},
                                     {"outer", State::facet, State::loop},      {"endloop", State::loop, State::closed},
                                     {"endfacet", State::closed, State::solid}, {"endsolid", State::solid, State::outside}};
    const auto* step =
        std::find_if(std::begin(steps), std::end(steps), [&](const Step& s) { return s.key == key && s.from == state_; });
    if (step == std::end(steps))
      refuse(source_, line, in_quotes(key), "not expected here in an STL file", "export the file again");
    state_ = step->to;
    if (key == "solid") solid_ = builder_.add_object(trimmed(rest));
    if (key == "endloop") end_loop(line);
  }

  void end_loop(std::size_t line) {
    if (corners_.size() != 3)
      refuse(source_, line, fmt::format("a facet of {} corners", corners_.size()), "an STL facet has 3",
             "export the file again");
    const std::uint32_t optics = builder_.default_optics(line);
    builder_.add_polygon(corners_, optics, builder_.object_organ(solid_, optics));
    corners_.clear();
  }

  const MeshSource& source_;
  MeshBuilder builder_;
  State state_ = State::outside;
  std::uint32_t solid_ = 0;  // the builder's object
  std::vector<std::uint32_t> corners_;
};

}  // namespace

Mesh read_stl(const MeshSource& source) {
  StlReader reader(source);
  if (is_binary_stl(source.bytes)) return reader.read_binary();
  LineReader lines(source.bytes);
  while (lines.next())
    if (std::string_view rest = lines.line(); !trimmed(rest).empty()) {
      if (lower_case(next_word(rest)) == "solid" && source.bytes.find('\0') == source.bytes.npos) return reader.read_text();
      break;
    }
  const std::size_t size = source.bytes.size();
  if (size < header_bytes)
    refuse(source, 0, fmt::format("only {} bytes", size), "a binary STL file has at least 84, a text file begins with solid",
           "export the file again");
  const std::uint32_t count = declared_facets(source.bytes);
  if (has_facets(source.bytes, swapped(count)))
    refuse(source, 0, fmt::format("its numbers are big-endian: {} triangles", swapped(count)), "an STL file is little-endian",
           "save it with little-endian numbers");
  refuse(source, 0, fmt::format("{} bytes", size),
         fmt::format("a binary STL file of {} triangles has {}", count, header_bytes + facet_bytes * std::size_t{count}),
         "export the file again");
}

}  // namespace sunfleck
