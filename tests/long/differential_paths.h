#pragma once
// Follows the independent tracer's paths: forwards from the light, and backwards from a sensor.

#include "long/differential_light.h"
#include "long/differential_tally.h"
#include "long/differential_world.h"
#include "physics/transport/model/model.h"

#include <cstddef>
#include <vector>

namespace sunfleck::test::differential {

class Paths {
 public:
  Paths(const RadiationModel& model, const World& world, const Light& light) : model_(model), world_(world), light_(light) {}

  // Follows one batch of light to its end: cells * cells rays each of the beam, of the sky and of the lamps.
  void follow_light(std::size_t cells, Dice& dice, Tally& tally) const;

  // The light that a sensor reads, W m-2: [band].
  struct Reading {
    std::vector<double> direct, sky, scattered;
  };
  // Reads a sensor by this many paths; the sun, and a sky of single lights, are sampled exactly.
  [[nodiscard]] Reading read(const Sensor& sensor, std::size_t paths, Dice& dice) const;

 private:
  // The light that leaves a landing.
  struct Leaving {
    Ray ray;
    bool any = false;  // false: everything is absorbed
  };
  [[nodiscard]] Leaving scatter(const Landing& landing, std::vector<double>& weights, const std::vector<double>& scale,
                                Dice& dice) const;
  void follow(Ray ray, Height from, std::vector<double> flux_w, Carried carried, Dice& dice, Tally& tally,
              const Landing* first) const;
  [[nodiscard]] bool is_free(const glm::dvec3& from_m, const glm::dvec3& to_light) const;
  // Returns the irradiance of a side from the sun and from the single lights of the sky: [band].
  [[nodiscard]] std::vector<double> lights_on(const glm::dvec3& start_m, const glm::dvec3& normal) const;
  void look_back(Ray ray, double weight, Dice& dice, Reading& reading) const;
  // The point and the side from which a path continues backwards through a landing.
  struct Arrived {
    glm::dvec3 start_m{0.0}, normal{0.0};
    bool any = false;
  };
  [[nodiscard]] Arrived arrive(const Landing& landing, std::vector<double>& weights, Dice& dice) const;

  const RadiationModel& model_;
  const World& world_;
  const Light& light_;
};

}  // namespace sunfleck::test::differential
