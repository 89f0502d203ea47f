#pragma once
// The buffers of indirect passes that a device makes on its own.

#include "devices/gpu/buffer.h"
#include "devices/gpu/context.h"
#include "physics/transport/indirect/device_rounds.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace sunfleck {

// The bindings of shaders/rounds/pass.glsl.
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
  outbox,  // packets that are still on their way, after their number
  runs,
  planes,
  plane_cells,
};
inline constexpr std::size_t round_buffer_count = 28;

// Returns whether all passes of a scene share a buffer; each has the others for itself.
[[nodiscard]] constexpr bool is_of_scene(RoundBuffer buffer) {
  return buffer == RoundBuffer::elements || buffer == RoundBuffer::corners || buffer == RoundBuffer::runs ||
         buffer == RoundBuffer::planes;
}

// The sizes that decide how large the buffers of passes are.
struct RoundSizes {
  RoundSizes() = default;
  // Those of the largest of several passes of one scene.
  RoundSizes(std::span<const RoundsPass> passes, std::size_t packets_at_a_time, const shared::RoundChoices& choices);

  std::size_t elements = 0, corners = 0, element_runs = 0, surfaces = 0, cells = 0, planes = 0, plane_cells = 0;
  std::size_t columns = 0, faces = 0, small_words = 0, all_words = 0;
  std::size_t places = 0, packets = 0;  // at most
  std::size_t packets_at_a_time = 0;
  bool counts_hits = false;
  shared::RoundChoices choices{};

  // Returns the size of a buffer in bytes.
  [[nodiscard]] std::size_t bytes(RoundBuffer buffer) const;
  // Returns the number of passes side by side whose buffers fit a device; 0 if those of one do not, or its dispatches.
  [[nodiscard]] std::size_t most_lanes(const GpuContext& context, std::uint64_t most_threads) const;
};

// A buffer that takes the place of one of a lane, if there is one.
struct OtherBuffer {
  RoundBuffer which = RoundBuffer::outbox;
  const GpuBuffer* buffer = nullptr;
};

// The buffers of several passes side by side, each of which has a lane.
class RoundBuffers {
 public:
  explicit RoundBuffers(const GpuContext& context) : context_(context) {}

  // Has as many lanes at least, and replaces those with a buffer that is too small; these lose what they held. Returns false if
  // the memory is short, and leaves no buffer then.
  [[nodiscard]] bool make_room(const RoundSizes& sizes, std::size_t lanes);

  [[nodiscard]] const GpuBuffer& at(std::size_t lane, RoundBuffer buffer) const {
    return (is_of_scene(buffer) ? of_scene_ : lanes_[lane])[static_cast<std::size_t>(buffer)];
  }
  // Returns where the numbers of groups of a kind begin in their buffer, in bytes.
  [[nodiscard]] static std::size_t offset_of_groups(std::uint32_t kind);

  // Returns all of a lane in the order of their bindings.
  [[nodiscard]] std::vector<const GpuBuffer*> of(std::size_t lane, const OtherBuffer& instead = {}) const;

 private:
  // In a lane those of the scene are missing, and the other way round.
  using Buffers = std::array<GpuBuffer, round_buffer_count>;

  void make_room(const RoundSizes& sizes, bool of_scene, Buffers& buffers);

  const GpuContext& context_;
  Buffers of_scene_;
  std::vector<Buffers> lanes_;
};

}  // namespace sunfleck
