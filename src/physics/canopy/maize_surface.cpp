#include "physics/canopy/maize_surface.h"

#include "base/check.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

namespace sunfleck {
namespace {

using std::numbers::pi;

// Prevot et al. 1991: relative width = alpha s^2 + beta s + gamma, with beta and gamma such that its maximum is 1 and its
// value at the tip is 0; alpha is about -2.3 for maize.
constexpr double prevot_alpha = -2.3;

struct Frame {
  glm::dvec3 position;
  glm::dvec3 along;     // tangent of the midrib
  glm::dvec3 normal;    // of the upper face
  glm::dvec3 sideways;  // along x sideways = normal
};

void add_triangle(Mesh& mesh, const glm::uvec3& corners, SurfaceLabel label) {
  mesh.triangles.push_back(corners);
  mesh.organ_of.push_back(label.organ);
  mesh.optics_of.push_back(label.optics);
}

std::uint32_t add_vertex(Mesh& mesh, const glm::dvec3& position) {
  mesh.vertices.push_back(position);
  return static_cast<std::uint32_t>(mesh.vertices.size() - 1);
}

// Returns the angle from the axis to the midrib. The odds of the share of the bending reached at s, share / (1 - share), are
// a power of the odds of s and equal 2 (two thirds of the bending) at bend_position.
double midrib_angle(const Blade& blade, double s) {
  const double m = blade.bend_position;
  const double bent = std::pow(s * (1.0 - m), blade.bend_sharpness) * 2.0;
  const double straight = std::pow((1.0 - s) * m, blade.bend_sharpness);
  return blade.insertion_rad + blade.bending_rad * bent / (bent + straight);
}

glm::dvec3 midrib_tangent(const Blade& blade, double s) {
  const double angle = midrib_angle(blade, s);
  return std::sin(angle) * blade.outward + std::cos(angle) * blade.axis;
}

// Returns the frames at s = 0, 1/segments, ..., 1.
std::vector<Frame> midrib_frames(const Blade& blade, int segments) {
  constexpr int substeps = 8;  // midpoint rule: the error at the tip is then 1e-5 of the length even with few segments
  const double step = 1.0 / (segments * substeps);
  std::vector<Frame> frames;
  glm::dvec3 position = blade.collar_m;
  for (int row = 0; row <= segments; ++row) {
    const double angle = midrib_angle(blade, static_cast<double>(row) / segments);
    const glm::dvec3 along = std::sin(angle) * blade.outward + std::cos(angle) * blade.axis;
    const glm::dvec3 normal = -std::cos(angle) * blade.outward + std::sin(angle) * blade.axis;
    frames.push_back({position, along, normal, glm::cross(normal, along)});
    for (int k = 0; k < substeps; ++k) {
      position += blade.length_m * step * midrib_tangent(blade, (row * substeps + k + 0.5) * step);
    }
  }
  return frames;
}

// Returns the undulation of a margin, between -1 and 1. Two waves of different lengths keep it from looking like a sine
// curve.
double margin_wave(const Blade& blade, double s, int side) {
  constexpr double length_ratio = 1.5;
  const double phase = blade.wave_phase_rad[side < 0 ? 0 : 1];
  const double turns = 2.0 * pi * s * blade.length_m / blade.wave_length_m;
  return 0.5 * (std::sin(turns + phase) + std::sin(turns / length_ratio - phase));
}

// Returns the vertices of one half of a cross-section without the midrib, from the vertex next to it to the margin. `side`
// is -1 or +1, along frame.sideways.
std::vector<glm::dvec3> half_section(const Blade& blade, const Frame& frame, double s, int side, int strips) {
  const double width = relative_blade_width(s);
  const double opened = 1.0 - std::exp(-s * blade.length_m / blade.opening_m);
  const double wrap = blade.wrap_rad * (1.0 - opened);
  const double fold = blade.fold_rad * opened * (1.0 - s);
  const double wave = blade.wave_amplitude_m * width * opened * margin_wave(blade, s, side);
  const double strip = 0.5 * blade.width_m * width / strips;

  std::vector<glm::dvec3> points;
  glm::dvec2 section(0.0);
  for (int j = 1; j <= strips; ++j) {
    // A chain of chords, each turned further by the wrap, keeps the width that the profile gives.
    const double turn = fold + wrap * (j - 0.5) / strips;
    section += strip * glm::dvec2(std::cos(turn), std::sin(turn));
    const double to_margin = static_cast<double>(j) / strips;
    points.push_back(frame.position + side * section.x * frame.sideways +
                     (section.y + wave * to_margin * to_margin) * frame.normal);
  }
  return points;
}

// Adds a row of 2 * strips + 1 vertices, from margin to margin.
void add_row(Mesh& mesh, const Blade& blade, const Frame& frame, double s, int strips) {
  const auto left = half_section(blade, frame, s, -1, strips);
  const auto right = half_section(blade, frame, s, +1, strips);
  mesh.vertices.insert(mesh.vertices.end(), left.rbegin(), left.rend());
  mesh.vertices.push_back(frame.position);
  mesh.vertices.insert(mesh.vertices.end(), right.begin(), right.end());
}

}  // namespace

double relative_blade_width(double s) {
  const double root = std::sqrt(-prevot_alpha);
  const double beta = -2.0 * (prevot_alpha + root);
  const double gamma = 2.0 * root + prevot_alpha;
  return (prevot_alpha * s + beta) * s + gamma;
}

double blade_form_factor() {
  return prevot_alpha / 3.0 + std::sqrt(-prevot_alpha);
}

void add_blade(Mesh& mesh, const Blade& blade, const MaizeDetail& detail, SurfaceLabel label) {
  EXPECT(blade.length_m, >, 0.0);
  EXPECT(blade.width_m, >, 0.0);
  constexpr int fewest_segments = 4;
  const int segments = std::max(fewest_segments, static_cast<int>(std::lround(blade.length_m / detail.blade_step_m)));
  const auto frames = midrib_frames(blade, segments);
  const auto strips = static_cast<std::uint32_t>(2 * detail.strips_per_half);
  auto row_start = static_cast<std::uint32_t>(mesh.vertices.size());
  for (int row = 0; row < segments; ++row) {
    add_row(mesh, blade, frames[row], static_cast<double>(row) / segments, detail.strips_per_half);
  }
  const std::uint32_t tip = add_vertex(mesh, frames[segments].position);

  for (int row = 0; row + 1 < segments; ++row, row_start += strips + 1) {
    const std::uint32_t next_start = row_start + strips + 1;
    for (std::uint32_t j = 0; j < strips; ++j) {
      add_triangle(mesh, {row_start + j, next_start + j, next_start + j + 1}, label);
      add_triangle(mesh, {row_start + j, next_start + j + 1, row_start + j + 1}, label);
    }
  }
  for (std::uint32_t j = 0; j < strips; ++j) add_triangle(mesh, {row_start + j, tip, row_start + j + 1}, label);
}

void add_tube(Mesh& mesh, const Tube& tube, const MaizeDetail& detail, SurfaceLabel label) {
  const auto& rings = tube.rings;
  EXPECT(rings.size(), >=, 2U);
  EXPECT(detail.tube_sides, >=, 3);
  const auto sides = static_cast<std::uint32_t>(detail.tube_sides);
  const double same_perimeter = (pi / sides) / std::sin(pi / sides);
  std::uint32_t previous = 0;
  for (std::size_t i = 0; i < rings.size(); ++i) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    const bool is_tip = rings[i].radius_m == 0.0;
    if (is_tip) {
      add_vertex(mesh, rings[i].centre_m);
    } else {
      const glm::dvec3& before = rings[i == 0 ? 0 : i - 1].centre_m;
      const glm::dvec3& after = rings[std::min(i + 1, rings.size() - 1)].centre_m;
      const glm::dvec3 u = glm::normalize(glm::cross(tube.plane_normal, after - before));
      for (std::uint32_t j = 0; j < sides; ++j) {
        const double angle = 2.0 * pi * j / sides;
        add_vertex(mesh, rings[i].centre_m +
                             same_perimeter * rings[i].radius_m * (std::cos(angle) * tube.plane_normal + std::sin(angle) * u));
      }
    }
    for (std::uint32_t j = 0; i > 0 && j < sides; ++j) {
      const std::uint32_t k = (j + 1) % sides;
      if (is_tip) {
        add_triangle(mesh, {previous + j, first, previous + k}, label);
      } else {
        add_triangle(mesh, {previous + j, first + j, first + k}, label);
        add_triangle(mesh, {previous + j, first + k, previous + k}, label);
      }
    }
    previous = first;
  }
}

}  // namespace sunfleck
