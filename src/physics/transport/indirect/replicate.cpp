#include "physics/transport/indirect/replicate.h"

#include "physics/transport/model/lights.h"

#include <span>
#include <utility>

namespace sunfleck {

namespace {

// Returns the columns of one light out of [place * columns + column].
std::vector<std::int64_t> of_light(const std::vector<std::int64_t>& joint, std::size_t light, std::size_t lights) {
  std::vector<std::int64_t> own(joint.size() / lights);
  for (std::size_t k = 0; k < own.size(); ++k) own[k] = joint[k * lights + light];
  return own;
}

// Deals sums by place to the lights. Places without quanta of a light are left out of its list.
template <class Member>
void deal(const PlaceSums& joint, Member member, std::vector<IndirectSums>& dealt) {
  const std::size_t lights = dealt.size();
  std::vector<std::int64_t> own(dealt.front().bands);
  joint.for_each([&](std::size_t place, std::span<const std::int64_t> quanta) {
    for (std::size_t k = 0; k < lights; ++k) {
      bool any = false;
      for (std::size_t b = 0; b < own.size(); ++b) {
        own[b] = quanta[column_of(b, k, lights)];
        any = any || own[b] != 0;
      }
      if (any) (dealt[k].*member).add(place, own);
    }
  });
}

// Returns the sums with all arrays that have columns, which `joint` then lacks.
IndirectSums take_arrays(IndirectSums& joint) {
  IndirectSums taken = std::exchange(joint, IndirectSums());
  joint.element_hits = taken.element_hits;
  joint.sky_rays = taken.sky_rays;
  joint.packets = taken.packets;
  joint.rounds = taken.rounds;
  joint.lost = taken.lost;
  joint.first_places = taken.first_places;
  joint.most_places = taken.most_places;
  joint.receivers.reached = taken.receivers.reached;
  joint.receivers.crossing = taken.receivers.crossing;
  joint.receivers.zone_landings = taken.receivers.zone_landings;
  return taken;
}

}  // namespace

IndirectSums::IndirectSums(const RadiationModel& model, const CounterLayout& layout, const Surfaces& surfaces,
                           std::size_t lights)
    : bands(model.bands.size() * lights),
      surface_landed(surfaces.of.size() * 2 * bands),
      layer_landed(static_cast<std::size_t>(layout.layers.count) * model.optics.size() * 2 * bands),
      side_landed(model.canopy.size() * 2, bands),
      cell_landed(layout.cells(), bands),
      down((static_cast<std::size_t>(layout.layers.count) + 1) * bands),
      up(down.size()),
      ledger(bands),
      sky_landed(bands),
      first_waiting(bands) {}

std::vector<IndirectSums> sums_by_light(IndirectSums joint, std::size_t lights, const PlaceMemory& memory) {
  std::vector<IndirectSums> dealt;
  if (lights == 1) {
    dealt.push_back(std::move(joint));
    return dealt;
  }
  const IndirectSums all = take_arrays(joint);
  joint.bands = all.bands / lights;
  dealt.assign(lights, joint);
  for (std::size_t k = 0; k < lights; ++k) {
    IndirectSums& own = dealt[k];
    for (const auto sums : IndirectSums::by_place) {
      const PlaceSums& of_all = all.*sums;
      if (of_all.size() > 0) own.*sums = PlaceSums(of_all.places(), own.bands, of_all.extent(), memory);
    }
    own.surface_landed = of_light(all.surface_landed, k, lights);
    own.layer_landed = of_light(all.layer_landed, k, lights);
    own.down = of_light(all.down, k, lights);
    own.up = of_light(all.up, k, lights);
    own.sky_landed = of_light(all.sky_landed, k, lights);
    own.first_waiting = of_light(all.first_waiting, k, lights);
    own.receivers.down = of_light(all.receivers.down, k, lights);
    own.receivers.through_down = of_light(all.receivers.through_down, k, lights);
    own.receivers.through_up = of_light(all.receivers.through_up, k, lights);
    for (std::size_t b = 0; b < own.bands; ++b) own.ledger.push_back(all.ledger[column_of(b, k, lights)]);
  }
  for (const auto sums : IndirectSums::by_place) deal(all.*sums, sums, dealt);
  return dealt;
}

}  // namespace sunfleck
