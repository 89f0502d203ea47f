#pragma once
// The light of the independent tracer: from sun, sky and lamps. Flux is in W, for each waveband.

#include "long/differential_world.h"
#include "physics/light/sky.h"
#include "physics/transport/model/model.h"

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <random>
#include <vector>

namespace sunfleck::test::differential {

// Draws the random numbers of one batch.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : engine_(seed) {}
  double unit() { return static_cast<double>(engine_() >> 11U) * 0x1p-53; }

 private:
  std::mt19937_64 engine_;
};

// Return a cosine-distributed direction about a unit normal, and a direction uniform over the sphere.
[[nodiscard]] glm::dvec3 cosine_direction(const glm::dvec3& normal, Dice& dice);
[[nodiscard]] glm::dvec3 any_direction(Dice& dice);

struct Ray {
  glm::dvec3 origin_m{0.0}, direction{0.0};
};

// Light that starts at a point, with its flux by band.
struct Emitted {
  Ray ray;
  std::size_t element = 0;
  std::vector<double> flux_w;
};

class Light {
 public:
  Light(const RadiationModel& model, const World& world);

  [[nodiscard]] bool has_beam() const { return beam_; }
  [[nodiscard]] bool has_sky() const { return sky_.has_value(); }
  [[nodiscard]] bool has_lamps() const { return !lamps_.empty(); }
  [[nodiscard]] const glm::dvec3& to_sun() const { return to_sun_; }

  // Return the level ground that all rays together represent, m2: those of the beam, and those of the sky.
  [[nodiscard]] double beam_ground_m2() const { return beam_ground_m2_; }
  [[nodiscard]] double sky_ground_m2() const { return sky_ground_m2_; }

  // Return one ray in each of the cells * cells equal cells of the plane that the light comes through; each carries an equal
  // share of the flux.
  [[nodiscard]] std::vector<Ray> beam_rays(std::size_t cells, Dice& dice) const;
  [[nodiscard]] std::vector<Ray> sky_rays(std::size_t cells, Dice& dice) const;
  // Returns light of one of the lamps, as if `count` of these were all of it.
  [[nodiscard]] Emitted emitted(std::size_t count, Dice& dice) const;

  // Returns the radiance of the sky for a horizontal irradiance of 1; 0 for a sky of single lights.
  [[nodiscard]] double radiance(const glm::dvec3& to_sky) const;
  [[nodiscard]] const std::vector<SkyLight>& sky_lights() const;

 private:
  // A rectangle across the path of light, wide enough for an isolated stand.
  struct Window {
    glm::dvec3 centre_m{0.0}, half_u_m{0.0}, half_v_m{0.0};
    [[nodiscard]] double area_m2() const;
  };
  [[nodiscard]] Window window_to(const glm::dvec3& to_light) const;
  [[nodiscard]] Window any_window(const glm::dvec3& to_light) const;
  [[nodiscard]] Ray ray_from(const glm::dvec3& to_light, const Window& window, double u, double v) const;
  [[nodiscard]] glm::dvec3 sky_direction(Dice& dice) const;
  void measure_sky();
  void find_lamps();

  const RadiationModel& model_;
  const World& world_;
  bool beam_ = false;
  glm::dvec3 to_sun_{0.0, 1.0, 0.0};
  std::optional<Sky> sky_;
  double largest_radiance_ = 0.0;
  double beam_ground_m2_ = 0.0, sky_ground_m2_ = 0.0;
  glm::dvec3 lo_m_{0.0}, hi_m_{0.0};  // of an isolated stand, its plot and its planes
  Window beam_window_;
  struct Lamp {
    std::size_t element = 0;
    double share = 0.0;  // of all lamps' flux, averaged over the bands
    double up_to = 0.0;  // sum of the shares of this and all earlier lamps
    double area_m2 = 0.0;
  };
  std::vector<Lamp> lamps_;
};

}  // namespace sunfleck::test::differential
