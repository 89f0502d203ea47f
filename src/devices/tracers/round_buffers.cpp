#include "devices/tracers/round_buffers.h"

#include <algorithm>

namespace sunfleck {
namespace {

// The shaders read these structs in scalar block layout.
static_assert(offsetof(shared::PassBlock, choices) == 128);
static_assert(offsetof(shared::PassBlock, ground) == 48);
static_assert(sizeof(shared::RoundState) == 80);
static_assert(sizeof(shared::RoundColumn) == 88);
static_assert(offsetof(shared::RoundColumn, load_shift) == 56);
static_assert(offsetof(shared::RoundColumn, lowest) == 80);
static_assert(sizeof(shared::RoundElement) == 8);
static_assert(sizeof(shared::WaitingPlace) == sizeof(EmissionPoint));
static_assert(offsetof(shared::WaitingPlace, level) == offsetof(EmissionPoint, level));
static_assert(offsetof(shared::WaitingPlace, u) == offsetof(EmissionPoint, u));
static_assert(sizeof(Triangle) == 36);

// Part of the device's memory that the buffers of rounds may take; the tree and the beam need the rest.
constexpr double most_of_heap = 0.5;

constexpr std::size_t group_words = 3;  // along x, y and z

}  // namespace

RoundSizes::RoundSizes(const RoundsOrder& order, std::size_t at_a_time, const shared::RoundChoices& of_choices)
    : elements(order.scene.model.canopy.size()),
      surfaces(order.scene.surfaces.of.size()),
      cells(order.scene.layout.cells()),
      columns(order.block.columns),
      faces(order.block.faces),
      small_words(shared::small_words(order.block)),
      layer_places(shared::layer_places(order.block)),
      places(std::max<std::size_t>(order.places.size(), order.most_packets())),
      packets(order.most_packets()),
      packets_at_a_time(std::min(at_a_time, packets)),
      choices(of_choices) {}

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
      return (small_words + layer_places * columns) * quantum;
    case RoundBuffer::copies:
      return choices.copies * small_words * quantum;
    case RoundBuffer::faces:
      return 2 * faces * columns * quantum;
    case RoundBuffer::elements:
      return elements * sizeof(shared::RoundElement);
    case RoundBuffer::corners:
      return elements * sizeof(Triangle);
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
      return elements * word;
    case RoundBuffer::cell_landed:
      return cells * columns * quantum;
    case RoundBuffer::surface_landed:
      return 2 * surfaces * columns * quantum;
    case RoundBuffer::groups:
      return shared::kinds_of_groups * group_words * word;
  }
  return 0;
}

bool RoundSizes::fit(const GpuContext& context, std::uint64_t most_threads) const {
  const DeviceLimits& limits = context.limits();
  double all = 0.0;
  for (std::size_t k = 0; k < round_buffer_count; ++k) {
    const std::size_t size = bytes(static_cast<RoundBuffer>(k));
    if (size > limits.max_storage_buffer_bytes || size > limits.max_allocation_bytes) return false;
    all += static_cast<double>(size);
  }
  return all <= most_of_heap * static_cast<double>(limits.heap_bytes) &&
         std::max({2 * places, packets, small_words}) <= most_threads;
}

std::size_t RoundBuffers::offset_of_groups(std::uint32_t kind) {
  return kind * group_words * sizeof(std::uint32_t);
}

void RoundBuffers::make_room(const RoundSizes& sizes) {
  for (std::size_t k = 0; k < round_buffer_count; ++k) {
    const std::size_t size = sizes.bytes(static_cast<RoundBuffer>(k));
    GpuBuffer& buffer = buffers_[k];
    if (buffer.handles && buffer.bytes >= size) continue;
    buffer = GpuBuffer();  // frees the memory first
    buffer = create_buffer(context_, BufferUse::storage, size, "rounds of packets");
  }
}

std::vector<const GpuBuffer*> RoundBuffers::with(const GpuBuffer& outbox) const {
  std::vector<const GpuBuffer*> all;
  for (const GpuBuffer& buffer : buffers_) all.push_back(&buffer);
  all.push_back(&outbox);
  return all;
}

}  // namespace sunfleck
