#pragma once
// What the two glTF writers share.

#include "canopy/mesh.h"
#include "io/gltf_library.h"

#include <array>
#include <span>
#include <string>
#include <string_view>

namespace sunfleck {

// plant1_leaf7; organ_from_name reads it back.
[[nodiscard]] std::string node_name(const Organ& organ);

// {"plant", "organ", "rank"}
[[nodiscard]] tinygltf::Value organ_extras(const Organ& organ);

// Appends to the model's one buffer and describes the piece: `accessor` needs its types only. Returns the accessor's number.
// All pieces are whole words, as GLB wants.
template <class T>
int add_piece(tinygltf::Model& model, std::span<const T> values, int target, tinygltf::Accessor accessor) {
  static_assert(sizeof(T) % 4 == 0);
  std::vector<unsigned char>& buffer = model.buffers.at(0).data;
  tinygltf::BufferView view;
  view.buffer = 0;
  view.byteOffset = buffer.size();
  view.byteLength = values.size_bytes();
  view.target = target;
  const auto* bytes = reinterpret_cast<const unsigned char*>(values.data());
  buffer.insert(buffer.end(), bytes, bytes + view.byteLength);
  accessor.bufferView = static_cast<int>(model.bufferViews.size());
  accessor.count = values.size();
  model.bufferViews.push_back(view);
  model.accessors.push_back(std::move(accessor));
  return static_cast<int>(model.accessors.size() - 1);
}

// A VEC3 of floats with its bounds, which must be finite.
int add_positions(tinygltf::Model& model, std::span<const std::array<float, 3>> positions);

enum class GltfForm { binary, text };

// Throws Error (failure), naming `file`, beyond 3 GiB.
[[nodiscard]] std::string gltf_bytes(const tinygltf::Model& model, GltfForm form, std::string_view file);

}  // namespace sunfleck
