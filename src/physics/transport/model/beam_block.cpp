#include "physics/transport/model/beam_block.h"

#include "base/check.h"
#include "base/random.h"
#include "physics/bvh/references.h"

namespace sunfleck {

BeamGrid make_grid(const RadiationModel& model, const CounterLayout& layout, double rays) {
  const glm::dvec3 to_sun = direction_to_sun(*model.sun);
  if (model.plot.periodic) return endless_beam_grid(model.canopy.period_m, layout.box.above_m(), to_sun, rays);
  const glm::dvec3 seen_hi_m(layout.box.hi_m.x, layout.box.seen_y_m, layout.box.hi_m.z);
  return isolated_beam_grid(layout.box.lo_m, seen_hi_m, to_sun, rays);
}

shared::BeamBlock make_beam_block(const RadiationModel& model, const CounterLayout& layout, double rays, std::uint64_t seed,
                                  std::uint64_t replicate) {
  EXPECT(model.has_beam(), ==, true);
  const BeamGrid grid = make_grid(model, layout, rays);
  const std::uint64_t key = RandomStream(seed, replicate).word();
  shared::BeamBlock beam;
  beam.corner = grid.corner_m;
  beam.edge_u = grid.edge_u_m;
  beam.edge_v = grid.edge_v_m;
  beam.per_column = 1.0F / static_cast<float>(grid.columns);
  beam.per_row = 1.0F / static_cast<float>(grid.rows);
  beam.columns = grid.columns;
  beam.rows = grid.rows;
  beam.direction = grid.direction;
  beam.key = {static_cast<std::uint32_t>(key), static_cast<std::uint32_t>(key >> 32U)};
  beam.period = model.canopy.period_m;
  beam.overlap = 0.5F * border_margin_m(model.canopy);
  beam.ground = make_ground_map(layout);
  beam.layer_base_y = layout.layers.base_y_m;
  beam.layers_per_metre = layout.layers.per_metre;
  beam.layers = static_cast<std::uint32_t>(layout.layers.count);
  return beam;
}

}  // namespace sunfleck
