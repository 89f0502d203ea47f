#pragma once
// Builds the parts of random scenes: plots, suns, leaves, plants, rooms, optics, receivers.

#include "support/models.h"

#include <glm/vec3.hpp>
#include <string>
#include <vector>

namespace sunfleck::test::differential {

[[nodiscard]] Plot random_plot(Random& random, bool periodic = true);
[[nodiscard]] SunPosition random_sun(Random& random);
[[nodiscard]] glm::dvec3 random_normal(Random& random);

// Limits of the positions of leaf centres.
struct Space {
  glm::dvec3 lo_m{0.0}, hi_m{0.0};
};
// Returns the space above a plot, from `lowest_m` to `highest_m`.
[[nodiscard]] Space above(const Plot& plot, double lowest_m, double highest_m);

// Adds square leaves of random place and orientation, an organ each, whose ranks follow `rank`.
struct Leaves {
  int count = 10;
  double area_m2 = 0.03;
  Space space;
  std::string name = "leaf";
  int rank = 0;
};
void add_leaves(MeshMaker& maker, Random& random, const Leaves& leaves);

// Adds a plant with a square stem and bent leaves of three pieces each.
void add_plant(MeshMaker& maker, Random& random, const glm::dvec3& foot_m, int plant);

// Adds a room of six walls whose upper faces look inwards, an organ each.
void add_room(MeshMaker& maker, const glm::dvec3& lo_m, const glm::dvec3& hi_m);

// Adds an undulating sheet of soil that closes across the borders of the plot.
void add_soil_sheet(MeshMaker& maker, Random& random, const Plot& plot);

// Returns optics with two equal faces: dark as in the visible, or bright as in the near infrared.
[[nodiscard]] FaceOptics dark_face(Random& random);
[[nodiscard]] FaceOptics bright_face(Random& random);

// Gives the model two bands, a dark one and a bright one, of direct light alone, and paints all its surfaces. Stems and walls
// transmit nothing.
void paint(RadiationModel& model, Random& random);

// Returns a model of a mesh in the sun, with painted surfaces, one receiver plane and two sensors.
[[nodiscard]] RadiationModel painted_model(const Mesh& mesh, const Plot& plot, const SunPosition& sun, Random& random);

// Adds sky light to all bands, this share of 1 W m-2.
void add_sky(RadiationModel& model, const SkyModel& sky, double part);

// Adds a plane at that height, and a sensor of one point anywhere in the plot, below `highest_m`.
void add_plane(RadiationModel& model, double height_m);
void add_sensor(RadiationModel& model, Random& random, SensorResponse response, const glm::dvec3& normal, double highest_m);

}  // namespace sunfleck::test::differential
