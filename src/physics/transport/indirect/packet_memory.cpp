#include "physics/transport/indirect/packet_memory.h"

#include "physics/transport/indirect/pass_arrays.h"

#include <algorithm>

namespace sunfleck {
namespace {

constexpr double ray_bytes = sizeof(shared::Packet) + sizeof(shared::Landing);

double lamp_count(const RadiationModel& model) {
  const auto shines = [&](std::uint16_t optics) { return model.optics[optics].shines(); };
  return static_cast<double>(std::count_if(model.canopy.optics_of.begin(), model.canopy.optics_of.end(), shines));
}

// Returns the number of first landings. The indirect pass takes a sample of the beam's landings, at most one for each
// packet.
double first_landings(const RayCounts& counts) {
  return std::min(counts.packets, counts.beam_rays) + counts.sky_rays;
}

}  // namespace

PacketMemory::PacketMemory(const RadiationModel& model, std::size_t lights)
    : columns_(model.bands.size() * lights), lights_(lights), lamps_(lamp_count(model)), per_landing_(lights > 1 ? 2.0 : 1.0) {}

void PacketMemory::learn(const RayCounts& counts, const IndirectSums& sums) {
  const double landings = first_landings(counts);
  const double left = std::max(0.0, static_cast<double>(sums.first_places) - lamps_);
  const double per_landing = landings > 0.0 ? left / landings : 0.0;
  const double per_packet = counts.packets > 0.0 ? static_cast<double>(sums.most_places) / counts.packets : 0.0;
  per_landing_ = learned_ ? std::max(per_landing_, per_landing) : per_landing;
  per_packet_ = learned_ ? std::max(per_packet_, per_packet) : per_packet;
  if (counts.packets > 0.0) {
    // The sums of several lights are dealt to them from joint ones.
    const std::size_t copies = lights_ == 1 ? 1 : 2 * lights_;
    const auto raise = [&](double& per_packet_bytes, const PlaceSums& landed, const PlaceSums& sky) {
      const auto bytes = static_cast<double>(copies * (landed.bytes() + sky.bytes()));
      per_packet_bytes = std::max(per_packet_bytes, bytes / counts.packets);
    };
    raise(per_packet_bytes_.sides, sums.side_landed, sums.side_sky);
    raise(per_packet_bytes_.cells, sums.cell_landed, sums.cell_sky);
  }
  learned_ = true;
}

PlaceBytes PacketMemory::place_bytes(const RayCounts& counts, const PlaceBytes& most) const {
  return learned_ ? PlaceSums::likely_bytes(per_packet_bytes_.times(counts.packets), most) : most;
}

// The arrays of a pass stay for the next one (PassArrays), so that all of them count, each with its peak: those of places in
// the round with most of them.
double PacketMemory::bytes(const RayCounts& counts) const {
  const auto columns = static_cast<double>(columns_);
  const double place_bytes = 2.0 * (sizeof(EmissionPoint) + columns * sizeof(std::int64_t)) + 2.0 * sizeof(std::uint64_t);
  const double first = lamps_ + per_landing_ * first_landings(counts);
  const double places = std::max(first, per_packet_ * counts.packets) * place_bytes;
  const double draws = counts.packets * (sizeof(std::uint32_t) + columns * sizeof(std::uint32_t));
  const double point_bytes = sizeof(EmissionPoint) + static_cast<double>(lights_) * sizeof(double);
  const double points = std::min(counts.packets, counts.beam_rays) * point_bytes;
  const double rays = std::min(counts.packets, static_cast<double>(most_at_a_time)) * ray_bytes;
  return places + draws + points + rays + counts.sky_rays * ray_bytes;
}

}  // namespace sunfleck
