#include "devices/tracers/beam_bundles.h"

#include "devices/tracers/bundle_walk.h"
#include "shared/beam.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <span>
#include <utility>
#include <vector>

namespace sunfleck {
namespace {

// A ray at the place where it enters a period.
struct Start {
  glm::vec3 origin_m;
  std::uint32_t number = 0;  // of the ray
};
using Starts = std::vector<Start>;

// Largest distance between a ray and the first of its bundle, in cells of the beam's grid. A square of 4 x 4 cells needs six.
// Bundles of neighbours with gaps between them are wider; limits of 8 to 20 cells take equally long.
constexpr float widest_cells = 12.0F;
// Longest side of a cell with which bundles pay, in sizes of a typical triangle: with twice that, as in pilots on maize, they take
// up to twice the time of rays side by side; with half of it, half of that time.
constexpr float most_cell_in_sizes = 1.25F;

// Returns the square of the longer side of a cell of the grid, across the rays.
float cell_squared(const shared::BeamBlock& beam) {
  return std::max(distance_squared(beam.edge_u * beam.per_column, beam.direction),
                  distance_squared(beam.edge_v * beam.per_row, beam.direction));
}

// Where rays leave a period, or end on the ground.
struct Ways {
  std::array<shared::Ground, rays_per_bundle> ground;
  std::array<shared::Crossing, rays_per_bundle> crossing;  // in an endless canopy
  std::array<bool, rays_per_bundle> over_plot;             // in an isolated stand
};

class Batch {
 public:
  Batch(const Bvh& bvh, const shared::BeamBlock& beam, const LandingCounter& landings)
      : bvh_(bvh), beam_(beam), landings_(landings), widest_squared_(widest_cells * widest_cells * cell_squared(beam)) {
    bundle_.along = shared::make_ray({}, beam.direction);
  }

  void follow_in_isolated_stand(const Starts& starts) {
    for (std::span<const Start> left = starts; !left.empty(); left = left.subspan(bundle_.rays)) {
      take_bundle(left);
      look_around_stand();
      nearest_hits(bvh_, bundle_, hits_);
      for (std::uint32_t k = 0; k < bundle_.rays; ++k) land_in_isolated_stand(k);
    }
  }

  void follow_in_endless_canopy(Starts starts) {
    for (std::uint32_t crossings = 0; !starts.empty(); ++crossings) {
      along_x_.clear();
      along_z_.clear();
      for (std::span<const Start> left = starts; !left.empty(); left = left.subspan(bundle_.rays)) {
        take_bundle(left);
        look_ahead_in_period();
        nearest_hits(bvh_, bundle_, hits_);
        for (std::uint32_t k = 0; k < bundle_.rays; ++k) land_or_cross(k, crossings + 1);
      }
      starts.swap(along_x_);
      starts.insert(starts.end(), along_z_.begin(), along_z_.end());
    }
  }

 private:
  // Takes the first ray and those of the next that are near it.
  void take_bundle(std::span<const Start> starts) {
    const auto most = static_cast<std::uint32_t>(std::min<std::size_t>(starts.size(), rays_per_bundle));
    const auto near_first = [&](const Start& start) {
      return distance_squared(start.origin_m - starts.front().origin_m, bundle_.along.direction) <= widest_squared_;
    };
    bundle_.rays = 0;
    do {
      bundle_.origins[bundle_.rays] = starts[bundle_.rays].origin_m;
      ++bundle_.rays;
    } while (bundle_.rays < most && near_first(starts[bundle_.rays]));
    starts_ = starts;
  }

  [[nodiscard]] std::uint32_t number(std::uint32_t k) const { return starts_[k].number; }

  [[nodiscard]] shared::Ray ray(std::uint32_t k) const {
    shared::Ray result = bundle_.along;
    result.origin = bundle_.origins[k];
    return result;
  }

  void look_around_stand() {
    for (std::uint32_t k = 0; k < bundle_.rays; ++k) {
      ways_.ground[k] = shared::meet_ground(ray(k), beam_.ground);
      ways_.over_plot[k] = shared::falls_on_plot(ray(k), beam_.ground);
      bundle_.limits[k] = ways_.over_plot[k] ? ways_.ground[k].limit : 1e30F;
    }
  }

  void land_in_isolated_stand(std::uint32_t k) const {
    if (hits_[k].found) {
      landings_.count_element(number(k), hits_[k]);
    } else if (ways_.over_plot[k]) {
      landings_.count_ground(number(k), ray(k), ways_.ground[k].t);
    } else {
      landings_.count_missed(number(k));
    }
  }

  void look_ahead_in_period() {
    for (std::uint32_t k = 0; k < bundle_.rays; ++k) {
      ways_.ground[k] = shared::meet_ground(ray(k), beam_.ground);
      ways_.crossing[k] = shared::next_crossing(ray(k), beam_.period, beam_.overlap);
      bundle_.limits[k] = std::min(ways_.ground[k].limit, ways_.crossing[k].limit);
    }
  }

  void land_or_cross(std::uint32_t k, std::uint32_t crossings) {
    const shared::Crossing& crossing = ways_.crossing[k];
    if (hits_[k].found) {
      landings_.count_element(number(k), hits_[k]);
    } else if (ways_.ground[k].t <= crossing.t) {
      landings_.count_ground(number(k), ray(k), ways_.ground[k].t);
    } else if (crossings > shared::max_crossings) {
      landings_.count_lost(number(k));
    } else {
      Starts& going_on = crossing.along_x ? along_x_ : along_z_;
      going_on.push_back({shared::enter_next_period(ray(k), crossing, beam_.period), number(k)});
    }
  }

  const Bvh& bvh_;
  const shared::BeamBlock& beam_;
  const LandingCounter& landings_;
  float widest_squared_;
  RayBundle bundle_;
  BundleHits hits_;
  Ways ways_;
  std::span<const Start> starts_;  // the rays of the bundle, and more
  Starts along_x_, along_z_;       // rays that go on in the next period, by the border that they cross
};

}  // namespace

bool pays_in_bundles(const shared::BeamBlock& beam, float size_squared) {
  return cell_squared(beam) <= most_cell_in_sizes * most_cell_in_sizes * size_squared;
}

void count_in_bundles(const Bvh& bvh, TraceDomain domain, const shared::BeamBlock& beam, std::uint32_t first, std::uint32_t end,
                      const LandingCounter& landings) {
  Starts starts;
  starts.reserve(end - first);
  for (std::uint32_t ray = first; ray < end; ++ray) starts.push_back({shared::beam_origin(beam, ray), ray});
  Batch batch(bvh, beam, landings);
  if (domain.periodic) {
    batch.follow_in_endless_canopy(std::move(starts));
  } else {
    batch.follow_in_isolated_stand(starts);
  }
}

}  // namespace sunfleck
