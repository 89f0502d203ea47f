#pragma once
// Builds the scenes of the known-answer cases.

#include "base/units.h"
#include "physics/canopy/canopy.h"
#include "physics/light/sun.h"
#include "physics/transport/model/model.h"
#include "physics/transport/solve/solve.h"

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <string>

namespace sunfleck {

[[nodiscard]] SunPosition sun_at(double elevation_deg, double azimuth_deg);

// Returns the sun's position on 8 August 2002, 10:10 China Standard Time, at 40.02 N 116.28 E.
[[nodiscard]] SunPosition beijing_sun();

// Converts from the axes x east, y north, z up to the scene's (X south, Y up, Z west).
[[nodiscard]] glm::dvec3 from_east_north_up(double x, double y, double z);

// Returns a unit vector with that inclination from the vertical, whose horizontal part points at that angle from X towards Z.
[[nodiscard]] glm::dvec3 inclined(double inclination_rad, double angle_rad);

// Collects triangles. Each call of organ() begins a new organ with its own optics, to which the following triangles belong.
// Corners run counter-clockwise about the upper face's normal.
class MeshMaker {
 public:
  void organ(const std::string& name, int plant = 1, int rank = 0);
  void triangle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c);
  void quad(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d);
  // Add horizontal rectangles, X from x0 to x1 and Z from z0 to z1, facing up and facing down.
  void level(double x0, double x1, double z0, double z1, double y);
  void ceiling(double x0, double x1, double z0, double z1, double y);
  // Adds a regular polygon of that area about its centre, cut into a fan.
  void polygon(const glm::dvec3& centre, const glm::dvec3& normal, double area_m2, int corners, double spin_rad = 0.0);

  [[nodiscard]] const Mesh& mesh() const { return mesh_; }

 private:
  Mesh mesh_;
};

// Returns square leaves of random position and orientation in a box on the plot, one organ each.
[[nodiscard]] Mesh random_leaf_mesh(int count, double area_m2, const Plot& plot, double height_m, std::uint64_t seed);

// Optics in one band: leaves with equal faces, over Lambertian soil.
struct LeafBand {
  const char* name;
  double reflectance, transmittance, soil_reflectance;
};
inline constexpr LeafBand par_band{"PAR", 0.12, 0.06, 0.15};
inline constexpr LeafBand nir_band{"NIR", 0.45, 0.45, 0.20};

// Returns a model with one band of 1 W m-2 of beam on the horizontal; every surface is black, including the soil.
[[nodiscard]] RadiationModel black_model(const Mesh& mesh, const Plot& plot, const SunPosition& sun);
// Sets `count` bands of 1 W m-2, with every surface black in all of them.
void set_bands(RadiationModel& model, std::size_t count);
// Returns a model without sun and soil, lit only by lamps.
[[nodiscard]] RadiationModel lamp_model(const Mesh& mesh, const Plot& plot, std::size_t bands = 1);
// Sets such bands of 1 W m-2, in which every surface is a leaf.
void set_leaf_bands(RadiationModel& model, std::span<const LeafBand> bands);
// Returns a model in which every surface is such a leaf, with 1 W m-2 of beam in each band.
[[nodiscard]] RadiationModel leaf_model(const Mesh& mesh, const Plot& plot, const SunPosition& sun,
                                        std::span<const LeafBand> bands);
// Replaces the beam by the same amount of sky light.
void shine_from_sky(RadiationModel& model, const SkyModel& sky);

inline constexpr int case_replicates = 32;

// Returns settings with that many beam rays in total, and that many first packets per replicate (0: nothing scatters). The
// unshot flux is below 1e-6 of the incident flux.
[[nodiscard]] SolveSettings case_work(const RadiationModel& model, double rays, double packets = 0.0,
                                      int replicates = case_replicates);

// Returns the flux that an organ absorbs, per ground area of the plot.
[[nodiscard]] Estimate absorbed_by_organ(const RadiationModel& model, const RadiationResult& result, std::size_t organ,
                                         std::size_t band);

}  // namespace sunfleck
