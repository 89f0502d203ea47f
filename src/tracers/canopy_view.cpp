#include "tracers/canopy_view.h"

#include "base/check.h"
#include "gpu/compute.h"
#include "shared/view.h"
#include "tracers/cpu_tracer.h"
#include "view.spirv.h"
#include "view_storage.spirv.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace sunfleck {
namespace {

// Samples between two questions whether to stop.
constexpr std::uint32_t software_samples_per_slice = 1U << 18U;
constexpr std::uint32_t hardware_samples_per_slice = 1U << 22U;

ShaderCode view_shader(const GpuTree& tree) {
  const std::span<const std::uint32_t> spirv = tree.fetch == TreeFetch::texel_buffers
                                                   ? std::span<const std::uint32_t>(view_spirv)
                                                   : std::span<const std::uint32_t>(view_storage_spirv);
  return {"view",
          spirv,
          {tree.use(), tree.use(), BufferUse::storage, BufferUse::storage, BufferUse::storage},
          sizeof(shared::ViewPush),
          shared::group_size};
}

template <class T>
GpuBuffer upload_storage(const GpuContext& context, std::span<const T> data, const char* what) {
  GpuBuffer buffer = create_buffer(context, BufferUse::storage, data.size_bytes(), what);
  upload(context, buffer, std::as_bytes(data));
  return buffer;
}

std::uint32_t sample_count(const shared::ViewBlock& view, const std::vector<glm::vec2>& offsets) {
  EXPECT(offsets.size(), ==, std::size_t{view.samples});
  const std::uint64_t samples = std::uint64_t{view.width} * view.height * view.samples;
  EXPECT(samples, <, std::uint64_t{1} << 32U);
  return static_cast<std::uint32_t>(samples);
}

// The view with its rays beginning a little before the nearest depth of canopy and ground.
shared::ViewBlock begun_near_scene(const Bvh& bvh, shared::ViewBlock view) {
  constexpr double nothing = std::numeric_limits<double>::infinity();
  double nearest = nothing;
  const auto take_in = [&](const glm::vec3& lo, const glm::vec3& hi) {
    for (int corner = 0; corner < 8; ++corner) {
      const glm::dvec3 at((corner & 1) != 0 ? hi.x : lo.x, (corner & 2) != 0 ? hi.y : lo.y, (corner & 4) != 0 ? hi.z : lo.z);
      nearest = std::min(nearest, glm::dot(at - glm::dvec3(view.position), glm::dvec3(view.forward)));
    }
  };
  for (int slot = 0; slot < 8 && !bvh.nodes.empty(); ++slot) {
    if (bvh.nodes[0].meta[static_cast<std::size_t>(slot)] == 0) continue;
    const Box box = child_box(bvh.nodes[0], slot);
    take_in(box.lo, box.hi);
  }
  const shared::GroundMap& ground = view.ground;
  if (ground.cells_x > 0) {
    take_in({ground.plot_lo.x, ground.y, ground.plot_lo.y}, {ground.plot_hi.x, ground.y, ground.plot_hi.y});
  }
  view.start = nearest == nothing ? 0.0F : static_cast<float>(std::max(0.0, nearest * (1.0 - 0x1p-10)));
  return view;
}

shared::SeenSurface see_sample(const Bvh& bvh, const shared::ViewBlock& view, glm::vec2 offset, std::uint32_t number) {
  const glm::vec2 at = shared::sample_point(view, number, offset, shared::exact_reciprocal(static_cast<float>(view.width)),
                                            shared::exact_reciprocal(static_cast<float>(view.height)));
  const glm::vec3 direction = shared::view_direction(view, at.x, at.y);
  const shared::Ray ray = shared::make_ray(shared::view_origin(view, direction), direction);
  const float ground_t = shared::seen_ground(ray, view.ground);
  const CpuHit hit = nearest_hit(bvh, ray, shared::ground_limit(ray, view.ground, ground_t), Images::originals);
  if (hit.found) return {2 * hit.element + hit.lower, shared::view_depth(view, hit.t)};
  if (ground_t <= 0.0F) return {shared::seen_nothing, 0.0F};
  return {2 * view.elements + shared::soil_cell(view.ground, shared::ground_point(ray, ground_t)),
          shared::view_depth(view, ground_t)};
}

}  // namespace

std::vector<shared::SeenSurface> see_with_gpu(const GpuContext& context, const GpuTree& tree, const Bvh& bvh,
                                              const shared::ViewBlock& camera, const std::vector<glm::vec2>& offsets,
                                              const StopQuestion& stop) {
  const shared::ViewBlock view = begun_near_scene(bvh, camera);
  const std::uint32_t samples = sample_count(view, offsets);
  const std::uint32_t slice =
      std::min(samples, context.description().software ? software_samples_per_slice : hardware_samples_per_slice);
  const GpuBuffer block = upload_storage(context, std::span(&view, 1), "the camera");
  const GpuBuffer places = upload_storage(context, std::span(offsets), "the places of samples");
  const GpuBuffer slice_seen =
      create_buffer(context, BufferUse::storage, slice * sizeof(shared::SeenSurface), "the surfaces of a picture");
  const GpuBuffer* const buffers[] = {&tree.nodes, &tree.triangles, &block, &places, &slice_seen};
  ComputePipeline pipeline(context, view_shader(tree), {});
  std::vector<shared::SeenSurface> seen(samples);
  for (std::uint32_t first = 0; first < samples;) {
    if (stop && stop()) return {};
    const shared::ViewPush push{first, std::min(slice, samples - first)};
    pipeline.run(push.count, std::as_bytes(std::span(&push, 1)), buffers);
    download(context, slice_seen, std::as_writable_bytes(std::span(seen).subspan(first, push.count)));
    for (std::uint32_t number = first; number < first + push.count; ++number) {
      if (seen[number].surface != shared::seen_unfinished) continue;
      seen[number] = see_sample(bvh, view, offsets[number % view.samples], number);
    }
    first += push.count;
  }
  return seen;
}

std::vector<shared::SeenSurface> see_with_cpu(const Bvh& bvh, const shared::ViewBlock& camera,
                                              const std::vector<glm::vec2>& offsets, const StopQuestion& stop) {
  const shared::ViewBlock view = begun_near_scene(bvh, camera);
  const std::uint32_t samples = sample_count(view, offsets);
  std::vector<shared::SeenSurface> seen(samples);
  for (std::uint32_t first = 0; first < samples;) {
    if (stop && stop()) return {};
    const std::uint32_t end = first + std::min(software_samples_per_slice, samples - first);
    tbb::parallel_for(tbb::blocked_range<std::uint32_t>(first, end, 256), [&](const auto& range) {
      for (std::uint32_t number = range.begin(); number < range.end(); ++number) {
        seen[number] = see_sample(bvh, view, offsets[number % view.samples], number);
      }
    });
    first = end;
  }
  return seen;
}

std::vector<glm::vec2> sample_offsets(int count) {
  constexpr double plastic = 1.32471795724474602596;
  std::vector<glm::vec2> offsets;
  for (int k = 0; k < count; ++k) {
    double whole = 0.0;
    offsets.emplace_back(static_cast<float>(std::modf(0.5 + k / plastic, &whole)),
                         static_cast<float>(std::modf(0.5 + k / (plastic * plastic), &whole)));
  }
  return offsets;
}

}  // namespace sunfleck
