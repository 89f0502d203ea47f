#include "devices/tracers/gpu_tree.h"

#include <algorithm>
#include <vector>

namespace sunfleck {
namespace {

// The shaders read these structs in scalar block layout.
static_assert(sizeof(BvhNode) == 5 * 16);
static_assert(sizeof(BvhTriangle) == 3 * 16);

template <class T>
GpuBuffer upload_array(const GpuContext& context, BufferUse use, const std::vector<T>& array, const char* what) {
  // A canopy without elements still has a root node, which is empty.
  const std::vector<T> empty(1);
  return create_filled_buffer(context, use, std::as_bytes(std::span(array.empty() ? empty : array)), what);
}

}  // namespace

BufferUse preferred_use(const GpuContext& context, const Bvh& bvh) {
  const std::size_t texels = std::max(bvh.nodes.size() * sizeof(BvhNode), bvh.triangles.size() * sizeof(BvhTriangle)) / 16;
  return texels <= context.limits().max_texel_buffer_elements ? BufferUse::uniform_texel : BufferUse::storage;
}

GpuTree::GpuTree(const GpuContext& context, const Bvh& bvh, BufferUse tree_use)
    : use(tree_use),
      has_copies(!bvh.copies.empty()),
      nodes(upload_array(context, tree_use, bvh.nodes, "the tree's nodes")),
      triangles(upload_array(context, tree_use, bvh.triangles, "the tree's triangles")) {}

}  // namespace sunfleck
