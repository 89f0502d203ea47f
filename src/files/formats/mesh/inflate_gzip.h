#pragma once
// Unpacks gzip files.

#include "files/formats/mesh/mesh_source.h"

#include <cstddef>
#include <string>

namespace sunfleck {

// Returns the content of a gzip file. Refuses content of more than `limit` bytes before allocating memory for it.
[[nodiscard]] std::string inflate_gzip(const MeshSource& source, std::size_t limit);

}  // namespace sunfleck
