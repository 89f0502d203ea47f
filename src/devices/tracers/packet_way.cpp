#include "devices/tracers/packet_way.h"

namespace sunfleck {

PacketWay::PacketWay(const shared::PacketBlock& scene, TraceDomain domain, const shared::Packet& packet,
                     std::uint32_t crossings, Search& search)
    : PacketWay(scene, domain, packet, shared::make_ray(packet.origin, packet.direction), search) {
  crossings_ = crossings;
}

PacketWay::PacketWay(const shared::PacketBlock& scene, TraceDomain domain, const shared::Packet& packet,
                     const shared::Ray& along, Search& search)
    : scene_(&scene), domain_(domain) {
  search.ray = along;
  search.ray.origin = packet.origin;
  search.own = {packet.element, packet.image};
  down_ = search.ray.inverse.y < 0.0F;
  look_ahead(search);
}

void PacketWay::look_ahead(Search& search) {
  const shared::Ray& ray = search.ray;
  if (!domain_.periodic) {
    end_ = shared::meet_ground(ray, scene_->ground);
    over_plot_ = down_ && shared::falls_on_plot(ray, scene_->ground);
    search.limit = over_plot_ ? end_.limit : 1e30F;
    return;
  }
  end_ = down_ ? shared::meet_ground(ray, scene_->ground) : shared::meet_top(ray, scene_->top_y);
  crossing_ = shared::next_crossing(ray, scene_->period, scene_->overlap);
  over_plot_ = down_;
  search.limit = end_.limit < crossing_.limit ? end_.limit : crossing_.limit;
}

bool PacketWay::goes_on(const CpuHit& hit, Search& search) {
  if (hit.found) return land(landing_of(hit));
  if (!domain_.periodic || end_.t <= crossing_.t) {
    if (!over_plot_) return land({down_ ? shared::left_downwards : shared::left_upwards, 0, 0.0F, 0.0F});
    const glm::vec2 at = shared::ground_point(search.ray, end_.t);
    return land({domain_.has_soil ? shared::landed_on_ground : shared::left_downwards, 0, at.x, at.y});
  }
  if (++crossings_ > shared::max_crossings) return land({shared::lost_on_its_way, 0, 0.0F, 0.0F});
  search.ray.origin = shared::enter_next_period(search.ray, crossing_, scene_->period);
  search.own.image = shared::image_in_next_period(search.own.image, search.ray, crossing_.along_x);
  look_ahead(search);
  return true;
}

bool PacketWay::land(const shared::Landing& landing) {
  landing_ = landing;
  return false;
}

}  // namespace sunfleck
