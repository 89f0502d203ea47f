#pragma once
// The tree on the device, shared by everything that traces it.

#include "devices/gpu/buffer.h"
#include "physics/bvh/bvh.h"

namespace sunfleck {

// How the shaders read the tree.
enum class TreeFetch { texel_buffers, storage_buffers };

// Returns texel buffers if they can hold the tree: 1.4 to 1.9 times faster on lavapipe.
[[nodiscard]] TreeFetch preferred_fetch(const GpuContext& context, const Bvh& bvh);

struct GpuTree {
  GpuTree(const GpuContext& context, const Bvh& bvh, TreeFetch fetch);

  // Returns the use of bindings 0 and 1 of every shader that includes tree.glsl.
  [[nodiscard]] BufferUse use() const { return nodes.use; }

  TreeFetch fetch;
  bool has_copies;  // for the specialisation constant of traverse.glsl
  GpuBuffer nodes, triangles;
};

}  // namespace sunfleck
