#include "physics/transport/model/counters.h"

#include "base/error.h"
#include "physics/bvh/references.h"
#include "shared/beam.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

namespace sunfleck {
namespace {

Layers make_layers(const RadiationModel& model) {
  Layers layers;
  layers.count = model.layers;
  layers.base_y_m = static_cast<float>(-model.canopy.origin_m.y);
  if (model.canopy.size() == 0) return layers;
  layers.height_m = std::max(0.0, double{bounds(model.canopy).hi.y} + model.canopy.origin_m.y);
  if (layers.height_m > 0.0) layers.per_metre = static_cast<float>(layers.count / layers.height_m);
  return layers;
}

std::uint32_t cells_along(double length_m, double patch_m) {
  return static_cast<std::uint32_t>(std::max(1.0, std::round(length_m / patch_m)));
}

// Returns the share of a triangle's area below height y. The corners' heights must be in ascending order and not all equal.
double area_share_below(const std::array<double, 3>& heights, double y) {
  const auto [lowest, middle, highest] = heights;
  if (y <= lowest) return 0.0;
  if (y >= highest) return 1.0;
  if (y < middle) return (y - lowest) * (y - lowest) / ((middle - lowest) * (highest - lowest));
  return 1.0 - (highest - y) * (highest - y) / ((highest - middle) * (highest - lowest));
}

std::uint32_t layers_reached(const CounterLayout& layout, const Triangle& corners) {
  const float top_m = std::max({corners[0].y, corners[1].y, corners[2].y});
  return layer_at(layout.layers, top_m) - first_layer(layout, corners) + 1;
}

// Returns the number of bins of each triangle of a shared mesh: enough for all its copies. [mesh][triangle]
std::vector<std::vector<std::uint32_t>> bins_of_meshes(const ElementCorners& corners, const CounterLayout& layout) {
  std::vector<std::vector<std::uint32_t>> bins;
  for (const SharedMesh& mesh : corners.meshes()) bins.emplace_back(mesh.corners.size(), 1U);
  for (const MeshCopy& copy : corners.copies()) {
    std::vector<std::uint32_t>& of_mesh = bins[copy.mesh];
    for (std::size_t t = 0; t < of_mesh.size(); ++t) {
      of_mesh[t] = std::max(of_mesh[t], layers_reached(layout, corners[copy.first_element + t]));
    }
  }
  return bins;
}

// Fills layout.first_bin except for its end; returns the number of bins.
std::uint64_t number_bins(const Canopy& canopy, CounterLayout& layout) {
  layout.first_bin.reserve(canopy.size() + 1);
  std::uint64_t bins = 0;
  const auto add = [&](std::uint64_t more) {
    layout.first_bin.push_back(static_cast<std::uint32_t>(bins));
    bins += more;
  };
  const std::vector<std::vector<std::uint32_t>> of_mesh = bins_of_meshes(canopy.corners, layout);
  for (const MeshCopy& copy : canopy.corners.copies()) {
    while (layout.first_bin.size() < copy.first_element) {
      add(layers_reached(layout, canopy.corners[layout.first_bin.size()]));
    }
    for (const std::uint32_t more : of_mesh[copy.mesh]) add(more);
  }
  while (layout.first_bin.size() < canopy.size()) add(layers_reached(layout, canopy.corners[layout.first_bin.size()]));
  return bins;
}

}  // namespace

std::uint32_t layer_at(const Layers& layers, float y_m) {
  return shared::layer_of(y_m, layers.base_y_m, layers.per_metre, static_cast<std::uint32_t>(layers.count));
}

CounterLayout make_counter_layout(const RadiationModel& model) {
  CounterLayout layout;
  layout.box = scene_box(model);
  layout.layers = make_layers(model);
  const glm::dvec2 origin_m(model.canopy.origin_m.x, model.canopy.origin_m.z);
  const glm::dvec2 size_m = model.plot.periodic ? model.canopy.period_m : glm::dvec2(model.plot.size_x_m, model.plot.size_z_m);
  layout.plot_lo_m = glm::vec2(-origin_m);
  layout.plot_hi_m = glm::vec2(size_m - origin_m);
  if (model.soil) {
    layout.cells_x = cells_along(model.plot.size_x_m, model.soil->patch_m);
    layout.cells_z = cells_along(model.plot.size_z_m, model.soil->patch_m);
  }
  const std::uint64_t bins = number_bins(model.canopy, layout);
  const std::uint64_t words = shared::counter_first_cell + std::uint64_t{layout.cells_x} * layout.cells_z + 2 * bins;
  if (words > std::numeric_limits<std::uint32_t>::max()) {
    throw_input(fmt::format("{} counters of landings", words), "at most 4294967295 are possible",
                "give fewer layers, or a larger soil.patch");
  }
  layout.first_bin.push_back(static_cast<std::uint32_t>(bins));
  layout.first_bin_word = shared::counter_first_cell + layout.cells();
  return layout;
}

std::uint32_t first_layer(const CounterLayout& layout, const Triangle& corners) {
  return layer_at(layout.layers, std::min({corners[0].y, corners[1].y, corners[2].y}));
}

void add_area_by_layer(const Layers& layers, const Triangle& corners, std::span<double> area_by_layer_m2) {
  std::array<double, 3> heights{corners[0].y, corners[1].y, corners[2].y};
  std::sort(heights.begin(), heights.end());
  const double area = area_m2(corners);
  const std::uint32_t first = layer_at(layers, static_cast<float>(heights[0]));
  const std::uint32_t last = layer_at(layers, static_cast<float>(heights[2]));
  double below = 0.0;
  for (std::uint32_t layer = first; layer < last; ++layer) {
    const double share = area_share_below(heights, layers.base_y_m + (layer + 1) / double{layers.per_metre});
    area_by_layer_m2[layer] += (share - below) * area;
    below = share;
  }
  area_by_layer_m2[last] += (1.0 - below) * area;
}

shared::GroundMap make_ground_map(const CounterLayout& layout) {
  const glm::vec2 size_m = layout.plot_hi_m - layout.plot_lo_m;
  shared::GroundMap ground;
  ground.plot_lo = layout.plot_lo_m;
  ground.plot_hi = layout.plot_hi_m;
  ground.cells_per_metre = {static_cast<float>(layout.cells_x) / size_m.x, static_cast<float>(layout.cells_z) / size_m.y};
  ground.cells_x = layout.cells_x;
  ground.cells_z = layout.cells_z;
  ground.y = static_cast<float>(layout.box.ground_y_m);
  ground.depth = static_cast<float>(std::ldexp(layout.box.extent_m(), -17));
  return ground;
}

shared::PacketBlock make_packet_block(const RadiationModel& model, const CounterLayout& layout) {
  shared::PacketBlock scene;
  scene.period = model.canopy.period_m;
  scene.overlap = 0.5F * border_margin_m(model.canopy);
  scene.ground = make_ground_map(layout);
  scene.top_y = static_cast<float>(layout.box.above_m());
  return scene;
}

void number_counters(const CounterLayout& layout, const Canopy& canopy, Bvh& bvh) {
  if (bvh.copies.empty()) {
    for (BvhTriangle& triangle : bvh.triangles) {
      const std::uint32_t first_word = layout.first_bin_word + 2 * layout.first_bin[triangle.element];
      triangle.counter = first_word - 2 * first_layer(layout, canopy.corners[triangle.element]);
    }
    return;
  }
  for (const std::uint32_t node : bvh.copies) {
    BvhCopy copy = copy_at(bvh, node);
    const std::uint32_t first_bin = layout.first_bin[copy.first_element];
    copy.first_counter = layout.first_bin_word + 2 * first_bin;
    set_copy(bvh, node, copy);
    for (BvhTriangle& triangle : std::span(bvh.triangles).subspan(copy.first_triangle, copy.triangles)) {
      triangle.counter = 2 * (layout.first_bin[copy.first_element + triangle.element] - first_bin);
    }
  }
}

}  // namespace sunfleck
