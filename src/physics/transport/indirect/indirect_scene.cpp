#include "physics/transport/indirect/indirect_scene.h"

#include <atomic>
#include <cmath>

namespace sunfleck {
namespace {

std::uint64_t next_number() {
  static std::atomic<std::uint64_t> scenes = 0;
  return ++scenes;
}

}  // namespace

IndirectScene::IndirectScene(Lights of_lights, const CounterLayout& of_layout, const Surfaces& of_surfaces, Tracer& by_tracer,
                             const PlaneReceivers* plane_receivers)
    : lights(of_lights),
      model(of_lights.front()),
      layout(of_layout),
      surfaces(of_surfaces),
      tracer(by_tracer),
      receivers(plane_receivers),
      block(make_packet_block(model, of_layout)),
      frame{static_cast<float>(std::ldexp(of_layout.box.extent_m(), -17)), block.ground.y},
      number(next_number()) {}

}  // namespace sunfleck
