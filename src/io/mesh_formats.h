#pragma once
// What the mesh readers share: the file they read, the mesh they build, lines, numbers and messages.

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
  bool allow_outside = false;         // may a glTF file's buffers lie outside its folder?
  SourceFiles* files = nullptr;       // gets a glTF file's buffers
};

// One reader a format. Coordinates come back as the file has them: neither turned nor scaled; a mesh may be empty.
[[nodiscard]] Mesh read_can(const MeshSource& source);
[[nodiscard]] Mesh read_gltf(const MeshSource& source);  // GLB as well
[[nodiscard]] Mesh read_obj(const MeshSource& source);
[[nodiscard]] Mesh read_ply(const MeshSource& source);
[[nodiscard]] Mesh read_stl(const MeshSource& source);

// The content of a gzip file. A result of more than `limit` bytes is refused before the memory for it is taken.
[[nodiscard]] std::string inflate_gzip(const MeshSource& source, std::size_t limit);

// Throws Error (input) `FILE:LINE: what (why); cure`; line 0: the place has no line.
[[noreturn]] void refuse(const MeshSource& source, std::size_t line, std::string_view what, std::string_view why,
                         std::string_view cure);

// A piece of the file for a message: in quotes, on one line, cut after 40 bytes.
[[nodiscard]] std::string in_quotes(std::string_view text);

// `plant1_leaf7` is plant 1, leaf, rank 7; `plant1_leaf2_7` is leaf2, rank 7; `plant2_stem` has rank 0. A suffix like `.001`,
// as editors add to make names unique, is ignored. Empty for any other name.
[[nodiscard]] std::optional<Organ> organ_from_name(std::string_view name);

// Lines ended by \n, \r\n or \r, numbered from 1.
class LineReader {
 public:
  explicit LineReader(std::string_view text) : rest_(text) {}
  bool next();  // false at the end
  [[nodiscard]] std::string_view line() const { return line_; }
  [[nodiscard]] std::size_t number() const { return number_; }
  [[nodiscard]] std::string_view rest() const { return rest_; }

 private:
  std::string_view rest_, line_;
  std::size_t number_ = 0;
};

// Takes the next word, between blanks, off `rest`; empty at the end.
[[nodiscard]] std::string_view next_word(std::string_view& rest);
[[nodiscard]] std::string_view trimmed(std::string_view text);

// The same for the cell of a table, which may stand in double quotes.
[[nodiscard]] std::string_view unquoted(std::string_view cell);

// Empty if the word is not wholly a finite number (an integer).
[[nodiscard]] std::optional<double> parse_number(std::string_view word);
[[nodiscard]] std::optional<std::int64_t> parse_integer(std::string_view word);

// The next word as a coordinate; refuses a missing, unreadable or infinite one.
[[nodiscard]] double coordinate(const MeshSource& source, std::size_t line, std::string_view& rest);

// Builds a mesh in the file's order, with one entry for each optics name and organ.
class MeshBuilder {
 public:
  explicit MeshBuilder(const MeshSource& source) : source_(source) {}

  // Vertices and triangles are limited to 2^28 each; `count` more are refused beyond.
  void reserve_vertices(std::size_t count);
  std::uint32_t add_vertex(const glm::dvec3& position);
  [[nodiscard]] std::size_t vertex_count() const { return mesh_.vertices.size(); }

  // Names go into tables and other programs' files: a new one is refused that is not UTF-8 on one line of at most 200 bytes.
  [[nodiscard]] std::uint32_t optics(std::string_view name);
  [[nodiscard]] const std::string& optics_name(std::uint32_t optics) const { return mesh_.optics_names[optics]; }
  // For triangles without a material; refused where the scene names none. `line` as in refuse.
  [[nodiscard]] std::uint32_t default_optics(std::size_t line);
  [[nodiscard]] std::uint32_t organ(const Organ& organ);
  // Plant 1, named as the optics, rank 0: for triangles without an organ.
  [[nodiscard]] std::uint32_t default_organ(std::uint32_t optics);

  // Cuts a polygon of at least three vertex numbers, all in range, into the fan about its first corner. A file gives all of
  // its polygons labels, or none.
  void add_polygon(std::span<const std::uint32_t> corners, std::uint32_t optics, std::uint32_t organ,
                   std::optional<std::uint64_t> label = std::nullopt);

  [[nodiscard]] Mesh take() { return std::move(mesh_); }

 private:
  void check_name(std::string_view kind, std::string_view name) const;

  const MeshSource& source_;
  Mesh mesh_;
  std::map<std::string, std::uint32_t, std::less<>> optics_;
  std::map<std::tuple<std::uint32_t, std::string, int>, std::uint32_t> organs_;
  std::uint32_t last_optics_ = 0, last_organ_ = 0;  // neighbouring triangles mostly share theirs
};

}  // namespace sunfleck
