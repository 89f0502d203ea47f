#pragma once
// The file that a mesh reader reads, with messages about it.

#include "base/source_files.h"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace sunfleck {

// How many parts of a file that have triangles are named there: groups of an .obj; its objects, and the named objects, nodes,
// solids, instances or labelled organs of other formats.
struct NamedParts {
  std::size_t objects = 0, groups = 0;
};

struct MeshSource {
  std::filesystem::path file;
  std::string_view bytes;             // not empty
  std::optional<std::string> optics;  // for triangles whose file names no material
  bool allow_outside = false;         // true if the buffers of a glTF file may lie outside its folder
  SourceFiles* files = nullptr;       // collects the buffers of a glTF file
  NamedParts* named = nullptr;        // receives the counts of the file, if given
  bool keeps_colours = false;         // true if the colours of a PLY name its materials whether `optics` is given or not
};

// Throws Error (input) `FILE:LINE: what (why); cure`. Line 0 leaves the line out.
[[noreturn]] void refuse(const MeshSource& source, std::size_t line, std::string_view what, std::string_view why,
                         std::string_view cure);

// Removes the next word from `rest` and returns it as a coordinate; refuses a missing, unreadable or infinite one.
[[nodiscard]] double coordinate(const MeshSource& source, std::size_t line, std::string_view& rest);

}  // namespace sunfleck
