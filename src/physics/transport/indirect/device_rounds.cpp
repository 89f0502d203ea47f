#include "physics/transport/indirect/device_rounds.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace sunfleck {
namespace {

std::uint32_t role_number(Role role) {
  if (role == Role::soil) return shared::role_soil;
  return is_vegetation(role) ? shared::role_vegetation : shared::role_structure;
}

}  // namespace

std::uint64_t RoundsOrder::most_packets() const {
  const auto first = static_cast<std::uint64_t>(std::ceil(packets));
  std::uint64_t for_columns = (shared::least_of_column >> 32U) * columns.size();
  // Aimed rounds draw up to 2^least_aim_bits packets for each one expected, but hardly ever for many columns.
  if (block.stand.radius > 0.0F) {
    constexpr std::uint64_t enough = 1U << 16U;
    for_columns = std::min(for_columns << shared::least_aim_bits, std::max(first, enough));
  }
  return first + for_columns + shared::least_packets + 1;
}

std::span<const std::uint64_t> RoundsSums::at_places(const shared::PassBlock& block, const shared::PlaneStack& stack,
                                                     std::uint32_t kind) const {
  const std::size_t first = std::size_t{shared::place_row(stack, kind, 0)} * block.columns;
  return std::span(totals).subspan(first, std::size_t{stack.places} * block.columns);
}

std::span<const std::uint64_t> RoundsSums::moved(const shared::PassBlock& block, const shared::PlaneStack& stack) const {
  const std::size_t first = shared::small_words(block) + std::size_t{stack.first_moved} * block.columns;
  return std::span(totals).subspan(first, std::size_t{stack.places} * block.columns);
}

shared::PassBlock block_of(const IndirectScene& scene) {
  const glm::dvec2 period_m = scene.model.canopy.period_m;
  const Layers& layers = scene.layout.layers;
  shared::PassBlock block{};
  if (period_m.x > 0.0) {
    block.period = glm::vec2(period_m);
    block.per_period = glm::vec2(1.0 / period_m);
  }
  block.ground = scene.block.ground;
  block.offset = scene.frame.offset_m;
  block.layer_base_y = layers.base_y_m;
  block.layers_per_metre = layers.per_metre;
  block.layers = static_cast<std::uint32_t>(layers.count);
  block.columns = static_cast<std::uint32_t>(scene.model.bands.size() * scene.lights.size());
  block.optics = static_cast<std::uint32_t>(scene.model.optics.size());
  block.faces = lamp_face(scene.model) + 1;
  block.soil_face = soil_face(scene.model);
  block.runs = static_cast<std::uint32_t>(scene.model.canopy.corners.runs().size());
  if (scene.receivers == nullptr) return block;
  block.planes = static_cast<std::uint32_t>(scene.receivers->size());
  block.zone_of_lamps = static_cast<std::uint32_t>(scene.receivers->zone_of_lamps());
  block.plot = scene.receivers->plot();
  return block;
}

std::vector<std::uint64_t> coefficients_of(const Scattering& scattering) {
  std::vector<std::uint64_t> reflected, scattered;
  for (const FaceColumns& face : scattering.faces()) {
    reflected.insert(reflected.end(), face.reflected.begin(), face.reflected.end());
    scattered.insert(scattered.end(), face.scattered.begin(), face.scattered.end());
  }
  reflected.insert(reflected.end(), scattered.begin(), scattered.end());
  return reflected;
}

std::vector<shared::RoundElement> round_elements(const IndirectScene& scene) {
  std::vector<shared::RoundElement> elements(scene.model.canopy.size());
  for (std::size_t e = 0; e < elements.size(); ++e) {
    const std::uint32_t optics = scene.model.canopy.optics_of[e];
    elements[e] = {scene.surfaces.number_of[e], optics * 4 + role_number(scene.surfaces.at(e).role)};
  }
  return elements;
}

std::vector<shared::ElementRun> element_runs(const ElementCorners& corners) {
  std::vector<std::uint32_t> first_of_mesh;
  std::size_t before = corners.own().size();
  for (const SharedMesh& mesh : corners.meshes()) {
    first_of_mesh.push_back(static_cast<std::uint32_t>(before));
    before += mesh.corners.size();
  }
  std::vector<shared::ElementRun> runs;
  for (const ElementCorners::Run& run : corners.runs()) {
    if (run.copy == ElementCorners::no_copy) {
      runs.push_back({run.first_element, run.first_own, 0, {}});
    } else {
      const MeshCopy& copy = corners.copies()[run.copy];
      runs.push_back({run.first_element, first_of_mesh[copy.mesh], 1, copy.turn});
    }
  }
  return runs;
}

std::vector<std::span<const Triangle>> corner_arrays(const ElementCorners& corners) {
  std::vector<std::span<const Triangle>> arrays{corners.own()};
  for (const SharedMesh& mesh : corners.meshes()) arrays.emplace_back(mesh.corners);
  return arrays;
}

}  // namespace sunfleck
