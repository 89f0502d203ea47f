#pragma once
// Names for the organs of PLY files that tell them apart by colour alone.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

namespace sunfleck {

// The colours of a file's triangles, as red, green and blue in 8 bits each.
class PlyColours {
 public:
  void add_vertex(std::uint32_t colour) { of_vertex_.push_back(colour); }
  // Adds the triangles of a polygon in the colour of its face, or else in that of its corners.
  void add_face(std::span<const std::uint32_t> corners, std::optional<std::uint32_t> colour);

  // Returns names like colour_1e3c0a, in the order of their first triangles. They are empty if the colours distinguish nothing or
  // are no organs: a single colour, over 64 of them, or faces with corners of different colours.
  [[nodiscard]] std::vector<std::string> names() const;

  // Returns the number of faces with corners of different colours; 0 if there are over 64 colours, as in scans.
  [[nodiscard]] std::size_t mixed_faces() const;

  // Returns the index into names() for each triangle, if there are names.
  [[nodiscard]] const std::vector<std::uint32_t>& of_triangle() const { return of_triangle_; }

 private:
  std::vector<std::uint32_t> of_vertex_;
  std::vector<std::uint32_t> of_triangle_;
  std::vector<std::uint32_t> colours_;  // all different
  std::unordered_map<std::uint32_t, std::uint32_t> number_of_;
  std::size_t mixed_ = 0;    // faces
  bool is_complete_ = true;  // every face had a colour
};

}  // namespace sunfleck
