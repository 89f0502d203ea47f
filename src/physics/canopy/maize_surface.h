#pragma once
// The surfaces of a maize plant, leaf blades and tapering tubes, and their triangles.

#include "physics/canopy/mesh.h"

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <numbers>
#include <vector>

namespace sunfleck {

// Returns the width of a blade relative to its greatest width, at the distance s from the collar in blade lengths (0 the
// collar, 1 the tip). Prevot, Aries & Monestiez 1991, Agronomie 11:491.
[[nodiscard]] double relative_blade_width(double s);

// Returns the area of a flat blade relative to length times greatest width: the integral of relative_blade_width.
[[nodiscard]] double blade_form_factor();

// A blade along its midrib, a curve in the plane of `axis` and `outward`. The upper face looks towards the axis where the
// blade leaves it, and up where the blade has bent to the horizontal. Default values give a flat blade along `outward`.
struct Blade {
  glm::dvec3 collar_m{0.0};        // start of the midrib
  glm::dvec3 axis{0.0, 1.0, 0.0};  // unit vector along the stem
  // Unit vector perpendicular to the axis, towards the side on which the blade grows.
  glm::dvec3 outward{1.0, 0.0, 0.0};
  double length_m = 1.0;                          // of the midrib
  double width_m = 0.1;                           // greatest width, along the curved surface from margin to margin
  double insertion_rad = std::numbers::pi / 2.0;  // angle from the axis to the midrib at the collar
  double bending_rad = 0.0;                       // turn of the midrib from the collar to the tip
  double bend_position = 0.7;                     // s at which two thirds of the bending are reached, in (0, 1)
  // 1: uniform bending; more: straight at first, then bent over within a shorter length.
  double bend_sharpness = 1.0;
  double fold_rad = 0.0;          // angle by which each half is raised from the flat: the V of the cross-section
  double wrap_rad = 0.0;          // half the angle over which the blade wraps the stem at the collar
  double opening_m = 0.05;        // length from the collar over which the wrap opens into the V, to 1/e
  double wave_amplitude_m = 0.0;  // of the margins, where the blade is widest
  // Length along the midrib of the shorter of two waves; the other is 1.5 times as long.
  double wave_length_m = 0.1;
  std::array<double, 2> wave_phase_rad{};  // of each margin
};

// A surface around a centre line that lies in a plane. It is open at its first ring; a last ring of radius 0 is a tip.
struct Tube {
  struct Ring {
    glm::dvec3 centre_m{0.0};
    double radius_m = 0.0;  // positive, except at a tip
  };
  std::vector<Ring> rings;                 // at least two, no two neighbours with the same centre
  glm::dvec3 plane_normal{1.0, 0.0, 0.0};  // unit vector perpendicular to the centre line
};

// The fineness of the triangles.
struct MaizeDetail {
  double blade_step_m = 0.014;  // length of the rows of triangles along a blade
  int strips_per_half = 4;      // strips from a blade's midrib to its margin
  int tube_sides = 8;
};

// The organ and optics of new triangles.
struct SurfaceLabel {
  std::uint32_t organ = 0;   // index into Mesh::organs
  std::uint32_t optics = 0;  // index into Mesh::optics_names
};

void add_blade(Mesh& mesh, const Blade& blade, const MaizeDetail& detail, SurfaceLabel label);

// Adds the triangles of a tube, upper faces outwards. The cross-section is a regular polygon with the circle's perimeter, so
// that neither the area nor the mean silhouette (Cauchy's theorem) depends on the number of sides.
void add_tube(Mesh& mesh, const Tube& tube, const MaizeDetail& detail, SurfaceLabel label);

}  // namespace sunfleck
