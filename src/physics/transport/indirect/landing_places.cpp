#include "physics/transport/indirect/landing_places.h"

#include "base/in_blocks.h"
#include "base/prefetch.h"
#include "physics/transport/indirect/scattering.h"
#include "shared/beam.h"

namespace sunfleck {

EmissionPoint place_of(const IndirectScene& scene, const shared::Landing& landing) {
  EmissionPoint place{landing.surface, landing.triangle, landing.place_a, landing.place_b, -1, 0, 0};
  if (landing.surface < shared::landed_on_ground) {
    const std::uint32_t element = landing.surface / 2;
    place.face = face_of(scene.model.canopy.optics_of[element], landing.surface % 2);
    if (scene.surfaces.at(element).soil()) return place;
    const Triangle& corners = scene.model.canopy.corners[element];
    const float y_m = shared::landing_y(corners[0].y, corners[1].y, corners[2].y, landing.place_a, landing.place_b);
    place.level = static_cast<int>(layer_at(scene.layout.layers, y_m));
  } else if (landing.surface == shared::landed_on_ground) {
    place.order = ground_order + shared::soil_cell(scene.block.ground, {landing.place_a, landing.place_b});
    place.face = soil_face(scene.model);
  } else if (landing.surface == shared::left_upwards) {
    place.level = scene.layout.layers.count;
  }
  return place;
}

void prefetch_place_of(const IndirectScene& scene, const shared::Landing& landing) {
  if (landing.surface >= shared::landed_on_ground) return;
  const std::uint32_t element = landing.surface / 2;
  scene.model.canopy.corners.prefetch(element);
  prefetch(scene.model.canopy.optics_of[element]);
  prefetch(scene.surfaces.number_of[element]);
}

void find_places(const IndirectScene& scene, std::span<const shared::Landing> landings, std::span<EmissionPoint> places) {
  constexpr std::size_t block_size = 4096;
  each_in_blocks(
      landings.size(), block_size, [&](std::size_t k) { prefetch_place_of(scene, landings[k]); },
      [&](std::size_t k) { places[k] = place_of(scene, landings[k]); });
}

}  // namespace sunfleck
