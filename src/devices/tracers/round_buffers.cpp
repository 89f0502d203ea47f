#include "devices/tracers/round_buffers.h"

#include "base/error.h"

#include <algorithm>
#include <utility>

namespace sunfleck {
namespace {

// The shaders read these structs in scalar block layout.
static_assert(offsetof(shared::PassBlock, choices) == 196);
static_assert(offsetof(shared::PassBlock, ground) == 48);
static_assert(sizeof(shared::RoundState) == 104);
static_assert(sizeof(shared::RoundColumn) == 104);
static_assert(offsetof(shared::RoundColumn, load_shift) == 56);
static_assert(offsetof(shared::RoundColumn, lowest) == 80);
static_assert(offsetof(shared::RoundColumn, from_beam) == 88);
static_assert(sizeof(shared::RoundElement) == 8);
static_assert(sizeof(shared::ElementRun) == 48);
static_assert(sizeof(shared::ReceiverPlane) == 20);
static_assert(sizeof(shared::WaitingPlace) == sizeof(EmissionPoint));
static_assert(offsetof(shared::WaitingPlace, level) == offsetof(EmissionPoint, level));
static_assert(offsetof(shared::WaitingPlace, u) == offsetof(EmissionPoint, u));
static_assert(sizeof(Triangle) == 36);

// Part of the device's memory that the buffers of rounds may take; the tree and the beam need the rest.
constexpr double most_of_heap = 0.5;

constexpr std::size_t group_words = 3;  // along x, y and z

constexpr std::array<RoundBuffer, round_buffer_count> round_buffers() {
  std::array<RoundBuffer, round_buffer_count> all{};
  for (std::size_t k = 0; k < all.size(); ++k) all[k] = static_cast<RoundBuffer>(k);
  return all;
}

}  // namespace

RoundSizes::RoundSizes(std::span<const RoundsPass> passes, std::size_t at_a_time, const shared::RoundChoices& of_choices)
    : choices(of_choices) {
  const RoundsOrder& any = *passes.front().order;
  elements = any.scene.model.canopy.size();
  for (const std::span<const Triangle> array : corner_arrays(any.scene.model.canopy.corners)) corners += array.size();
  element_runs = any.block.runs;
  surfaces = any.scene.surfaces.of.size();
  cells = any.scene.layout.cells();
  planes = any.block.planes;
  if (any.scene.receivers != nullptr) plane_cells = any.scene.receivers->cells();
  columns = any.block.columns;
  faces = any.block.faces;
  small_words = shared::small_words(any.block);
  all_words = shared::all_words(any.block);
  for (const RoundsPass& pass : passes) {
    packets = std::max<std::size_t>(packets, pass.order->most_packets());
    places = std::max({places, pass.order->first_places(), packets});
    counts_hits = counts_hits || pass.order->block.counts_hits != 0;
  }
  packets_at_a_time = std::min(at_a_time, packets);
}

std::size_t RoundSizes::bytes(RoundBuffer buffer) const {
  constexpr std::size_t word = sizeof(std::uint32_t);
  constexpr std::size_t quantum = sizeof(std::uint64_t);
  const std::size_t runs = places / shared::round_group_size + 1;
  const std::size_t sums = std::max(2 * places, runs * shared::place_parts);
  switch (buffer) {
    case RoundBuffer::pass:
      return sizeof(shared::PassBlock);
    case RoundBuffer::state:
      return sizeof(shared::RoundState);
    case RoundBuffer::columns:
      return columns * sizeof(shared::RoundColumn);
    case RoundBuffer::totals:
      return all_words * quantum;
    case RoundBuffer::copies:
      return choices.copies * small_words * quantum;
    case RoundBuffer::faces:
      return 2 * faces * columns * quantum;
    case RoundBuffer::elements:
      return elements * sizeof(shared::RoundElement);
    case RoundBuffer::corners:
      return corners * sizeof(Triangle);
    case RoundBuffer::next_places:
    case RoundBuffer::places:
      return places * sizeof(shared::WaitingPlace);
    case RoundBuffer::next_quanta:
    case RoundBuffer::quanta:
      return places * columns * quantum;
    case RoundBuffer::sums:
      return sums * quantum;
    case RoundBuffer::block_sums:
      return (sums / shared::numbers_per_block + 2) * quantum;
    case RoundBuffer::numbers:
      return packets * word;
    case RoundBuffer::weights:
      return packets * columns * word;
    case RoundBuffer::packets:
      return packets_at_a_time * sizeof(shared::Packet);
    case RoundBuffer::order:
      return (1 + packets_at_a_time) * word;
    case RoundBuffer::landings:
      return packets_at_a_time * sizeof(shared::Landing);
    case RoundBuffer::side_landed:
      return 2 * elements * columns * quantum;
    case RoundBuffer::element_hits:
      return counts_hits ? elements * word : 0;
    case RoundBuffer::cell_landed:
      return cells * columns * quantum;
    case RoundBuffer::surface_landed:
      return 2 * surfaces * columns * quantum;
    case RoundBuffer::groups:
      return shared::kinds_of_groups * group_words * word;
    case RoundBuffer::outbox:
      return word + packets_at_a_time * sizeof(shared::PausedPacket);
    case RoundBuffer::runs:
      return element_runs * sizeof(shared::ElementRun);
    case RoundBuffer::planes:
      return planes * sizeof(shared::ReceiverPlane);
    case RoundBuffer::plane_cells:
      return plane_cells * columns * quantum;
  }
  return 0;
}

std::size_t RoundSizes::most_lanes(const GpuContext& context, std::uint64_t most_threads) const {
  const DeviceLimits& limits = context.limits();
  std::size_t of_scene = 0, of_lane = 0;
  for (const RoundBuffer buffer : round_buffers()) {
    const std::size_t size = bytes(buffer);
    if (size > limits.max_storage_buffer_bytes || size > limits.max_allocation_bytes) return 0;
    (is_of_scene(buffer) ? of_scene : of_lane) += size;
  }
  if (std::max({2 * places, packets, small_words}) > most_threads) return 0;
  const auto most = static_cast<std::size_t>(most_of_heap * static_cast<double>(limits.heap_bytes));
  return most < of_scene ? 0 : (most - of_scene) / std::max<std::size_t>(1, of_lane);
}

std::size_t RoundBuffers::offset_of_groups(std::uint32_t kind) {
  return kind * group_words * sizeof(std::uint32_t);
}

bool RoundBuffers::make_room(const RoundSizes& sizes, std::size_t lanes) {
  if (lanes_.size() < lanes) lanes_.resize(lanes);
  try {
    make_room(sizes, true, of_scene_);
    for (std::size_t lane = 0; lane < lanes; ++lane) make_room(sizes, false, lanes_[lane]);
  } catch (const Error&) {  // the host can go on, which needs some of the memory
    of_scene_ = {};
    lanes_.clear();
    return false;
  }
  return true;
}

void RoundBuffers::make_room(const RoundSizes& sizes, bool of_scene, Buffers& buffers) {
  std::vector<RoundBuffer> own;
  std::vector<std::size_t> bytes;
  bool have_room = true;
  for (const RoundBuffer which : round_buffers()) {
    if (is_of_scene(which) != of_scene) continue;
    const GpuBuffer& buffer = buffers[static_cast<std::size_t>(which)];
    own.push_back(which);
    bytes.push_back(sizes.bytes(which));
    have_room = have_room && buffer.handles && buffer.bytes >= bytes.back();
  }
  if (have_room) return;
  buffers = {};  // frees the memory first
  std::vector<GpuBuffer> created = create_storage_buffers(context_, bytes, "rounds of packets");
  for (std::size_t k = 0; k < own.size(); ++k) buffers[static_cast<std::size_t>(own[k])] = std::move(created[k]);
}

std::vector<const GpuBuffer*> RoundBuffers::of(std::size_t lane, const OtherBuffer& instead) const {
  std::vector<const GpuBuffer*> all;
  for (const RoundBuffer buffer : round_buffers()) {
    all.push_back(instead.buffer != nullptr && buffer == instead.which ? instead.buffer : &at(lane, buffer));
  }
  return all;
}

}  // namespace sunfleck
