#pragma once
// Declarations shared by the mesh readers: the file to read, the mesh to build, and functions for lines, numbers and messages.

#include "canopy/mesh.h"
#include "io/source_files.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <tuple>

namespace sunfleck {

struct MeshSource {
  std::filesystem::path file;
  std::string_view bytes;             // not empty
  std::optional<std::string> optics;  // for triangles whose file names no material
  bool allow_outside = false;         // true if the buffers of a glTF file may lie outside its folder
  SourceFiles* files = nullptr;       // collects the buffers of a glTF file
};

// There is one reader per format. Coordinates are returned as in the file, neither turned nor scaled; a mesh may be empty.
[[nodiscard]] Mesh read_can(const MeshSource& source);
[[nodiscard]] Mesh read_gltf(const MeshSource& source);  // also reads GLB
[[nodiscard]] Mesh read_obj(const MeshSource& source);
[[nodiscard]] Mesh read_ply(const MeshSource& source);
[[nodiscard]] Mesh read_stl(const MeshSource& source);

// Returns the content of a gzip file. Refuses content of more than `limit` bytes before allocating memory for it.
[[nodiscard]] std::string inflate_gzip(const MeshSource& source, std::size_t limit);

// Throws Error (input) `FILE:LINE: what (why); cure`. Line 0 leaves the line out.
[[noreturn]] void refuse(const MeshSource& source, std::size_t line, std::string_view what, std::string_view why,
                         std::string_view cure);

// Returns a piece of the file for a message: in quotes, on one line, cut after 40 bytes.
[[nodiscard]] std::string in_quotes(std::string_view text);

// Parses the name of an organ: `plant1_leaf7` is plant 1, leaf, rank 7; `plant1_leaf2_7` is leaf2, rank 7; `plant2_stem` has
// rank 0. Ignores a suffix like `.001`, which editors add to make names unique. Returns nothing for any other name.
[[nodiscard]] std::optional<Organ> organ_from_name(std::string_view name);

// Iterates over lines ended by \n, \r\n or \r, numbered from 1.
class LineReader {
 public:
  explicit LineReader(std::string_view text) : rest_(text) {}
  bool next();  // returns false at the end
  [[nodiscard]] std::string_view line() const { return line_; }
  [[nodiscard]] std::size_t number() const { return number_; }
  [[nodiscard]] std::string_view rest() const { return rest_; }

 private:
  std::string_view rest_, line_;
  std::size_t number_ = 0;
};

// Removes the next blank-separated word from `rest` and returns it; empty at the end.
[[nodiscard]] std::string_view next_word(std::string_view& rest);
[[nodiscard]] std::string_view trimmed(std::string_view text);

// Returns the cell of a table trimmed and without enclosing double quotes.
[[nodiscard]] std::string_view unquoted(std::string_view cell);

// Parse a finite number or an integer; return nothing unless the whole word is one.
[[nodiscard]] std::optional<double> parse_number(std::string_view word);
[[nodiscard]] std::optional<std::int64_t> parse_integer(std::string_view word);

// Removes the next word from `rest` and returns it as a coordinate; refuses a missing, unreadable or infinite one.
[[nodiscard]] double coordinate(const MeshSource& source, std::size_t line, std::string_view& rest);

// Builds a mesh in the order of the file, with one entry for each optics name and each organ.
class MeshBuilder {
 public:
  explicit MeshBuilder(const MeshSource& source) : source_(source) {}

  // Refuses `count` more vertices if there would be over 2^28 of them. Triangles have the same limit.
  void reserve_vertices(std::size_t count);
  std::uint32_t add_vertex(const glm::dvec3& position);
  [[nodiscard]] std::size_t vertex_count() const { return mesh_.vertices.size(); }

  // Returns the index of an optics name. Names end up in tables and in files for other programs, so a new one must be a single
  // line of UTF-8 with at most 200 bytes.
  [[nodiscard]] std::uint32_t optics(std::string_view name);
  [[nodiscard]] const std::string& optics_name(std::uint32_t optics) const { return mesh_.optics_names[optics]; }
  // Returns the optics of triangles without a material; refuses if the scene names none. `line` is used as in refuse.
  [[nodiscard]] std::uint32_t default_optics(std::size_t line);
  [[nodiscard]] std::uint32_t organ(const Organ& organ);
  // Returns the organ of triangles that have none: plant 1, named after the optics, rank 0.
  [[nodiscard]] std::uint32_t default_organ(std::uint32_t optics);

  // Adds a polygon, cut into the triangle fan about its first corner. It needs at least three valid vertex numbers. Either all
  // polygons of a file have labels or none has.
  void add_polygon(std::span<const std::uint32_t> corners, std::uint32_t optics, std::uint32_t organ,
                   std::optional<std::uint64_t> label = std::nullopt);

  [[nodiscard]] Mesh take() { return std::move(mesh_); }

 private:
  void check_name(std::string_view kind, std::string_view name) const;

  const MeshSource& source_;
  Mesh mesh_;
  std::map<std::string, std::uint32_t, std::less<>> optics_;
  std::map<std::tuple<std::uint32_t, std::string, int>, std::uint32_t> organs_;
  std::uint32_t last_optics_ = 0, last_organ_ = 0;  // most triangles share those of the one before
};

}  // namespace sunfleck
