#include "files/formats/mesh/gltf_parts.h"

#include "base/check.h"
#include "base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace sunfleck {
namespace {

// Returns 7, not 7.0, wherever the library's integers reach.
tinygltf::Value whole_number(std::uint32_t number) {
  if (std::in_range<int>(number)) return tinygltf::Value(static_cast<int>(number));
  return tinygltf::Value(static_cast<double>(number));
}

}  // namespace

tinygltf::Value organ_extras(const Organ& organ) {
  return tinygltf::Value(tinygltf::Value::Object{
      {"plant", whole_number(organ.plant)}, {"organ", tinygltf::Value(organ.name)}, {"rank", tinygltf::Value(organ.rank)}});
}

int add_positions(tinygltf::Model& model, std::span<const std::array<float, 3>> positions) {
  tinygltf::Accessor accessor;
  accessor.type = TINYGLTF_TYPE_VEC3;
  accessor.componentType = TINYGLTF_COMPONENT_TYPE_FLOAT;
  accessor.minValues.assign(3, std::numeric_limits<double>::max());
  accessor.maxValues.assign(3, std::numeric_limits<double>::lowest());
  for (const std::array<float, 3>& position : positions) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      EXPECT(std::isfinite(position[axis]), ==, true);
      accessor.minValues[axis] = std::min<double>(accessor.minValues[axis], position[axis]);
      accessor.maxValues[axis] = std::max<double>(accessor.maxValues[axis], position[axis]);
    }
  }
  return add_piece(model, positions, TINYGLTF_TARGET_ARRAY_BUFFER, accessor);
}

std::string gltf_bytes(const tinygltf::Model& model, GltfForm form, std::string_view file) {
  constexpr std::size_t most_bytes = std::size_t{3} << 30;  // GLB is limited to 4 GiB, JSON included
  if (!model.buffers.empty() && model.buffers[0].data.size() > most_bytes)
    throw_failure(fmt::format("{}: cannot be written as glTF", file), "it would exceed 3 GiB", "write it in parts");
  std::ostringstream text;
  text.exceptions(std::ios::badbit);  // otherwise a lack of memory would silently truncate the text
  const bool binary = form == GltfForm::binary;
  if (!tinygltf::TinyGLTF().WriteGltfSceneToStream(&model, text, !binary, binary))
    throw_failure(fmt::format("{}: cannot be written as glTF", file), "tinygltf refused it", "write another format");
  return std::move(text).str();
}

}  // namespace sunfleck
