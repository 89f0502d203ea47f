#include "devices/tracers/gpu_tree.h"

#include <algorithm>
#include <vector>

namespace sunfleck {
namespace {

// The shaders read these structs in scalar block layout.
static_assert(sizeof(BvhNode) == 5 * 16);
static_assert(sizeof(BvhTriangle) == 3 * 16);

template <class T>
GpuBuffer upload_array(const GpuContext& context, TreeFetch fetch, const std::vector<T>& array, const char* what) {
  const BufferUse use = fetch == TreeFetch::texel_buffers ? BufferUse::uniform_texel : BufferUse::storage;
  // A canopy without elements still has a root node, which is empty.
  const std::vector<T> empty(1);
  const std::span<const std::byte> bytes = std::as_bytes(std::span(array.empty() ? empty : array));
  GpuBuffer buffer = create_buffer(context, use, bytes.size(), what);
  upload(context, buffer, bytes);
  return buffer;
}

}  // namespace

TreeFetch preferred_fetch(const GpuContext& context, const Bvh& bvh) {
  const std::size_t texels = std::max(bvh.nodes.size() * sizeof(BvhNode), bvh.triangles.size() * sizeof(BvhTriangle)) / 16;
  return texels <= context.limits().max_texel_buffer_elements ? TreeFetch::texel_buffers : TreeFetch::storage_buffers;
}

GpuTree::GpuTree(const GpuContext& context, const Bvh& bvh, TreeFetch tree_fetch)
    : fetch(tree_fetch),
      has_copies(!bvh.copies.empty()),
      nodes(upload_array(context, tree_fetch, bvh.nodes, "the tree's nodes")),
      triangles(upload_array(context, tree_fetch, bvh.triangles, "the tree's triangles")) {}

}  // namespace sunfleck
