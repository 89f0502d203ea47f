#pragma once
// The first stage of the glTF reader: from the bytes of a .gltf or .glb file to a model with its buffers.

#include "files/formats/mesh/gltf_library.h"
#include "files/formats/mesh/mesh_source.h"

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace sunfleck {

// A glTF file: tinygltf's model without buffers and images, the bytes of each buffer, and the JSON itself for the extras, whose
// integers tinygltf truncates to 32 bits. The indices inside the model are not checked yet.
struct GltfDocument {
  nlohmann::json json;
  tinygltf::Model model;
  std::vector<std::string> owned;         // buffers that are not part of the file itself
  std::vector<std::string_view> buffers;  // [buffer], byteLength bytes
};

// Parses the file and reads its buffers. Throws Error (input) for malformed files, and for extensions that are not supported.
[[nodiscard]] GltfDocument open_gltf(const MeshSource& source);

}  // namespace sunfleck
