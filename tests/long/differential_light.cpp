#include "long/differential_light.h"

#include "physics/canopy/triangle.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>

namespace sunfleck::test::differential {
namespace {

constexpr double full_turn = 2.0 * std::numbers::pi;

// Two unit vectors that are perpendicular to a third and to each other.
struct Frame {
  Frame(const glm::dvec3& first, const glm::dvec3& second) : u(first), v(second) {}
  explicit Frame(const glm::dvec3& along) {
    const glm::dvec3 other = std::abs(along.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 0, 1);
    u = glm::normalize(glm::cross(along, other));
    v = glm::cross(along, u);
  }
  glm::dvec3 u, v;
};

// Returns a random point in cell k of the unit square's cells * cells cells.
glm::dvec2 jittered(std::size_t k, std::size_t cells, Dice& dice) {
  const std::size_t column = k % cells;
  const std::size_t row = k / cells;
  const double u = static_cast<double>(column) + dice.unit();
  return glm::dvec2(u, static_cast<double>(row) + dice.unit()) / static_cast<double>(cells);
}

}  // namespace

glm::dvec3 cosine_direction(const glm::dvec3& normal, Dice& dice) {
  const double radius = std::sqrt(dice.unit());
  const double angle = full_turn * dice.unit();
  const Frame frame(normal);
  const double height = std::sqrt(std::max(0.0, 1.0 - radius * radius));
  return glm::normalize(radius * std::cos(angle) * frame.u + radius * std::sin(angle) * frame.v + height * normal);
}

glm::dvec3 any_direction(Dice& dice) {
  const double height = 2.0 * dice.unit() - 1.0;
  const double angle = full_turn * dice.unit();
  const double level = std::sqrt(std::max(0.0, 1.0 - height * height));
  return {level * std::cos(angle), height, level * std::sin(angle)};
}

Light::Light(const RadiationModel& model, const World& world) : model_(model), world_(world) {
  const bool any_direct =
      std::any_of(model.bands.begin(), model.bands.end(), [](const Waveband& b) { return b.direct_w_m2 > 0; });
  beam_ = model.sun && model.sun->elevation_rad > 0.0 && any_direct;
  lo_m_ = world.lo_m();
  hi_m_ = world.hi_m();
  for (const PlaneReceiver& plane : model.planes) hi_m_.y = std::max(hi_m_.y, plane.height_m);
  const double plot_m2 = model.canopy.period_m.x * model.canopy.period_m.y;
  if (beam_) {
    to_sun_ = {-std::cos(model.sun->elevation_rad) * std::cos(model.sun->azimuth_rad), std::sin(model.sun->elevation_rad),
               -std::cos(model.sun->elevation_rad) * std::sin(model.sun->azimuth_rad)};
    beam_window_ = window_to(to_sun_);
    beam_ground_m2_ = model.plot.periodic ? plot_m2 : beam_window_.area_m2() / to_sun_.y;
  }
  if (model.sky) {
    sky_.emplace(*model.sky, model.sun.value_or(SunPosition{0.5 * std::numbers::pi, 0.0}));
    measure_sky();
  }
  find_lamps();
}

// Finds the largest radiance, and the level ground that the rays through a window represent: the integral of radiance over the
// sky times the window's area. Radiance is constant in cells that are even in zenith angle and azimuth.
void Light::measure_sky() {
  double plain = 0.0;
  for (const SkyLight& light : sky_lights()) plain += light.weight / light.to_sky.y;
  for (int row = 0; row < Sky::rows && !sky_->is_list(); ++row) {
    const double step = 0.5 * std::numbers::pi / Sky::rows;
    const double ring = std::cos(row * step) - std::cos((row + 1) * step);
    const double zenith = (row + 0.5) * step;
    for (int column = 0; column < Sky::columns; ++column) {
      const double azimuth = (column + 0.5) * full_turn / Sky::columns;
      const double radiance =
          sky_->radiance({-std::sin(zenith) * std::cos(azimuth), std::cos(zenith), -std::sin(zenith) * std::sin(azimuth)});
      largest_radiance_ = std::max(largest_radiance_, radiance);
      plain += radiance * ring * full_turn / Sky::columns;
    }
  }
  sky_ground_m2_ =
      model_.plot.periodic ? model_.canopy.period_m.x * model_.canopy.period_m.y : plain * any_window(to_sun_).area_m2();
}

void Light::find_lamps() {
  std::vector<double> total_w(model_.bands.size());
  const auto emission_of = [&](std::size_t e) -> const std::vector<double>& {
    return model_.optics[model_.canopy.optics_of[e]].emission_w_m2;
  };
  for (std::size_t e = 0; e < model_.canopy.size(); ++e) {
    if (emission_of(e).empty() || world_.is_copy(e)) continue;
    lamps_.push_back({e, 0.0, 0.0, area_m2(model_.canopy.corners[e])});
    for (std::size_t b = 0; b < total_w.size(); ++b) total_w[b] += lamps_.back().area_m2 * emission_of(e)[b];
  }
  double sum = 0.0;
  for (Lamp& lamp : lamps_) {
    for (std::size_t b = 0; b < total_w.size(); ++b) {
      lamp.share += lamp.area_m2 * emission_of(lamp.element)[b] / total_w[b] / static_cast<double>(total_w.size());
    }
    lamp.up_to = sum += lamp.share;
  }
}

double Light::Window::area_m2() const {
  return 4.0 * glm::length(half_u_m) * glm::length(half_v_m);
}

// Returns a window that just covers the shadow of the stand's box, with one edge level. Not for light from the zenith.
Light::Window Light::window_to(const glm::dvec3& to_light) const {
  const glm::dvec3 level = glm::normalize(glm::dvec3(to_light.z, 0.0, -to_light.x));
  const Frame frame{glm::cross(level, to_light), level};
  glm::dvec2 half_m(0.0);
  const glm::dvec3 size_m = 0.5 * (hi_m_ - lo_m_);
  for (int axis = 0; axis < 3; ++axis) half_m += size_m[axis] * glm::dvec2(std::abs(frame.u[axis]), std::abs(frame.v[axis]));
  half_m *= 1.001;
  return {0.5 * (lo_m_ + hi_m_), half_m.x * frame.u, half_m.y * frame.v};
}

// Returns a square window that is equally large for light from every direction.
Light::Window Light::any_window(const glm::dvec3& to_light) const {
  const Frame frame(to_light);
  const double half_m = 0.501 * glm::length(hi_m_ - lo_m_);
  return {0.5 * (lo_m_ + hi_m_), half_m * frame.u, half_m * frame.v};
}

Ray Light::ray_from(const glm::dvec3& to_light, const Window& window, double u, double v) const {
  if (model_.plot.periodic) return {{u * model_.canopy.period_m.x, world_.top_y_m(), v * model_.canopy.period_m.y}, -to_light};
  const glm::dvec3 at_m = window.centre_m + (2.0 * u - 1.0) * window.half_u_m + (2.0 * v - 1.0) * window.half_v_m;
  return {at_m + glm::length(hi_m_ - lo_m_) * to_light, -to_light};
}

std::vector<Ray> Light::beam_rays(std::size_t cells, Dice& dice) const {
  std::vector<Ray> rays;
  for (std::size_t k = 0; k < cells * cells; ++k) {
    const glm::dvec2 at = jittered(k, cells, dice);
    rays.push_back(ray_from(to_sun_, beam_window_, at.x, at.y));
  }
  return rays;
}

// Draws by rejection: over level ground each ray carries an equal share of the irradiance, through the square an equal share of
// the radiance.
glm::dvec3 Light::sky_direction(Dice& dice) const {
  const glm::dvec3 zenith(0.0, 1.0, 0.0);
  const bool by_cosine = model_.plot.periodic;
  if (sky_->is_list()) {
    const auto weight_of = [&](const SkyLight& light) { return by_cosine ? light.weight : light.weight / light.to_sky.y; };
    double left = 0.0;
    for (const SkyLight& light : sky_lights()) left += weight_of(light);
    left *= dice.unit();
    for (const SkyLight& light : sky_lights()) {
      left -= weight_of(light);
      if (left < 0.0) return light.to_sky;
    }
    return sky_lights().back().to_sky;
  }
  while (true) {
    glm::dvec3 to_sky = by_cosine ? cosine_direction(zenith, dice) : any_direction(dice);
    to_sky.y = std::abs(to_sky.y);
    if (dice.unit() * largest_radiance_ < sky_->radiance(to_sky) && to_sky.y > 1e-6) return to_sky;
  }
}

std::vector<Ray> Light::sky_rays(std::size_t cells, Dice& dice) const {
  std::vector<Ray> rays;
  for (std::size_t k = 0; k < cells * cells; ++k) {
    const glm::dvec2 at = jittered(k, cells, dice);
    const glm::dvec3 to_sky = sky_direction(dice);
    rays.push_back(ray_from(to_sky, any_window(to_sky), at.x, at.y));
  }
  return rays;
}

Emitted Light::emitted(std::size_t count, Dice& dice) const {
  const double drawn = dice.unit() * lamps_.back().up_to;
  const auto found = std::find_if(lamps_.begin(), lamps_.end() - 1, [&](const Lamp& lamp) { return drawn < lamp.up_to; });
  const Triangle& corners = model_.canopy.corners[found->element];
  double b = dice.unit();
  double c = dice.unit();
  if (b + c > 1.0) {
    b = 1.0 - b;
    c = 1.0 - c;
  }
  const glm::dvec3 a(corners[0]);
  const glm::dvec3 point_m = a + b * (glm::dvec3(corners[1]) - a) + c * (glm::dvec3(corners[2]) - a);
  const glm::dvec3& normal = world_.normal(found->element);
  Emitted emitted{{world_.start(point_m, normal), cosine_direction(normal, dice)}, found->element, {}};
  for (const double emission : model_.optics[model_.canopy.optics_of[found->element]].emission_w_m2) {
    emitted.flux_w.push_back(emission * found->area_m2 / found->share / static_cast<double>(count));
  }
  return emitted;
}

double Light::radiance(const glm::dvec3& to_sky) const {
  return sky_ && !sky_->is_list() ? sky_->radiance(to_sky) : 0.0;
}

const std::vector<SkyLight>& Light::sky_lights() const {
  static const std::vector<SkyLight> none;
  return sky_ ? sky_->lights() : none;
}

}  // namespace sunfleck::test::differential
