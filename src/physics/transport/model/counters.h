#pragma once
// The counters of landings: one array of 32-bit words, numbered alike by the host and the shaders.
//   words 0..15                        events (shaders/shared/layout.h)
//   then cells_x * cells_z words       landings on the soil plane, by cell of its map, x fastest
//   then two words a bin               landings on elements: [bin][upper, lower]
// An element has one bin for each layer it reaches into, starting with the lowest, so that landings are counted at their
// height. All copies of a shared mesh have as many bins as the one that needs most; the last ones may stay empty.

#include "physics/bvh/bvh.h"
#include "physics/canopy/canopy.h"
#include "physics/transport/model/model.h"
#include "physics/transport/model/scene_frame.h"
#include "shared/layout.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace sunfleck {

// Equal layers from the ground (scene y = 0) to the top of the highest element.
struct Layers {
  int count = 20;
  float base_y_m = 0.0F;   // local frame
  float per_metre = 0.0F;  // 0 if the canopy has no height: everything lands in layer 0
  double height_m = 0.0;   // of all layers together
};

struct CounterLayout {
  SceneBox box;
  Layers layers;
  glm::vec2 plot_lo_m{0.0F};  // the plot's rectangle in the local frame, x and z
  glm::vec2 plot_hi_m{0.0F};
  std::uint32_t cells_x = 0;  // 0 without a soil plane
  std::uint32_t cells_z = 0;
  std::uint32_t first_bin_word = 0;
  std::vector<std::uint32_t> first_bin;  // [element + 1]

  // Returns the end of the layers to which an element's bins belong, if the first one belongs to `first`.
  [[nodiscard]] std::size_t end_layer(std::size_t element, std::size_t first) const {
    return std::min<std::size_t>(first + first_bin[element + 1] - first_bin[element], static_cast<std::size_t>(layers.count));
  }
  [[nodiscard]] std::uint32_t words() const { return first_bin_word + 2 * first_bin.back(); }
  [[nodiscard]] std::uint32_t cells() const { return cells_x * cells_z; }
};

// Returns the layout of the counters. Throws Error (input) if there are too many for 32-bit numbering.
[[nodiscard]] CounterLayout make_counter_layout(const RadiationModel& model);

// Returns the ground in the form that tracers take.
[[nodiscard]] shared::GroundMap make_ground_map(const CounterLayout& layout);

// Returns the scene in the form that tracers take for packets.
[[nodiscard]] shared::PacketBlock make_packet_block(const RadiationModel& model, const CounterLayout& layout);

// Returns the layer that holds a height (local frame); heights outside all layers count in the nearest one.
[[nodiscard]] std::uint32_t layer_at(const Layers& layers, float y_m);

// Returns the layer of an element's first bin.
[[nodiscard]] std::uint32_t first_layer(const CounterLayout& layout, const Triangle& corners);

// Adds a triangle's one-sided area, m2, to the layers, split exactly as it lies in them. `area_by_layer_m2` is [layer].
void add_area_by_layer(const Layers& layers, const Triangle& corners, std::span<double> area_by_layer_m2);

// Writes into every reference of the tree where its element's landings are counted: the word of layer 0, if it had a bin. In a
// tree with copies, the word of the element's lowest layer is the sum of the counters of the triangle and of the copy.
void number_counters(const CounterLayout& layout, const Canopy& canopy, Bvh& bvh);

}  // namespace sunfleck
