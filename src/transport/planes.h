#pragma once
// Horizontal receivers: which of them a way passes, and in which cell. They stop no ray, and soil never shades them: what lands
// on soil has passed every plane above y = 0 and below it.

#include "transport/counters.h"
#include "transport/model.h"
#include "transport/result.h"
#include "transport/surfaces.h"

#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <span>
#include <vector>

namespace sunfleck {

// The planes cut space into zones: zone 0 below the lowest, which is also the soil's, zone k above k of them.
class PlaneReceivers {
 public:
  static constexpr std::size_t no_cell = std::numeric_limits<std::size_t>::max();

  // All must outlive it.
  PlaneReceivers(const RadiationModel& model, const CounterLayout& layout, const Surfaces& surfaces);

  [[nodiscard]] std::size_t size() const { return planes_.size(); }
  [[nodiscard]] std::size_t cells() const { return first_cell_.back(); }  // of all planes together
  [[nodiscard]] std::size_t first_cell(std::size_t plane) const { return first_cell_[plane]; }

  // The zone of a place that is not soil's (local frame). Landings are told apart exactly as layers tell them where a plane is
  // the edge of a layer.
  [[nodiscard]] std::int32_t zone_at(float y_m) const;
  // The same for a landing of any kind.
  [[nodiscard]] std::int32_t zone_of(const shared::Landing& landing) const;

  // No element reaches above the plane, so that light comes down through it unhindered.
  [[nodiscard]] bool above_all(std::size_t plane) const { return planes_[plane].y_m >= layout_.box.hi_m.y; }

  // Planes at the ground, of which all else but soil lies above.
  [[nodiscard]] bool at_ground(std::size_t plane) const { return planes_[plane].threshold_y_m == lowest; }

  // Cell, counted over all planes, where the line through a point crosses a plane; no_cell beside an isolated plot.
  [[nodiscard]] std::size_t cell_at(std::size_t plane, const glm::vec3& point_m, const glm::vec3& direction) const;

 private:
  static constexpr float lowest = -std::numeric_limits<float>::infinity();
  struct Plane {
    double y_m = 0.0;            // local frame
    float threshold_y_m = 0.0F;  // places from here on lie above it
  };

  const RadiationModel& model_;
  const CounterLayout& layout_;
  const Surfaces& surfaces_;
  std::vector<Plane> planes_;
  std::vector<std::size_t> first_cell_;  // [plane + 1]
};

// What passed the planes in one replicate.
struct PlaneSums {
  PlaneSums() = default;
  PlaneSums(const PlaneReceivers& planes, const RadiationModel& model);

  std::vector<std::uint32_t> reached, crossing;        // [cell], beam rays, as in PlaneResult
  std::vector<std::uint64_t> zone_landings;            // [(zone * optics + optics) * 2 + side], of beam rays
  std::vector<std::int64_t> down;                      // [cell * bands + band], quanta of packets and sky rays
  std::vector<std::int64_t> through_down, through_up;  // [plane * bands + band], the same over whole planes
};

// Adds what a straight way from one zone to another carries through the planes between them.
void pass_receivers(const PlaneReceivers& planes, const shared::Packet& way, std::int32_t from_zone, std::int32_t to_zone,
                    std::span<const std::int64_t> quanta, PlaneSums& sums);

// Adds up the replicates.
class PlaneTally {
 public:
  PlaneTally(const PlaneReceivers& planes, const RadiationModel& model);

  // `beam_w_m2_per_ray` and `w_m2_per_quantum` are [band], per area of the plot. Either of the sums may be absent.
  void add(const PlaneSums* beam, const PlaneSums* packets, std::span<const double> beam_w_m2_per_ray,
           std::span<const double> w_m2_per_quantum);

  // `quantile`: Student's, of the intervals. Where all replicates agree, those follow from `unseen_events` of statistics.h,
  // each a beam ray or as much light as `event_w_m2` tells, [band], W m-2 of plane in one replicate.
  [[nodiscard]] std::vector<PlaneResult> results(double quantile, double unseen_events,
                                                 std::span<const double> event_w_m2) const;

  // Hands every sum to `archive`; see tally_sums.cpp.
  template <class Self, class Archive>
  static void visit_sums(Self& self, Archive& archive) {
    for (auto& means : self.means_) {
      archive.visit(means.sunfleck);
      archive.visit(means.down);
    }
    archive.visit(self.reached_);
    archive.visit(self.crossing_);
    archive.visit(self.down_);
    archive.visit(self.through_down_);
  }

 private:
  struct Means {
    ReplicateMean sunfleck;
    std::vector<ReplicateMean> down;  // [band], W m-2 of plane
  };
  [[nodiscard]] std::vector<std::int64_t> closed_cells(std::size_t plane) const;

  const PlaneReceivers& planes_;
  const RadiationModel& model_;
  std::vector<Means> means_;                       // [plane]
  std::vector<std::uint64_t> reached_, crossing_;  // [cell]
  std::vector<std::int64_t> down_, through_down_;  // as in PlaneSums
};

}  // namespace sunfleck
