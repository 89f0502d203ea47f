#include "devices/tracers/packet_bundles.h"

#include "devices/tracers/bundle_walk.h"
#include "devices/tracers/packet_way.h"
#include "devices/tracers/walk_parts.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace sunfleck {
namespace {

// Bundles pay where the median distance between a packet and the next is at most that many sizes of a typical triangle, which is
// the square root of twice its area. The largest distance between a packet and the first of its bundle is given in multiples of
// either: multiples of 4 to 20 gaps take nearly as long, but the more triangles a bundle covers, the longer it takes.
constexpr float most_gap_in_sizes = 1.5F;
constexpr float widest_in_gaps = 8.0F;
constexpr float widest_in_sizes = 4.0F;

// Returns the median of some values, which it reorders; 0 if there are none.
float median(std::vector<float>& values) {
  if (values.empty()) return 0.0F;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// A packet that is still on its way, in the period that it has reached.
struct Going {
  Search search;
  std::uint32_t packet = 0;
};

class PacketBundles {
 public:
  PacketBundles(const Bvh& bvh, float widest_squared, std::span<shared::Landing> landings)
      : bvh_(bvh), widest_squared_(widest_squared), landings_(landings) {}

  void follow(const shared::PacketBlock& scene, TraceDomain domain, std::span<const shared::Packet> packets) {
    ways_.resize(packets.size());
    std::vector<Going> going(packets.size());
    const shared::Ray along = packets.empty() ? shared::Ray{} : shared::make_ray({}, packets.front().direction);
    for (std::uint32_t k = 0; k < packets.size(); ++k) {
      going[k].packet = k;
      ways_[k] = PacketWay(scene, domain, packets[k], along, going[k].search);
    }
    while (!going.empty()) {
      along_x_.clear();
      along_z_.clear();
      for (std::span<Going> left = going; !left.empty(); left = left.subspan(bundle_.rays)) {
        take_bundle(left);
        nearest_hits(bvh_, bundle_, hits_);
        for (std::uint32_t k = 0; k < bundle_.rays; ++k) land_or_go_on(left[k], hits_[k]);
      }
      going.swap(along_x_);
      going.insert(going.end(), along_z_.begin(), along_z_.end());
    }
  }

 private:
  void take_bundle(std::span<const Going> going) {
    bundle_.along = going.front().search.ray;
    bundle_.rays = 0;
    const auto near_first = [&](const Search& search) {
      return distance_squared(search.ray.origin - bundle_.along.origin, bundle_.along.direction) <= widest_squared_;
    };
    do {
      const Search& search = going[bundle_.rays].search;
      bundle_.origins[bundle_.rays] = search.ray.origin;
      bundle_.limits[bundle_.rays] = search.limit;
      bundle_.own[bundle_.rays] = search.own;
      ++bundle_.rays;
    } while (bundle_.rays < std::min<std::size_t>(going.size(), rays_per_bundle) && near_first(going[bundle_.rays].search));
  }

  void land_or_go_on(Going& going, const CpuHit& hit) {
    PacketWay& way = ways_[going.packet];
    const bool along_x = way.crosses_along_x();
    if (way.goes_on(hit, going.search)) {
      (along_x ? along_x_ : along_z_).push_back(going);
    } else {
      landings_[going.packet] = way.landing();
    }
  }

  const Bvh& bvh_;
  float widest_squared_;
  std::span<shared::Landing> landings_;
  std::vector<PacketWay> ways_;  // [packet]
  RayBundle bundle_;
  BundleHits hits_;
  std::vector<Going> along_x_, along_z_;  // by the border that they cross
};

}  // namespace

float triangle_size_squared(const Bvh& bvh) {
  constexpr std::size_t enough = 1024;
  const std::size_t step = std::max<std::size_t>(1, bvh.triangles.size() / enough);
  std::vector<float> sizes_squared;
  for (std::size_t k = 0; k < bvh.triangles.size(); k += step) {
    const BvhTriangle& triangle = bvh.triangles[k];
    const glm::vec3 a = walk_parts::corner(triangle.a);
    sizes_squared.push_back(glm::length(glm::cross(walk_parts::corner(triangle.b) - a, walk_parts::corner(triangle.c) - a)));
  }
  return median(sizes_squared);
}

bool have_one_direction(std::span<const shared::Packet> packets) {
  return std::all_of(packets.begin(), packets.end(),
                     [&](const shared::Packet& packet) { return packet.direction == packets.front().direction; });
}

bool trace_in_bundles(const Bvh& bvh, const shared::PacketBlock& scene, TraceDomain domain, float size_squared,
                      std::span<const shared::Packet> packets, std::span<shared::Landing> landings) {
  if (!have_one_direction(packets)) return false;
  constexpr std::size_t step = 5;  // one gap of five is enough; packets of an element often come in fours
  std::vector<float> gaps_squared;
  for (std::size_t k = 1; k < packets.size(); k += step)
    gaps_squared.push_back(distance_squared(packets[k].origin - packets[k - 1].origin, packets[k].direction));
  const float gap_squared = median(gaps_squared);
  if (!(gap_squared <= most_gap_in_sizes * most_gap_in_sizes * size_squared)) return false;
  const float widest_squared =
      std::min(widest_in_gaps * widest_in_gaps * gap_squared, widest_in_sizes * widest_in_sizes * size_squared);
  PacketBundles(bvh, widest_squared, landings).follow(scene, domain, packets);
  return true;
}

}  // namespace sunfleck
