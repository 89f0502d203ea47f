#pragma once
// Flux waiting to be shot: where it waits, how packets are drawn from it, and how the packets start.

#include "base/large_pages.h"
#include "base/random.h"
#include "physics/canopy/canopy.h"
#include "physics/transport/model/columns.h"
#include "shared/layout.h"

#include <algorithm>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace sunfleck {

// A point on a side of an element, or on the ground, from which light leaves.
struct EmissionPoint {
  std::uint32_t surface = 0;  // 2 * element + side, or shared::landed_on_ground
  std::uint32_t order = 0;    // candidates are drawn in this order: the tree's leaf order, then the ground
  float a = 0.0F;             // barycentric weight of corner b; x on the ground
  float b = 0.0F;             // barycentric weight of corner c; z on the ground
  std::int32_t level = 0;     // layer of the place; -1 for soil
};

// Returns the array index of a level; the soil's level has index 0.
[[nodiscard]] constexpr std::size_t level_index(std::int32_t level) {
  return static_cast<std::size_t>(std::int64_t{level} + 1);
}

// Value of EmissionPoint::a that stands for a point chosen uniformly on the element: packets of lamps start there.
inline constexpr float anywhere = -1.0F;

// Arrays that sorting needs, kept from one sort to the next.
struct SortSpace {
  LargeVector<std::uint64_t> from, to;
};

// Places with quanta in several columns: the bands of one light or of several (physics/transport/model/lights.h).
class Candidates {
 public:
  explicit Candidates(std::size_t columns) : columns_(columns), totals_(columns) {}

  // Adds a place with its quanta, [column]. A place without quanta is dropped.
  void add(const EmissionPoint& place, std::span<const std::int64_t> quanta);
  void clear();
  void reserve(std::size_t candidates);
  // Replaces these candidates by those of `other`, sorted by `order`, upper sides before lower ones. Places of equal order keep the
  // order in which they were added. `other` must be cleared before it is used again.
  void take_sorted(Candidates& other, SortSpace& space);

  [[nodiscard]] std::size_t size() const { return places_.size(); }
  [[nodiscard]] const EmissionPoint& place(std::size_t candidate) const { return places_[candidate]; }
  [[nodiscard]] std::span<const std::int64_t> quanta(std::size_t candidate) const {
    const std::size_t row = row_of_.empty() ? candidate : row_of_[candidate];
    return std::span(quanta_).subspan(row * columns_, columns_);
  }
  // Returns the quanta of all places together, [column].
  [[nodiscard]] const std::vector<std::int64_t>& totals() const { return totals_; }
  // Removes all quanta of some columns. [column]
  void retire(const std::vector<bool>& columns);

 private:
  std::size_t columns_;
  LargeVector<EmissionPoint> places_;  // [candidate]
  LargeVector<std::int64_t> quanta_;   // [row * columns + column]
  std::vector<std::uint32_t> row_of_;  // [candidate]; empty if each has the row of its number
  std::vector<std::int64_t> totals_;   // [column]
};

// Packets drawn from candidates.
struct Draw {
  std::vector<std::uint32_t> candidate;  // [packet], ascending
  std::vector<bool> kept;                // [column]; true if no packet carries it: its flux then stays with the candidates
  SharedOut shared;                      // the flux that they share out
};

// Draws packets by systematic sampling with one random offset: a candidate is drawn expected[candidate] times on average,
// rounded down or up. A packet carries its candidate's quanta divided by that expectation; each column is then scaled so that
// all packets together carry exactly its total. (Scaling level by level would be biased, since it would be a ratio of a few
// packets each.)
// The arrays of `draw` are filled anew.
void draw_packets(const Candidates& candidates, std::span<const double> expected, RandomStream& random, Draw& draw);

// Sets `own` to the quanta that a packet carries, [column]. To be called once for each packet in turn.
void share_out(const Candidates& candidates, std::span<const double> expected, std::size_t packet, Draw& draw,
               std::span<std::int64_t> own);

// How far the origin of a packet lies from its surface, and the height of the ground.
struct EmissionFrame {
  double offset_m = 0.0;  // distance of the origin in front of the surface
  double ground_y_m = 0.0;
};

// Returns a packet without direction that starts at a place, and the normal of the side there. `b` and `c` are the barycentric
// weights of the corners on an element.
struct PacketStart {
  shared::Packet packet;
  glm::dvec3 normal{0.0, 1.0, 0.0};
};
[[nodiscard]] PacketStart start_at(const Canopy& canopy, const EmissionPoint& place, double b, double c,
                                   const EmissionFrame& frame);

// Starts the drawn packets of a round with their origins and cosine-distributed directions. The directions of all packets of a round
// form one additive sequence with a random start (based on the plastic number, as in canopy_view.h), so that neighbours in
// the drawing order complement each other.
class PacketStarts {
 public:
  // Draws four random numbers. All other arguments must outlive the starts.
  PacketStarts(const Canopy& canopy, const Candidates& candidates, const Draw& draw, const EmissionFrame& frame,
               RandomStream& random);

  // Writes the packets that begin with number `first`.
  void write(std::size_t first, std::span<shared::Packet> packets) const;

 private:
  const Canopy& canopy_;
  const Candidates& candidates_;
  const Draw& draw_;
  const EmissionFrame& frame_;
  double direction_u_, direction_v_, place_u_, place_v_;
};

}  // namespace sunfleck
