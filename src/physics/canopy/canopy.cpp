#include "physics/canopy/canopy.h"

#include "base/error.h"
#include "physics/canopy/shared_meshes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <limits>

namespace sunfleck {
namespace {

struct DoubleBox {
  glm::dvec3 lo{std::numeric_limits<double>::infinity()};
  glm::dvec3 hi{-std::numeric_limits<double>::infinity()};

  [[nodiscard]] bool empty() const { return lo.x > hi.x; }
  void add(const glm::dvec3& at_m) {
    lo = glm::min(lo, at_m);
    hi = glm::max(hi, at_m);
  }
};

DoubleBox bounds_of(std::span<const PlacedMesh> parts) {
  DoubleBox box;
  for (const PlacedMesh& part : parts) {
    for (const Placement& placement : part.placements) {
      for (const glm::dvec3& vertex_m : part.mesh.vertices) box.add(placed_m(vertex_m, placement));
    }
  }
  return box;
}

// Returns the local origin on one axis. A stand that lies several times its own size from zero would lose digits in single
// precision, so it gets a separate origin on that axis.
double local_origin_m(const DoubleBox& box, int axis) {
  const glm::dvec3 size_m = box.hi - box.lo;
  const double largest_m = std::max({size_m.x, size_m.y, size_m.z});
  const double centre_m = 0.5 * (box.lo[axis] + box.hi[axis]);
  return std::abs(centre_m) > 4.0 * largest_m ? centre_m : 0.0;
}

// Returns the grid step: 2^-23 of the period rounded up to a power of two. Coordinates up to twice that power are exact in
// single precision.
double grid_step_m(double period_m) {
  return std::ldexp(1.0, static_cast<int>(std::ceil(std::log2(period_m))) - 23);
}

double snapped(double value_m, double step_m) {
  return std::round(value_m / step_m) * step_m;
}

// Moves corners, or the origin of a mesh, onto the grid and shifts them by whole periods until their centroid lies in the plot.
class Wrapper {
 public:
  explicit Wrapper(const Plot& plot)
      : step_m_(grid_step_m(plot.size_x_m), grid_step_m(plot.size_z_m)),
        period_m_(snapped(plot.size_x_m, step_m_.x), snapped(plot.size_z_m, step_m_.y)) {}

  [[nodiscard]] glm::dvec2 period_m() const { return period_m_; }

  void wrap(std::span<glm::dvec3> corners_m) const {
    wrap_axis(corners_m, 0, step_m_.x, period_m_.x);
    wrap_axis(corners_m, 2, step_m_.y, period_m_.y);
  }

 private:
  static void wrap_axis(std::span<glm::dvec3> corners_m, int axis, double step_m, double period_m) {
    double sum_m = 0.0;
    for (glm::dvec3& corner_m : corners_m) {
      corner_m[axis] = snapped(corner_m[axis], step_m);
      sum_m += corner_m[axis];
    }
    const double shift_m = -std::floor(sum_m / static_cast<double>(corners_m.size()) / period_m) * period_m;
    for (glm::dvec3& corner_m : corners_m) corner_m[axis] += shift_m;
  }

  glm::dvec2 step_m_;
  glm::dvec2 period_m_;
};

std::vector<std::uint16_t> merge_optics_names(Canopy& canopy, const Mesh& mesh) {
  std::vector<std::uint16_t> merged;
  for (const std::string& name : mesh.optics_names) {
    const auto found = std::find(canopy.optics_names.begin(), canopy.optics_names.end(), name);
    merged.push_back(static_cast<std::uint16_t>(found - canopy.optics_names.begin()));
    if (found != canopy.optics_names.end()) continue;
    if (canopy.optics_names.size() >= std::numeric_limits<std::uint16_t>::max()) {
      throw_input(fmt::format("{} optics names", canopy.optics_names.size()), "at most 65535 are possible",
                  "give surfaces of the same optics the same material");
    }
    canopy.optics_names.push_back(name);
  }
  return merged;
}

// Appends the organs of one copy.
void add_organs(Canopy& canopy, const PlacedMesh& part, PlantNumbers& plants) {
  for (Organ organ : part.mesh.organs) {
    if (part.role) organ.role = part.role;
    if (organ.plant > 0) organ.plant = plants.of(organ.plant);
    canopy.organs.push_back(std::move(organ));
  }
}

class CornerPlacer {
 public:
  CornerPlacer(Canopy& canopy, const Plot& plot) : canopy_(canopy), wrapper_(plot), periodic_(plot.periodic) {
    if (periodic_) canopy.period_m = wrapper_.period_m();
  }

  void add_own(const PlacedMesh& part) const {
    const Mesh& mesh = part.mesh;
    for (const Placement& placement : part.placements) {
      for (const glm::uvec3& numbers : mesh.triangles) {
        std::array<glm::dvec3, 3> corners_m;
        for (int k = 0; k < 3; ++k) corners_m[k] = placed_m(mesh.vertices[numbers[k]], placement) - canopy_.origin_m;
        if (periodic_) wrapper_.wrap(corners_m);
        canopy_.corners.push_back({glm::vec3(corners_m[0]), glm::vec3(corners_m[1]), glm::vec3(corners_m[2])});
      }
    }
  }

  void add_shared(const PlacedMesh& part) const {
    const glm::dvec3 origin_m = mesh_origin_m(part.mesh);
    std::vector<shared::CopyTurn> turns;
    for (const Placement& placement : part.placements) {
      glm::dvec3 shift_m = placed_m(origin_m, placement) - canopy_.origin_m;
      if (periodic_) wrapper_.wrap(std::span(&shift_m, 1));
      turns.push_back(turn_of(placement, shift_m));
    }
    const std::uint32_t mesh = canopy_.corners.add_mesh(shared_mesh(part.mesh, origin_m, turns));
    for (const shared::CopyTurn& turn : turns) canopy_.corners.add_copy(mesh, turn);
  }

 private:
  Canopy& canopy_;
  Wrapper wrapper_;
  bool periodic_;
};

// Returns the elements that lie exactly on earlier ones: within a shared mesh, or among the elements with corners of their own.
std::vector<Copy> all_copies(const ElementCorners& corners) {
  std::vector<Copy> copies = find_copies(corners.own());
  if (corners.copies().empty()) return copies;
  const std::vector<std::uint32_t> own = corners.own_elements();
  for (Copy& copy : copies) copy = {own[copy.element], own[copy.original]};
  std::vector<std::vector<Copy>> in_mesh;
  for (const SharedMesh& mesh : corners.meshes()) in_mesh.push_back(find_copies(mesh.corners));
  for (const MeshCopy& placed : corners.copies()) {
    for (const Copy& copy : in_mesh[placed.mesh]) {
      copies.push_back({placed.first_element + copy.element, placed.first_element + copy.original});
    }
  }
  std::sort(copies.begin(), copies.end(), [](const Copy& a, const Copy& b) { return a.element < b.element; });
  return copies;
}

}  // namespace

glm::dvec3 mesh_origin_m(const Mesh& mesh) {
  DoubleBox box;
  for (const glm::dvec3& vertex_m : mesh.vertices) box.add(vertex_m);
  return {local_origin_m(box, 0), local_origin_m(box, 1), local_origin_m(box, 2)};
}

Canopy assemble_canopy(std::span<const PlacedMesh> parts, const Plot& plot) {
  Canopy canopy;
  std::size_t elements = 0;
  for (const PlacedMesh& part : parts) elements += part.mesh.triangles.size() * part.placements.size();
  if (elements > std::numeric_limits<std::uint32_t>::max() / 4) {
    throw_input(fmt::format("{} triangles", elements), "at most 1073741823 are possible", "place fewer copies");
  }
  const bool labelled =
      std::any_of(parts.begin(), parts.end(), [](const PlacedMesh& part) { return !part.mesh.labels.empty(); });
  canopy.organ_of.reserve(elements);
  canopy.optics_of.reserve(elements);
  if (labelled) canopy.labels.reserve(elements);
  const DoubleBox box = bounds_of(parts);
  if (!box.empty()) {
    canopy.origin_m.y = local_origin_m(box, 1);
    if (!plot.periodic) {
      canopy.origin_m.x = local_origin_m(box, 0);
      canopy.origin_m.z = local_origin_m(box, 2);
    }
  }

  std::size_t own_elements = 0;
  for (const PlacedMesh& part : parts) {
    if (!shares_triangles(part, elements)) own_elements += part.mesh.triangles.size() * part.placements.size();
  }
  canopy.corners.reserve(own_elements);
  const CornerPlacer placer(canopy, plot);
  PlantNumbers plants;
  for (const PlacedMesh& part : parts) {
    const Mesh& mesh = part.mesh;
    const std::vector<std::uint16_t> optics = merge_optics_names(canopy, mesh);
    for (std::size_t copy = 0; copy < part.placements.size(); ++copy) {
      const auto first_organ = static_cast<std::uint32_t>(canopy.organs.size());
      plants.begin_copy(mesh, copy, part.placements[copy]);
      add_organs(canopy, part, plants);
      for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        canopy.organ_of.push_back(first_organ + mesh.organ_of[t]);
        canopy.optics_of.push_back(optics[mesh.optics_of[t]]);
        if (labelled) canopy.labels.push_back(mesh.labels.empty() ? no_label : mesh.labels[t]);
      }
    }
    if (shares_triangles(part, elements)) {
      placer.add_shared(part);
    } else {
      placer.add_own(part);
    }
  }
  canopy.copies = all_copies(canopy.corners);
  canopy.plants = plant_sites(parts);
  return canopy;
}

Box bounds(const Canopy& canopy) {
  if (canopy.corners.empty()) return {};
  const glm::vec3 first = canopy.corners[0][0];
  Box box{first, first};
  for (const Triangle& triangle : canopy.corners) {
    for (const glm::vec3& corner : triangle) {
      box.lo = glm::min(box.lo, corner);
      box.hi = glm::max(box.hi, corner);
    }
  }
  return box;
}

}  // namespace sunfleck
