#pragma once
// The tree on the device, shared by everything that traces it.

#include "devices/gpu/buffer.h"
#include "physics/bvh/bvh.h"

#include <cstdint>
#include <span>

namespace sunfleck {

// Returns how the shaders read the tree best: as texels if these buffers can hold it, 1.4 to 1.9 times faster on lavapipe.
[[nodiscard]] BufferUse preferred_use(const GpuContext& context, const Bvh& bvh);

struct GpuTree {
  GpuTree(const GpuContext& context, const Bvh& bvh, BufferUse use);

  // Returns the variant of a shader that reads the tree as it is stored.
  [[nodiscard]] std::span<const std::uint32_t> variant(std::span<const std::uint32_t> with_texel_buffers,
                                                       std::span<const std::uint32_t> with_storage_buffers) const {
    return use == BufferUse::uniform_texel ? with_texel_buffers : with_storage_buffers;
  }

  BufferUse use;    // of bindings 0 and 1 of every shader that includes tree.glsl
  bool has_copies;  // for the specialisation constant of traverse.glsl
  GpuBuffer nodes, triangles;
};

}  // namespace sunfleck
