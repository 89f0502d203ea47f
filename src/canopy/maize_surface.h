#pragma once
// The surfaces a maize plant is made of, leaf blades and tapering tubes, and their triangles.

#include "canopy/mesh.h"

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <numbers>
#include <vector>

namespace sunfleck {

// Width of a blade over its greatest width, at the distance s (0 the collar, 1 the tip, in blade lengths) from the collar.
// Prevot, Aries & Monestiez 1991, Agronomie 11:491.
[[nodiscard]] double relative_blade_width(double s);

// Area of a flat blade over length times greatest width: the integral of relative_blade_width.
[[nodiscard]] double blade_form_factor();

// A blade lies along its midrib, a curve in the plane of `axis` and `outward`. The upper face looks towards the axis where
// the blade leaves it, and up where it has bent to the horizontal. Default values give a flat blade along `outward`.
struct Blade {
  glm::dvec3 collar_m{0.0};                       // where the midrib starts
  glm::dvec3 axis{0.0, 1.0, 0.0};                 // unit vector along the stem
  glm::dvec3 outward{1.0, 0.0, 0.0};              // unit vector, perpendicular to the axis, to the side that the blade grows to
  double length_m = 1.0;                          // of the midrib
  double width_m = 0.1;                           // greatest, along the curved surface from margin to margin
  double insertion_rad = std::numbers::pi / 2.0;  // from the axis to the midrib at the collar
  double bending_rad = 0.0;                       // turn of the midrib from the collar to the tip
  double bend_position = 0.7;                     // s at which two thirds of the bending are reached, in (0, 1)
  double bend_sharpness = 1.0;             // 1: bent evenly; more: straight at first, then bent over within a shorter length
  double fold_rad = 0.0;                   // each half is raised by this from the flat: the V of the cross-section
  double wrap_rad = 0.0;                   // half the angle that the blade embraces the stem with at the collar
  double opening_m = 0.05;                 // over this length from the collar the wrap opens into the V, to 1/e
  double wave_amplitude_m = 0.0;           // of the margins, where the blade is widest
  double wave_length_m = 0.1;              // along the midrib, of the shorter of two waves; the other is 1.5 times as long
  std::array<double, 2> wave_phase_rad{};  // of each margin
};

// A surface around a centre line that lies in a plane. It is open at its first ring; a last ring of radius 0 is a tip.
struct Tube {
  struct Ring {
    glm::dvec3 centre_m{0.0};
    double radius_m = 0.0;  // positive, but for a tip
  };
  std::vector<Ring> rings;                 // at least two, no two neighbours with the same centre
  glm::dvec3 plane_normal{1.0, 0.0, 0.0};  // unit vector perpendicular to the centre line
};

// How finely the surfaces are cut into triangles.
struct MaizeDetail {
  double blade_step_m = 0.014;  // length of the rows of triangles along a blade
  int strips_per_half = 4;      // strips from a blade's midrib to its margin
  int tube_sides = 8;
};

// The labels that new triangles get.
struct SurfaceLabel {
  std::uint32_t organ = 0;   // index into Mesh::organs
  std::uint32_t optics = 0;  // index into Mesh::optics_names
};

void add_blade(Mesh& mesh, const Blade& blade, const MaizeDetail& detail, SurfaceLabel label);

// Upper faces outwards. The cross-section is a regular polygon with the circle's perimeter, so that neither the area nor the
// mean silhouette (Cauchy's theorem) depends on the number of sides.
void add_tube(Mesh& mesh, const Tube& tube, const MaizeDetail& detail, SurfaceLabel label);

}  // namespace sunfleck
