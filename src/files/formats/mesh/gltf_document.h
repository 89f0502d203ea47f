#pragma once
// The first stage of the glTF reader: from the bytes of a .gltf or .glb file to its JSON and buffers.

#include "files/formats/mesh/mesh_source.h"

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace sunfleck {

// The advice of messages about files that their program wrote wrongly.
inline constexpr std::string_view write_again = "export the file again";

// An object of the JSON. Each function throws Error (input) if the value is of another type.
class GltfObject {
 public:
  // `place` names the object in messages. Source and JSON must outlive it.
  GltfObject(const MeshSource& source, const nlohmann::json& object, std::string place);

  // Returns nothing if there is no such key.
  [[nodiscard]] const nlohmann::json* find(const char* key) const;
  // Returns an object inside this one; an empty one if there is no such key.
  [[nodiscard]] GltfObject inside(const char* key) const;
  // Returns the value of a key. T is int for an index, std::size_t, std::string, or a vector of int, double or std::string.
  template <class T>
  [[nodiscard]] T get(const char* key, T if_missing = T()) const;

  // Returns the number of objects in a list, and one of them; refuses an index beyond the list. `what` is their kind.
  [[nodiscard]] std::size_t count(const char* list) const;
  [[nodiscard]] GltfObject item(const char* list, int index, std::string_view what) const;

 private:
  const MeshSource& source_;
  const nlohmann::json& object_;
  std::string place_;
};

struct GltfDocument {
  nlohmann::json json;                    // without the buffers
  std::vector<std::string> owned;         // buffers that are not part of the file itself
  std::vector<std::string_view> buffers;  // [buffer], byteLength bytes
};

// Parses the file and reads its buffers. Throws Error (input) if it cannot.
[[nodiscard]] GltfDocument open_gltf(const MeshSource& source);

}  // namespace sunfleck
