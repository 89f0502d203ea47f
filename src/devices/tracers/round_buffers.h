#pragma once
// The buffers of an indirect pass that a device makes on its own.

#include "devices/gpu/buffer.h"
#include "devices/gpu/context.h"
#include "physics/transport/indirect/device_rounds.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace sunfleck {

// The bindings of shaders/rounds/pass.glsl but for the last, which belongs to the packets on their way.
enum class RoundBuffer : std::uint8_t {
  pass,
  state,
  columns,
  totals,
  copies,
  faces,
  elements,
  corners,
  next_places,
  next_quanta,
  places,
  quanta,
  sums,
  block_sums,
  numbers,
  weights,
  packets,
  order,
  landings,
  side_landed,
  element_hits,
  cell_landed,
  surface_landed,
  groups,
};
inline constexpr std::size_t round_buffer_count = 24;

// The sizes of a pass that decide how large its buffers are.
struct RoundSizes {
  RoundSizes() = default;
  RoundSizes(const RoundsOrder& order, std::size_t packets_at_a_time, const shared::RoundChoices& choices);

  std::size_t elements = 0, surfaces = 0, cells = 0;
  std::size_t columns = 0, faces = 0, small_words = 0, layer_places = 0;
  std::size_t places = 0, packets = 0;  // at most
  std::size_t packets_at_a_time = 0;
  shared::RoundChoices choices{};

  // Returns the size of a buffer in bytes.
  [[nodiscard]] std::size_t bytes(RoundBuffer buffer) const;
  // Returns whether all buffers fit a device, as well as the dispatches of the pass.
  [[nodiscard]] bool fit(const GpuContext& context, std::uint64_t most_threads) const;
};

class RoundBuffers {
 public:
  explicit RoundBuffers(const GpuContext& context) : context_(context) {}

  // Replaces buffers that are too small by larger ones; these lose what they held.
  void make_room(const RoundSizes& sizes);

  // Frees all buffers.
  void free() { buffers_ = {}; }

  [[nodiscard]] const GpuBuffer& operator[](RoundBuffer buffer) const { return buffers_[static_cast<std::size_t>(buffer)]; }
  // Returns where the numbers of groups of a kind begin in their buffer, in bytes.
  [[nodiscard]] static std::size_t offset_of_groups(std::uint32_t kind);

  // Returns all of them in the order of their bindings, and `outbox` at the end.
  [[nodiscard]] std::vector<const GpuBuffer*> with(const GpuBuffer& outbox) const;

 private:
  const GpuContext& context_;
  std::array<GpuBuffer, round_buffer_count> buffers_;
};

}  // namespace sunfleck
