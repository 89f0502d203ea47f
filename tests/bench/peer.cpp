#include "bench/peer.h"

#include "shared/beam.h"
#include "support/embree.h"

#include <fmt/format.h>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_reduce.h>

#include <algorithm>
#include <functional>

namespace sunfleck::bench {
namespace {

constexpr std::size_t packets_per_task = 256;
constexpr unsigned lanes = 8;

// How far a ray looks in its current period, and whether it ends there.
struct Leg {
  float limit = 0.0F;
  bool last = false;
  shared::Crossing crossing{};
};

Leg leg_of(const shared::PacketBlock& scene, bool endless, const shared::Ray& ray) {
  const bool down = ray.inverse.y < 0.0F;
  if (!endless) {
    const shared::Ground ground = shared::meet_ground(ray, scene.ground);
    const bool over_plot = down && shared::falls_on_plot(ray, scene.ground);
    return {over_plot ? ground.limit : 1e30F, true, {}};
  }
  const shared::Ground end = down ? shared::meet_ground(ray, scene.ground) : shared::meet_top(ray, scene.top_y);
  const shared::Crossing crossing = shared::next_crossing(ray, scene.period, scene.overlap);
  return {std::min(end.limit, crossing.limit), end.t <= crossing.t, crossing};
}

// Returns the sum of `count` over the packets of all tasks.
template <class Count>
std::uint64_t sum_over(std::span<const shared::Packet> packets, const Count& count) {
  return tbb::parallel_reduce(
      tbb::blocked_range<std::size_t>(0, packets.size(), packets_per_task), std::uint64_t{0},
      [&](const auto& range, std::uint64_t sum) { return sum + count(packets.subspan(range.begin(), range.size())); },
      std::plus<>());
}

// Follows eight rays side by side. A lane whose ray has ended sleeps.
class Eight {
 public:
  Eight(const shared::PacketBlock& scene, bool endless, std::span<const shared::Packet> packets)
      : scene_(scene), endless_(endless) {
    for (unsigned lane = 0; lane < packets.size(); ++lane) {
      ray_[lane] = shared::make_ray(packets[lane].origin, packets[lane].direction);
      awake_[lane] = -1;
    }
  }

  std::uint64_t follow(RTCScene tree) {
    std::uint64_t met = 0;
    while (std::any_of(std::begin(awake_), std::end(awake_), [](int lane) { return lane != 0; })) {
      for (unsigned lane = 0; lane < lanes; ++lane) set_out(lane);
      RTCIntersectContext context;
      rtcInitIntersectContext(&context);
      rtcIntersect8(awake_, tree, &context, &query_);
      for (unsigned lane = 0; lane < lanes; ++lane) met += arrive(lane) ? 1 : 0;
    }
    return met;
  }

 private:
  void set_out(unsigned lane) {
    if (awake_[lane] == 0) return;
    leg_[lane] = leg_of(scene_, endless_, ray_[lane]);
    RTCRay8& to = query_.ray;
    to.org_x[lane] = ray_[lane].origin.x;
    to.org_y[lane] = ray_[lane].origin.y;
    to.org_z[lane] = ray_[lane].origin.z;
    to.dir_x[lane] = ray_[lane].direction.x;
    to.dir_y[lane] = ray_[lane].direction.y;
    to.dir_z[lane] = ray_[lane].direction.z;
    to.tfar[lane] = leg_[lane].limit;
    to.mask[lane] = ~0U;
    query_.hit.geomID[lane] = RTC_INVALID_GEOMETRY_ID;
  }

  bool arrive(unsigned lane) {
    if (awake_[lane] == 0) return false;
    const bool met = query_.hit.geomID[lane] != RTC_INVALID_GEOMETRY_ID;
    if (met || leg_[lane].last) {
      awake_[lane] = 0;
    } else {
      ray_[lane].origin = shared::enter_next_period(ray_[lane], leg_[lane].crossing, scene_.period);
    }
    return met;
  }

  const shared::PacketBlock& scene_;
  bool endless_;
  RTCRayHit8 query_{};
  shared::Ray ray_[lanes];
  Leg leg_[lanes];
  alignas(32) int awake_[lanes] = {};
};

}  // namespace

Peer::Peer(const Stand& stand, int threads)
    : stand_(stand),
      device_(rtcNewDevice(threads > 0 ? fmt::format("threads={}", threads).c_str() : nullptr)),
      scene_(rtcNewScene(device_)) {
  test::attach_references(device_, scene_, stand.prepared.bvh);
}

Peer::~Peer() {
  rtcReleaseScene(scene_);
  rtcReleaseDevice(device_);
}

std::uint64_t Peer::follow_each(const shared::PacketBlock& scene, std::span<const shared::Packet> packets) const {
  const bool endless = stand_.model.plot.periodic;
  return sum_over(packets, [&](std::span<const shared::Packet> task) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    std::uint64_t met = 0;
    for (const shared::Packet& packet : task) {
      shared::Ray ray = shared::make_ray(packet.origin, packet.direction);
      while (true) {
        const Leg leg = leg_of(scene, endless, ray);
        RTCRayHit query{test::ray_of(ray, leg.limit), {}};
        query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        rtcIntersect1(scene_, &context, &query);
        const bool hit = query.hit.geomID != RTC_INVALID_GEOMETRY_ID;
        met += hit ? 1 : 0;
        if (hit || leg.last) break;
        ray.origin = shared::enter_next_period(ray, leg.crossing, scene.period);
      }
    }
    return met;
  });
}

std::uint64_t Peer::follow_eight(const shared::PacketBlock& scene, std::span<const shared::Packet> packets) const {
  const bool endless = stand_.model.plot.periodic;
  return sum_over(packets, [&](std::span<const shared::Packet> task) {
    std::uint64_t met = 0;
    for (std::size_t first = 0; first < task.size(); first += lanes) {
      met += Eight(scene, endless, task.subspan(first, std::min<std::size_t>(lanes, task.size() - first))).follow(scene_);
    }
    return met;
  });
}

}  // namespace sunfleck::bench
