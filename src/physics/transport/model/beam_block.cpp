#include "physics/transport/model/beam_block.h"

#include "base/check.h"
#include "base/random.h"
#include "physics/bvh/references.h"

namespace sunfleck {

namespace {

shared::BeamBlock block_of(const RadiationModel& model, const CounterLayout& layout, const BeamGrid& grid, std::uint64_t key) {
  shared::BeamBlock beam;
  beam.corner = grid.corner_m;
  beam.edge_u = grid.edge_u_m;
  beam.edge_v = grid.edge_v_m;
  beam.per_column = 1.0F / static_cast<float>(grid.columns);
  beam.per_row = 1.0F / static_cast<float>(grid.rows);
  beam.columns = grid.columns;
  beam.rows = grid.rows;
  beam.direction = grid.direction;
  beam.key = key_of(key);
  beam.period = model.canopy.period_m;
  beam.overlap = 0.5F * border_margin_m(model.canopy);
  beam.ground = make_ground_map(layout);
  beam.layer_base_y = layout.layers.base_y_m;
  beam.layers_per_metre = layout.layers.per_metre;
  beam.layers = static_cast<std::uint32_t>(layout.layers.count);
  return beam;
}

// Returns the box that beam rays must cover.
BeamBox seen_box(const CounterLayout& layout) {
  return {layout.box.lo_m, {layout.box.hi_m.x, layout.box.seen_y_m, layout.box.hi_m.z}};
}

}  // namespace

std::vector<WeightedBeamGrid> make_grids(const RadiationModel& model, const CounterLayout& layout, const StandAim* aim,
                                         double rays) {
  const glm::dvec3 to_sun = direction_to_sun(*model.sun);
  if (model.plot.periodic) return {{endless_beam_grid(model.canopy.period_m, layout.box.above_m(), to_sun, rays), 1}};
  if (aim == nullptr) return {{isolated_beam_grid(seen_box(layout), to_sun, rays), 1}};
  return aimed_beam_grids({aim->lo_m, aim->hi_m}, seen_box(layout), to_sun, rays);
}

shared::BeamBlock make_beam_block(const RadiationModel& model, const CounterLayout& layout, double rays, std::uint64_t seed,
                                  std::uint64_t replicate) {
  return make_beam_parts(model, layout, nullptr, rays, seed, replicate).front().block;
}

std::vector<BeamPart> make_beam_parts(const RadiationModel& model, const CounterLayout& layout, const StandAim* aim,
                                      double rays, std::uint64_t seed, std::uint64_t replicate) {
  EXPECT(model.has_beam(), ==, true);
  RandomStream keys(seed, replicate);
  std::vector<BeamPart> parts;
  for (const WeightedBeamGrid& part : make_grids(model, layout, aim, rays)) {
    parts.push_back({block_of(model, layout, part.grid, keys.word()), part.weight});
  }
  return parts;
}

}  // namespace sunfleck
