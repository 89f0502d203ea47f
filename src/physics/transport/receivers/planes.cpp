#include "physics/transport/receivers/planes.h"

#include "shared/beam.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace sunfleck {
namespace {

// A plane this close to the edge of a layer, in units of layers, counts as lying on that edge.
constexpr double same_edge = 1e-5;

// Returns the lowest height that layer_at assigns to `layer` or to a layer above it: lower landings belong to lower layers.
float lowest_of_layer(const Layers& layers, std::uint32_t layer) {
  auto y_m = static_cast<float>(layers.base_y_m + layer / double{layers.per_metre});
  const auto next = [](float y, float towards) { return std::nextafter(y, towards); };
  while (layer_at(layers, y_m) >= layer) y_m = next(y_m, -std::numeric_limits<float>::infinity());
  while (layer_at(layers, y_m) < layer) y_m = next(y_m, std::numeric_limits<float>::infinity());
  return y_m;
}

float threshold(const Layers& layers, double ground_y_m, double height_m) {
  if (ground_y_m < layers.base_y_m && height_m <= 0.0) return static_cast<float>(layers.base_y_m + height_m);
  const double edge = height_m * double{layers.per_metre};
  const double nearest = std::round(edge);
  const bool is_edge = layers.per_metre > 0.0F && std::abs(edge - nearest) < same_edge;
  if (height_m <= 0.0 || (is_edge && nearest == 0.0)) return shared::below_everything;
  if (is_edge && nearest == layers.count) return shared::above_everything;
  if (is_edge && nearest < layers.count) return lowest_of_layer(layers, static_cast<std::uint32_t>(nearest));
  return static_cast<float>(layers.base_y_m + height_m);
}

}  // namespace

PlaneReceivers::PlaneReceivers(const RadiationModel& model, const CounterLayout& layout, const Surfaces& surfaces)
    : model_(model), layout_(layout), surfaces_(surfaces) {
  const glm::dvec2 size_m = glm::dvec2(layout.plot_hi_m) - glm::dvec2(layout.plot_lo_m);
  plot_ = {layout.plot_lo_m, glm::vec2(1.0 / size_m), model.plot.periodic ? 1U : 0U};
  for (const PlaneReceiver& plane : model.planes) {
    planes_.push_back({static_cast<float>(y_m(planes_.size())), threshold(layout.layers, layout.box.ground_y_m, plane.height_m),
                       static_cast<std::uint32_t>(cells_), static_cast<std::uint32_t>(plane.cells_x),
                       static_cast<std::uint32_t>(plane.cells_z)});
    cells_ += plane.cells();
  }
}

std::size_t PlaneReceivers::zone_at(float y_m) const {
  std::size_t zone = 0;
  for (const shared::ReceiverPlane& plane : planes_) zone += y_m >= plane.threshold_y ? 1 : 0;
  return zone;
}

std::size_t PlaneReceivers::zone_of_lamps() const {
  std::size_t zone = 0;
  while (zone < size() && at_ground(zone)) ++zone;
  return zone;
}

std::size_t PlaneReceivers::zone_of(const shared::Landing& landing) const {
  if (landing.surface == shared::left_upwards) return planes_.size();
  if (landing.surface >= shared::landed_on_ground) return 0;
  if (surfaces_.at(landing.surface / 2).soil()) return 0;
  const Triangle& corners = model_.canopy.corners[landing.surface / 2];
  return zone_at(shared::landing_y(corners[0].y, corners[1].y, corners[2].y, landing.place_a, landing.place_b));
}

PlaneSums::PlaneSums(const PlaneReceivers& planes, const RadiationModel& model)
    : PlaneSums(planes, model, model.bands.size()) {}

PlaneSums::PlaneSums(const PlaneReceivers& planes, const RadiationModel& model, std::size_t columns)
    : reached(planes.cells()),
      crossing(planes.cells()),
      zone_landings((planes.size() + 1) * model.optics.size()),
      down(planes.cells() * columns),
      through_down(planes.size() * columns),
      through_up(through_down.size()) {}

PlaneTally::PlaneTally(const PlaneReceivers& planes, const RadiationModel& model)
    : planes_(planes), model_(model), means_(planes.size()) {
  const PlaneSums none(planes, model);
  for (Means& means : means_) means.down.resize(model.bands.size());
  reached_.resize(none.reached.size());
  crossing_.resize(none.crossing.size());
  down_ = none.down;
  through_down_ = none.through_down;
}

void PlaneTally::add(const PlaneSums* beam, const PlaneSums* packets, std::span<const double> beam_w_m2_per_ray,
                     std::span<const double> w_m2_per_quantum) {
  const std::size_t bands = model_.bands.size();
  for (std::size_t p = 0; p < planes_.size(); ++p) {
    std::uint64_t reached = 0;
    std::uint64_t crossing = 0;
    std::vector<std::int64_t> down(bands);
    for (std::size_t cell = planes_.first_cell(p); cell < planes_.first_cell(p + 1); ++cell) {
      if (beam != nullptr) {
        reached_[cell] += beam->reached[cell];
        crossing_[cell] += beam->crossing[cell];
        reached += beam->reached[cell];
        crossing += beam->crossing[cell];
      }
      for (std::size_t b = 0; packets != nullptr && b < bands; ++b) {
        down_[cell * bands + b] += packets->down[cell * bands + b];
        down[b] += packets->down[cell * bands + b];
      }
    }
    means_[p].sunfleck.add(crossing > 0 ? static_cast<double>(reached) / static_cast<double>(crossing) : 0.0);
    for (std::size_t b = 0; b < bands; ++b) {
      if (packets != nullptr && model_.plot.periodic) down[b] = packets->through_down[p * bands + b];
      through_down_[p * bands + b] += down[b];
      means_[p].down[b].add(static_cast<double>(reached) * beam_w_m2_per_ray[b] +
                            static_cast<double>(down[b]) * w_m2_per_quantum[b]);
    }
  }
}

// Returns a plane's cells scaled to its exact total. Sampling moves flux between zones (see PlaneFlux); the total
// includes that flux, the cells do not. Each cell takes its share of the difference.
std::vector<std::int64_t> PlaneTally::closed_cells(std::size_t plane) const {
  const std::size_t bands = model_.bands.size();
  const std::size_t first = planes_.first_cell(plane);
  const std::size_t count = planes_.first_cell(plane + 1) - first;
  std::vector<std::int64_t> closed(count * bands);
  for (std::size_t b = 0; b < bands; ++b) {
    const std::int64_t total = through_down_[plane * bands + b];
    double weight = 0.0;
    for (std::size_t k = 0; k < count; ++k) weight += static_cast<double>(down_[(first + k) * bands + b]);
    double sum = 0.0;
    std::int64_t given = 0;
    for (std::size_t k = 0; k < count; ++k) {
      sum += weight > 0.0 ? static_cast<double>(down_[(first + k) * bands + b]) / weight : 1.0 / static_cast<double>(count);
      const auto share = static_cast<std::int64_t>(std::min(sum, 1.0) * static_cast<double>(total));
      const std::int64_t up_to =
          k + 1 == count ? total : std::clamp(share, std::min<std::int64_t>(total, 0), std::max<std::int64_t>(total, 0));
      closed[k * bands + b] = up_to - given;
      given = up_to;
    }
  }
  return closed;
}

std::vector<PlaneResult> PlaneTally::results(double quantile, double unseen_events, std::span<const double> event_w_m2,
                                             std::span<const double> unshot_w_m2) const {
  std::vector<PlaneResult> results;
  for (std::size_t p = 0; p < planes_.size(); ++p) {
    const PlaneReceiver& plane = model_.planes[p];
    PlaneResult result;
    result.height_m = plane.height_m;
    result.cells_x = static_cast<std::uint32_t>(plane.cells_x);
    result.cells_z = static_cast<std::uint32_t>(plane.cells_z);
    const auto part = [&](const auto& all) {
      const auto begin = all.begin() + static_cast<std::ptrdiff_t>(planes_.first_cell(p));
      return std::vector<std::uint64_t>(begin,
                                        begin + static_cast<std::ptrdiff_t>(planes_.first_cell(p + 1) - planes_.first_cell(p)));
    };
    result.reached = part(reached_);
    result.crossing = part(crossing_);
    result.down = closed_cells(p);
    const auto rays = static_cast<double>(std::accumulate(result.crossing.begin(), result.crossing.end(), std::uint64_t{0}));
    result.sunfleck_ratio = {std::numeric_limits<double>::quiet_NaN()};
    const double events = planes_.above_all(p) ? 0.0 : unseen_events;
    if (rays > 0.0) result.sunfleck_ratio = means_[p].sunfleck.estimate(quantile, events / rays);
    for (std::size_t b = 0; b < means_[p].down.size(); ++b) {
      const ReplicateMean& down = means_[p].down[b];
      Estimate total = down.estimate(quantile, events * event_w_m2[b] / static_cast<double>(down.count()));
      if (!planes_.above_all(p)) total.half_width += unshot_w_m2[b];
      result.total_down.push_back(total);
    }
    results.push_back(std::move(result));
  }
  return results;
}

}  // namespace sunfleck
