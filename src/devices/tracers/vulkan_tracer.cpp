#include "devices/tracers/vulkan_tracer.h"

#include "base/check.h"
#include "direct.spirv.h"
#include "direct_storage.spirv.h"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace sunfleck {
namespace {

// The shaders read these structs in scalar block layout.
static_assert(sizeof(shared::BeamBlock) == 140);
static_assert(offsetof(shared::BeamBlock, edge_u) == 16);
static_assert(offsetof(shared::BeamBlock, direction) == 48);
static_assert(offsetof(shared::BeamBlock, key) == 64);
static_assert(offsetof(shared::BeamBlock, ground) == 88);
static_assert(offsetof(shared::GroundMap, cells_x) == 24);
static_assert(sizeof(shared::GroundMap) == 40);
static_assert(offsetof(shared::BeamBlock, layer_base_y) == 128);
static_assert(sizeof(shared::BeamPush) == 12);
static_assert(sizeof(shared::PausedRay) == 24);

// Rays per dispatch, measured as a compromise between overhead and the response time to Ctrl-C or a display: about 50 ms each
// on two cores of software Vulkan, a few ms on a large GPU.
constexpr std::uint32_t software_rays_per_dispatch = 1U << 17U;
constexpr std::uint32_t hardware_rays_per_dispatch = 1U << 22U;

// Packets travel to the device and back, at most as many at a time as the smallest guaranteed storage binding holds.
constexpr std::uint32_t most_packets_per_dispatch = 1U << 20U;

constexpr std::size_t outbox_head_bytes = sizeof(std::uint32_t);

ShaderCode direct_shader(const GpuTree& tree, std::uint32_t group_size) {
  const std::span<const std::uint32_t> spirv = tree.fetch == TreeFetch::texel_buffers
                                                   ? std::span<const std::uint32_t>(direct_spirv)
                                                   : std::span<const std::uint32_t>(direct_storage_spirv);
  return {"direct",
          spirv,
          {tree.use(), tree.use(), BufferUse::storage, BufferUse::storage, BufferUse::storage, BufferUse::storage},
          sizeof(shared::BeamPush),
          group_size};
}

VulkanChoices completed(VulkanChoices choices, const GpuContext& context) {
  if (choices.rays_per_dispatch != 0) return choices;
  choices.rays_per_dispatch = context.description().software ? software_rays_per_dispatch : hardware_rays_per_dispatch;
  return choices;
}

}  // namespace

VulkanTracer::VulkanTracer(const GpuContext& context, const Bvh& bvh, const GpuTree& tree, TraceDomain domain,
                           std::size_t counter_words, VulkanChoices choices)
    : context_(context),
      cpu_(bvh, domain),
      domain_(domain),
      choices_(completed(choices, context)),
      budget_(choices_.rays_per_dispatch, choices_.seconds_per_dispatch),
      tree_(tree),
      beam_(create_buffer(context, BufferUse::storage, sizeof(shared::BeamBlock), "the beam's description")),
      counters_(create_buffer(context, BufferUse::storage, counter_words * sizeof(std::uint32_t), "the counters of landings")),
      inbox_(create_buffer(context, BufferUse::storage,
                           outbox_head_bytes + choices_.rays_per_dispatch * sizeof(shared::PausedRay), "paused rays")),
      outbox_(create_buffer(context, BufferUse::storage, inbox_.bytes, "paused rays")),
      pipeline_(context, direct_shader(tree, choices_.group_size),
                {domain.periodic ? 1U : 0U, domain.has_soil ? 1U : 0U, choices_.group_size}) {}

TracerDevice VulkanTracer::device() const {
  const DeviceDescription& device = context_.description();
  return {"vulkan", device.name, device.driver, device.software};
}

void VulkanTracer::dispatch(const shared::BeamPush& push) {
  const std::uint32_t none = 0;
  upload(context_, outbox_, std::as_bytes(std::span(&none, 1)));
  const GpuBuffer* const buffers[] = {&tree_.nodes, &tree_.triangles, &beam_, &counters_, &inbox_, &outbox_};
  pipeline_.run(push.count, std::as_bytes(std::span(&push, 1)), buffers);
}

std::uint32_t VulkanTracer::paused_count() const {
  std::uint32_t count = 0;
  download(context_, outbox_, std::as_writable_bytes(std::span(&count, 1)));
  return count;
}

std::uint32_t VulkanTracer::take_out_stuck_rays(const shared::BeamBlock& beam, std::uint32_t paused,
                                                std::span<std::uint32_t> counters) {
  std::vector<shared::PausedRay> rays(paused);
  download(context_, outbox_, std::as_writable_bytes(std::span(rays)), outbox_head_bytes);
  const auto stuck = std::partition(rays.begin(), rays.end(), [](const shared::PausedRay& ray) { return ray.stuck == 0; });
  for (auto ray = stuck; ray != rays.end(); ++ray) cpu_.finish_ray(beam, *ray, counters);
  if (stuck == rays.end()) return paused;
  rays.erase(stuck, rays.end());
  upload(context_, outbox_, std::as_bytes(std::span(rays)), outbox_head_bytes);
  return static_cast<std::uint32_t>(rays.size());
}

void VulkanTracer::add_landings(std::span<std::uint32_t> counters) const {
  constexpr std::size_t words_at_a_time = std::size_t{1} << 20U;
  std::vector<std::uint32_t> landed(std::min(words_at_a_time, counters.size()));
  for (std::size_t first = 0; first < counters.size(); first += landed.size()) {
    const std::span<std::uint32_t> part = std::span(landed).first(std::min(landed.size(), counters.size() - first));
    download(context_, counters_, std::as_writable_bytes(part), first * sizeof(std::uint32_t));
    for (std::size_t word = 0; word < part.size(); ++word) counters[first + word] += part[word];
  }
}

TraceOutcome VulkanTracer::count_beam(const shared::BeamBlock& beam, std::span<std::uint32_t> counters,
                                      const StopQuestion& stop) {
  EXPECT(counters.size_bytes(), ==, counters_.bytes);
  upload(context_, beam_, std::as_bytes(std::span(&beam, 1)));
  fill(context_, counters_, 0);
  const std::uint32_t rays = beam.columns * beam.rows;
  for (std::uint32_t first = 0; first < rays;) {
    const std::uint32_t slice = std::min(budget_.rays(), rays - first);
    shared::BeamPush push{first, slice, 0};
    while (push.count > 0) {
      if (stop && stop()) return TraceOutcome::stopped;
      const DispatchClock clock;
      dispatch(push);
      budget_.record_duration(push.count, clock.seconds());
      push = {0, paused_count(), 1};
      if (push.count > 0) push.count = take_out_stuck_rays(beam, push.count, counters);
      std::swap(inbox_, outbox_);
    }
    first += slice;
  }
  add_landings(counters);
  return TraceOutcome::finished;
}

TraceOutcome VulkanTracer::trace(const shared::PacketBlock& scene, std::span<const shared::Packet> packets,
                                 std::span<shared::Landing> landings, const StopQuestion& stop) {
  if (!packets_) {
    VulkanChoices choices = choices_;
    choices.rays_per_dispatch = std::min(choices.rays_per_dispatch, most_packets_per_dispatch);
    packets_ = std::make_unique<VulkanPackets>(context_, tree_, cpu_, domain_, choices);
  }
  return packets_->trace(scene, packets, landings, stop);
}

}  // namespace sunfleck
