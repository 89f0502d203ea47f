#pragma once
// Functions shared by the two glTF writers.

#include "files/formats/mesh/gltf_library.h"
#include "physics/canopy/mesh.h"

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sunfleck {

// Returns {"plant", "organ", "rank"}.
[[nodiscard]] tinygltf::Value organ_extras(const Organ& organ);

// Appends the values to the model's only buffer with a view and an accessor, and returns the index of the accessor. Only the
// types of `accessor` need to be set. The size of every value is a multiple of four bytes, because GLB requires that alignment.
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

// Adds a VEC3 of floats with its bounds; the positions must be finite.
int add_positions(tinygltf::Model& model, std::span<const std::array<float, 3>> positions);

enum class GltfForm { binary, text };

// Returns the bytes of the file. Throws Error (failure), naming `file`, if it exceeds 3 GiB.
[[nodiscard]] std::string gltf_bytes(const tinygltf::Model& model, GltfForm form, std::string_view file);

}  // namespace sunfleck
