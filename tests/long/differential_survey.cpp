#include "long/differential_tally.h"

#include "physics/canopy/triangle.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace sunfleck::test::differential {
namespace {

// As the guide states, a leaf whose plane is this close to the beam has no sunlit share.
constexpr double edge_on_cosine = 1e-5;

// Returns the area of the part of a triangle below a height, by clipping.
double area_below_m2(const Triangle& corners, double y_m) {
  std::vector<glm::dvec3> part;
  for (std::size_t k = 0; k < 3; ++k) {
    const glm::dvec3 from(corners[k]);
    const glm::dvec3 to(corners[(k + 1) % 3]);
    if (from.y <= y_m) part.push_back(from);
    if ((from.y < y_m) != (to.y < y_m) && from.y != to.y)
      part.push_back(from + (to - from) * ((y_m - from.y) / (to.y - from.y)));
  }
  glm::dvec3 doubled(0.0);
  for (std::size_t k = 2; k < part.size(); ++k) doubled += glm::cross(part[k - 1] - part[0], part[k] - part[0]);
  return 0.5 * glm::length(doubled);
}

// Returns true if soil keeps the beam away from the whole triangle: below an endless plot, or in the shadow of an isolated
// plot's rectangle.
bool is_under_soil(const RadiationModel& model, const Triangle& corners, const glm::dvec3& to_sun) {
  return model.soil && std::all_of(corners.begin(), corners.end(), [&](const glm::vec3& corner) {
           if (corner.y >= 0.0F) return false;
           const glm::dvec3 at_m = glm::dvec3(corner) - to_sun * (corner.y / to_sun.y);
           return model.plot.periodic ||
                  (at_m.x >= 0.0 && at_m.x <= model.plot.size_x_m && at_m.z >= 0.0 && at_m.z <= model.plot.size_z_m);
         });
}

}  // namespace

Survey::Survey(const RadiationModel& model, const World& world, const Light& light)
    : has_beam_(light.has_beam()), rows_(static_cast<std::size_t>(model.layers)), lit_per_ground_(model.canopy.size()) {
  for (const Triangle& corners : model.canopy.corners) {
    element_m2_.push_back(area_m2(corners));
    for (const glm::vec3& corner : corners) height_m_ = std::max(height_m_, double{corner.y});
  }
  find_roles(model);
  if (has_beam_) find_facing(model, world, light);
  measure(model);
}

void Survey::find_roles(const RadiationModel& model) {
  const auto name_of = [&](std::size_t e) -> const std::string& { return model.canopy.organs[model.canopy.organ_of[e]].name; };
  bool leaves = false;
  bool plants = false;
  for (std::size_t e = 0; e < model.canopy.size(); ++e) {
    soil_.push_back(name_of(e) == "soil");
    structure_.push_back(name_of(e) == "wall" || name_of(e) == "lamp");
    leaves = leaves || name_of(e).starts_with("leaf");
    plants = plants || !(soil_[e] || structure_[e]);
  }
  if (!plants) structure_.assign(structure_.size(), false);
  for (std::size_t e = 0; e < soil_.size(); ++e) {
    foliage_.push_back(!soil_[e] && !structure_[e] && (!leaves || name_of(e).starts_with("leaf")));
  }
}

void Survey::find_facing(const RadiationModel& model, const World& world, const Light& light) {
  for (std::size_t e = 0; e < lit_per_ground_.size(); ++e) {
    const double cosine = std::abs(glm::dot(world.normal(e), light.to_sun()));
    if (cosine > edge_on_cosine && !world.is_copy(e) && !is_under_soil(model, model.canopy.corners[e], light.to_sun())) {
      lit_per_ground_[e] = light.to_sun().y / cosine;
    }
  }
}

void Survey::measure(const RadiationModel& model) {
  organ_m2_.resize(model.canopy.organs.size());
  organ_facing_m2_ = organ_m2_;
  row_facing_m2_.resize(rows_);
  for (std::size_t e = 0; e < element_m2_.size(); ++e) {
    organ_m2_[model.canopy.organ_of[e]] += element_m2_[e];
    if (lit_per_ground_[e] == 0.0) continue;
    organ_facing_m2_[model.canopy.organ_of[e]] += element_m2_[e];
    if (!foliage_[e]) continue;
    double below_m2 = 0.0;
    for (std::size_t row = 0; row < rows_; ++row) {
      const double edge_m = height_m_ * static_cast<double>(row + 1) / static_cast<double>(rows_);
      const double up_to_m2 = row + 1 == rows_ ? element_m2_[e] : area_below_m2(model.canopy.corners[e], edge_m);
      row_facing_m2_[row] += up_to_m2 - below_m2;
      below_m2 = up_to_m2;
    }
  }
}

std::size_t Survey::row_at(double y_m) const {
  const double row = std::floor(y_m / height_m_ * static_cast<double>(rows_));
  return static_cast<std::size_t>(std::clamp(row, 0.0, static_cast<double>(rows_ - 1)));
}

}  // namespace sunfleck::test::differential
