#include "devices/tracers/beam_way.h"

#include <algorithm>

namespace sunfleck {

BeamWay::BeamWay(const shared::BeamBlock& beam, TraceDomain domain, const LandingCounter& landings, std::uint32_t ray,
                 const glm::vec3& origin, std::uint32_t crossings, Search& search)
    : beam_(&beam), domain_(domain), landings_(&landings), ray_(ray), crossings_(crossings) {
  search.ray = shared::make_ray(origin, beam.direction);
  search.own = {};
  look_ahead(search);
}

void BeamWay::look_ahead(Search& search) {
  ground_ = shared::meet_ground(search.ray, beam_->ground);
  if (!domain_.periodic) {
    over_plot_ = shared::falls_on_plot(search.ray, beam_->ground);
    search.limit = over_plot_ ? ground_.limit : 1e30F;
    return;
  }
  crossing_ = shared::next_crossing(search.ray, beam_->period, beam_->overlap);
  over_plot_ = ground_.t <= crossing_.t;
  search.limit = std::min(ground_.limit, crossing_.limit);
}

bool BeamWay::goes_on(const CpuHit& hit, Search& search) {
  if (hit.found) {
    landings_->count_element(ray_, hit);
  } else if (over_plot_) {
    landings_->count_ground(ray_, search.ray, ground_.t);
  } else if (!domain_.periodic) {
    landings_->count_missed(ray_);
  } else if (++crossings_ > shared::max_crossings) {
    landings_->count_lost(ray_);
  } else {
    search.ray.origin = shared::enter_next_period(search.ray, crossing_, beam_->period);
    look_ahead(search);
    return true;
  }
  return false;
}

}  // namespace sunfleck
