#pragma once
// What waits before the first round of an indirect pass: the flux that sky rays and beams leave where they land, and that of
// lamps.
//
// Beam rays were traced and booked by the direct pass, so that all the flux they leave is known; packets carry it away from a
// sample of their landings (landing_points.h). Random numbers of sky rays and of sampled points are functions of the key and of
// their number, in round 0: sky rays come first.

#include "base/random.h"
#include "physics/transport/indirect/indirect_scene.h"
#include "physics/transport/indirect/packet_books.h"
#include "physics/transport/indirect/pass_arrays.h"
#include "physics/transport/model/tracer.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace sunfleck {

class FirstFlux {
 public:
  // All arguments must outlive it. The flux is booked in `books`, and its places are added to arrays.next.
  FirstFlux(const IndirectScene& scene, const LightFromAbove& light, glm::uvec2 key, PacketBooks& books, PassArrays& arrays);

  // Sends about this number of sky rays, if there is a sky, each with its share of the skies' flux; what they leave then waits.
  // Nothing else may wait yet. Returns false if stopped.
  [[nodiscard]] bool let_sky_in(std::size_t rays, RandomStream& random, const StopQuestion& stop);

  // Adds the flux that the lamps emit; its packets start anywhere on them.
  void add_lamps();

  // Books the flux left by all beam rays, which waits at levels and in zones that are known; returns it. [column]
  [[nodiscard]] std::vector<std::int64_t> add_landings();

  // Adds the sampled points, of which packets are to carry that flux.
  void add_points(const LandingPoints& points, std::span<const std::int64_t> scattered);

  // Returns the flux that met something, lamps included. [column]
  [[nodiscard]] const std::vector<std::int64_t>& incident() const { return incident_; }
  // Returns FirstLandings::least_of_vegetation of a column, cut off far above all that a replicate has.
  [[nodiscard]] std::int64_t least_of_vegetation(std::size_t column) const;

 private:
  [[nodiscard]] std::size_t band(std::size_t column) const { return column / lights_; }
  [[nodiscard]] const FirstLandings& first(std::size_t column) const { return light_.first[column % lights_]; }

  [[nodiscard]] std::uint32_t random_bits(std::size_t number) const;
  void share_out(const SkyRays& sky, std::span<const shared::Packet> rays, std::span<const shared::Landing> landings);
  void add_equal_points(std::span<const EmissionPoint> points, std::span<const std::int64_t> scattered);
  void add_weighted_points(const LandingPoints& points, std::span<const std::int64_t> scattered);
  template <class Take>
  void for_each_landing(const LandingPoints& points, const Take& take) const;

  const IndirectScene& scene_;
  const LightFromAbove& light_;
  glm::uvec2 key_;
  PacketBooks& books_;
  PassArrays& arrays_;
  std::size_t lights_, bands_, columns_;
  std::vector<const BandQuanta*> quanta_;  // [column]
  std::vector<std::int64_t> incident_;     // [column]
};

}  // namespace sunfleck
