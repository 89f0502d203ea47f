#include "devices/tracers/vulkan_tracer.h"

#include "base/check.h"
#include "base/error.h"
#include "base/log.h"
#include "direct.spirv.h"
#include "direct_storage.spirv.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
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
static_assert(sizeof(shared::BeamPush) == 16);
static_assert(sizeof(shared::PausedRay) == 24);

// Rays per dispatch, measured as a compromise between overhead and the response time to Ctrl-C or a display: about 50 ms each
// on two cores of software Vulkan, a few ms on a large GPU.
constexpr std::uint32_t software_rays_per_dispatch = 1U << 17U;
constexpr std::uint32_t hardware_rays_per_dispatch = 1U << 22U;

// Packets travel to the device and back, at most as many at a time as the smallest guaranteed storage binding holds.
constexpr std::uint32_t most_packets_per_dispatch = 1U << 20U;

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
      tree_(tree),
      beam_(create_buffer(context, BufferUse::storage, sizeof(shared::BeamBlock), "the beam's description")),
      counters_(create_buffer(context, BufferUse::storage, counter_words * sizeof(std::uint32_t), "the counters of landings")),
      landings_(create_buffer(context, BufferUse::storage, sizeof(shared::Landing), "landings of beam rays")),
      work_(context, tree, domain, choices_, {"direct", direct_spirv, direct_storage_spirv, 3}, "paused rays") {}

TracerDevice VulkanTracer::device() const {
  const DeviceDescription& device = context_.description();
  return {"vulkan", device.name, device.driver, device.software};
}

void VulkanTracer::add_landings(std::span<std::uint32_t> counters) {
  constexpr std::size_t words_at_a_time = std::size_t{1} << 20U;
  landed_.resize(std::min(words_at_a_time, counters.size()));
  for (std::size_t first = 0; first < counters.size(); first += landed_.size()) {
    const std::span<std::uint32_t> part = std::span(landed_).first(std::min(landed_.size(), counters.size() - first));
    download(context_, counters_, std::as_writable_bytes(part), first * sizeof(std::uint32_t));
    for (std::size_t word = 0; word < part.size(); ++word) counters[first + word] += part[word];
  }
}

TraceOutcome VulkanTracer::count_beam(const shared::BeamBlock& beam, std::span<std::uint32_t> counters,
                                      const StopQuestion& stop) {
  return follow_beam(beam, counters, {}, stop);
}

std::optional<TraceOutcome> VulkanTracer::record_beam(const shared::BeamBlock& beam, std::span<std::uint32_t> counters,
                                                      std::span<shared::Landing> landings, const StopQuestion& stop) {
  const std::size_t bytes = std::min(choices_.rays_per_dispatch, most_packets_per_dispatch) * sizeof(shared::Landing);
  if (landings_.bytes < bytes) {
    try {
      landings_ = create_buffer(context_, BufferUse::storage, bytes, "landings of beam rays");
    } catch (const Error&) {  // memory is short, and the rays can be traced again
      return std::nullopt;
    }
  }
  return follow_beam(beam, counters, {nullptr, landings}, stop);
}

std::optional<KeptBeam> VulkanTracer::keep_beam(const shared::BeamBlock& beam, std::span<std::uint32_t> counters,
                                                const StopQuestion& stop) {
  if (refuses_passes_ || !create_rounds()) return std::nullopt;
  std::shared_ptr<const LandingsOnDevice> landings = rounds_->keep_landings(std::size_t{beam.columns} * beam.rows);
  if (landings == nullptr) return std::nullopt;
  const TraceOutcome outcome = follow_beam(beam, counters, {&landings->buffer(), {}}, stop);
  return KeptBeam{outcome, std::move(landings)};
}

TraceOutcome VulkanTracer::follow_beam(const shared::BeamBlock& beam, std::span<std::uint32_t> counters, const Record& record,
                                       const StopQuestion& stop) {
  EXPECT(counters.size_bytes(), ==, counters_.bytes);
  const std::uint32_t rays = beam.columns * beam.rows;
  if (rays == 0) return TraceOutcome::finished;
  const bool fetches = !record.fetched.empty();
  const GpuBuffer& landings = record.buffer != nullptr ? *record.buffer : landings_;
  std::vector<shared::PausedRay> left_to_cpu;
  const auto finish = [&](const shared::PausedRay& ray) { left_to_cpu.push_back(ray); };
  std::uint32_t first = 0;
  const auto send = [&](Submission& submission) {
    if (first > 0) return;
    submission.upload(beam_, bytes_of(beam));
    submission.fill(counters_, 0);
  };
  while (first < rays) {
    const std::uint32_t most =
        fetches ? std::min(work_.rays_per_dispatch(), most_packets_per_dispatch) : work_.rays_per_dispatch();
    const std::uint32_t slice = std::min(most, rays - first);
    const auto take = [&](Submission& submission, const GpuBuffer&) {  // the counters go on until all rays are traced
      if (fetches) submission.download(landings, std::as_writable_bytes(record.fetched.subspan(first, slice)));
    };
    const std::uint32_t first_landing = fetches ? first : record.buffer != nullptr ? 0 : shared::no_landings;
    const shared::BeamPush push{first, slice, 0, first_landing};
    if (work_.run(push, {&beam_, &counters_, &landings}, stop, send, take, finish) == TraceOutcome::stopped) {
      return TraceOutcome::stopped;
    }
    first += slice;
  }
  finish_on_cpu(beam, left_to_cpu, counters, record);
  add_landings(counters);
  return TraceOutcome::finished;
}

void VulkanTracer::finish_on_cpu(const shared::BeamBlock& beam, std::span<const shared::PausedRay> rays,
                                 std::span<std::uint32_t> counters, const Record& record) const {
  if (rays.empty()) return;
  Submission submission(context_);
  for (const shared::PausedRay& ray : rays) {
    shared::Landing landing{};
    cpu_.finish_ray(beam, ray, counters, std::span(&landing, 1));
    if (!record.fetched.empty()) record.fetched[ray.ray] = landing;
    if (record.buffer == nullptr) continue;
    submission.upload(*record.buffer, bytes_of(landing), ray.ray * sizeof(landing));
  }
  submission.finish();
}

TraceOutcome VulkanTracer::trace(const shared::PacketBlock& scene, std::span<const shared::Packet> packets,
                                 std::span<shared::Landing> landings, const StopQuestion& stop) {
  if (!packets_) packets_ = std::make_unique<VulkanPackets>(context_, tree_, cpu_, domain_, packet_choices());
  return packets_->trace(scene, packets, landings, stop);
}

std::optional<TraceOutcome> VulkanTracer::make_rounds(std::span<const RoundsPass> passes, const StopQuestion& stop) {
  if (!create_rounds()) return std::nullopt;
  const std::optional<TraceOutcome> outcome = rounds_->make(passes, stop);
  const bool may_keep_landings = passes.front().order->landings != nullptr;
  if (!outcome && passes.size() == 1 && may_keep_landings) refuses_passes_ = true;
  return outcome;
}

std::size_t VulkanTracer::most_passes() const {
  return VulkanRounds::most_lanes(choices_, context_.description().software);
}

bool VulkanTracer::create_rounds() {
  if (rounds_ || leaves_rounds_to_host_) return rounds_ != nullptr;
  const bool software = context_.description().software;
  const bool wanted = choices_.rounds_at == RoundsAt::device || (choices_.rounds_at == RoundsAt::best && !software);
  leaves_rounds_to_host_ = true;
  if (!wanted || !RoundSteps::work_on(context_.limits())) return false;
  try {
    rounds_ = std::make_unique<VulkanRounds>(context_, tree_, cpu_, domain_, packet_choices());
  } catch (const Error& error) {
    say(fmt::format("packets are drawn and booked on the host: {}", error.what()));
  }
  return rounds_ != nullptr;
}

VulkanChoices VulkanTracer::packet_choices() const {
  VulkanChoices choices = choices_;
  choices.rays_per_dispatch = std::min(choices.rays_per_dispatch, most_packets_per_dispatch);
  return choices;
}

}  // namespace sunfleck
