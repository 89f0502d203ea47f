#pragma once
// Horizontal receivers: which of them a ray passes, and in which cell. They do not stop any ray, and soil never shades them:
// flux that lands on soil has passed every plane between its start and y = 0.

#include "physics/transport/model/counters.h"
#include "physics/transport/model/model.h"
#include "physics/transport/model/result.h"
#include "physics/transport/model/surfaces.h"
#include "shared/planes.h"

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace sunfleck {

// The planes cut space into zones: zone 0 lies below the lowest plane and includes the soil, zone k lies above k planes.
class PlaneReceivers {
 public:
  // All arguments must outlive the receivers.
  PlaneReceivers(const RadiationModel& model, const CounterLayout& layout, const Surfaces& surfaces);

  [[nodiscard]] std::size_t size() const { return planes_.size(); }
  [[nodiscard]] std::size_t cells() const { return cells_; }  // of all planes together
  // Returns the number of a plane's first cell; that of the last plane's end for size().
  [[nodiscard]] std::size_t first_cell(std::size_t plane) const { return plane < size() ? planes_[plane].first_cell : cells_; }

  // Returns the zone of a place that is not on soil (local frame). Where a plane is the edge of a layer, landings are
  // assigned to zones exactly as they are to layers.
  [[nodiscard]] std::size_t zone_at(float y_m) const;
  // Returns the zone of any landing.
  [[nodiscard]] std::size_t zone_of(const shared::Landing& landing) const;

  // Returns true if no element reaches above the plane, so that light comes down through it unhindered.
  [[nodiscard]] bool above_all(std::size_t plane) const { return y_m(plane) >= layout_.box.hi_m.y; }

  // Returns true for a plane at the ground, which lies below everything but soil.
  [[nodiscard]] bool at_ground(std::size_t plane) const { return planes_[plane].threshold_y == shared::below_everything; }

  // Returns the lowest zone that does not end at the ground: what leaves lamps waits there.
  [[nodiscard]] std::size_t zone_of_lamps() const;

  // Returns the cell where the line through a point crosses a plane (shared::cell_at).
  [[nodiscard]] std::uint32_t cell_at(std::size_t plane, const glm::vec3& point_m, const glm::vec3& direction) const {
    return shared::cell_at(planes_[plane], plot_, point_m, direction);
  }

  // Return the planes and their plot in the form that devices take.
  [[nodiscard]] std::span<const shared::ReceiverPlane> planes() const { return planes_; }
  [[nodiscard]] const shared::ReceiverPlot& plot() const { return plot_; }

 private:
  [[nodiscard]] double y_m(std::size_t plane) const { return layout_.layers.base_y_m + model_.planes[plane].height_m; }

  const RadiationModel& model_;
  const CounterLayout& layout_;
  const Surfaces& surfaces_;
  std::vector<shared::ReceiverPlane> planes_;
  shared::ReceiverPlot plot_;
  std::size_t cells_ = 0;
};

// Sums over everything that passed the planes in one replicate.
struct PlaneSums {
  PlaneSums() = default;
  // Packets carry `columns` quanta, by default one for each band.
  PlaneSums(const PlaneReceivers& planes, const RadiationModel& model);
  PlaneSums(const PlaneReceivers& planes, const RadiationModel& model, std::size_t columns);

  // Passes every sum to `archive`.
  template <class Self, class Archive>
  static void visit(Self& self, Archive& archive) {
    archive(self.reached, self.crossing, self.zone_landings, self.down, self.through_down, self.through_up);
  }

  std::vector<std::uint32_t> reached, crossing;        // [cell], beam rays, as in PlaneResult
  std::vector<BeamLandings> zone_landings;             // [zone * optics + optics]
  std::vector<std::int64_t> down;                      // [cell * columns + column], quanta of packets and sky rays
  std::vector<std::int64_t> through_down, through_up;  // [plane * columns + column], the same summed over whole planes
};

// Sums over all replicates.
class PlaneTally {
 public:
  PlaneTally(const PlaneReceivers& planes, const RadiationModel& model);

  // Adds one replicate. `beam_w_m2_per_ray` and `w_m2_per_quantum` are [band], per area of the plot. Either of the sums
  // may be null.
  void add(const PlaneSums* beam, const PlaneSums* packets, std::span<const double> beam_w_m2_per_ray,
           std::span<const double> w_m2_per_quantum);

  // Returns the maps of all planes. `quantile` is Student's, for the confidence intervals. Where all replicates agree, the
  // intervals follow from `unseen_events` of statistics.h, each event being a beam ray or the light that `event_w_m2`
  // gives, [band], W m-2 of plane in one replicate. `unshot_w_m2` is what unshot flux would still bring through a plane, [band].
  [[nodiscard]] std::vector<PlaneResult> results(double quantile, double unseen_events, std::span<const double> event_w_m2,
                                                 std::span<const double> unshot_w_m2) const;

  [[nodiscard]] std::size_t planes() const { return means_.size(); }
  // Returns the light through a plane downwards in one band, W m-2.
  [[nodiscard]] const ReplicateMean& down(std::size_t plane, std::size_t band) const { return means_[plane].down[band]; }

  // Passes every sum to `archive`; see RunSums::visit.
  template <class Self, class Archive>
  static void visit(Self& self, Archive& archive) {
    for (auto& means : self.means_) archive(means.sunfleck, means.down);
    archive(self.reached_, self.crossing_, self.down_, self.through_down_);
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
