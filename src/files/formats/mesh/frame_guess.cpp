#include "files/formats/mesh/frame_guess.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace sunfleck {

namespace {

constexpr std::array<FileAxis, 3> every_axis = {FileAxis::x, FileAxis::y, FileAxis::z};
constexpr std::size_t least_leaf_pieces = 3;

int index_of(FileAxis axis) {
  return static_cast<int>(axis);
}

// Returns 1 for a lower bound at 0, falling to 0 where 0 is farther from it than 30 % of the extent.
double standing(const ShapeFigures& shape, FileAxis axis) {
  constexpr double farthest = 0.3;
  const int a = index_of(axis);
  const double extent = shape.hi[a] - shape.lo[a];
  return extent > 0.0 ? std::max(0.0, 1.0 - std::abs(shape.lo[a]) / extent / farthest) : 0.0;
}

double score_of(const ShapeFigures& shape, FileAxis axis) {
  const int a = index_of(axis);
  return shape.net_facing[a] + 0.5 * shape.facing[a] + 0.5 * standing(shape, axis);
}

std::string why_up(const ShapeFigures& shape, FileAxis up) {
  constexpr double least_net = 0.05;
  const int a = index_of(up);
  const bool has_net = shape.net_facing[a] >= least_net;
  const glm::dvec3& facing = has_net ? shape.net_facing : shape.facing;
  double others = 0.0;
  for (const FileAxis axis : every_axis)
    if (axis != up) others = std::max(others, facing[index_of(axis)]);
  return fmt::format("{}, {:.0f} % of the area faces along {} and at most {:.0f} % along another axis; {} {}",
                     has_net ? "net of opposite sides" : "either way round", 100.0 * facing[a], axis_name(up), 100.0 * others,
                     axis_name(up), standing(shape, up) > 0.5 ? "begins near 0" : fmt::format("begins at {:.4g}", shape.lo[a]));
}

void guess_up(const ShapeFigures& shape, FrameGuess& guess) {
  constexpr double sure_lead = 0.4, likely_lead = 0.15;
  std::array<FileAxis, 3> order = {FileAxis::y, FileAxis::z, FileAxis::x};  // where shapes do not tell, y before z
  std::stable_sort(order.begin(), order.end(), [&](FileAxis a, FileAxis b) { return score_of(shape, a) > score_of(shape, b); });
  const bool has_area = shape.facing != glm::dvec3(0.0);
  const double lead = has_area ? score_of(shape, order[0]) - score_of(shape, order[1]) : 0.0;
  guess.up = order[0];
  guess.other_up = order[1];
  guess.up_certainty = lead >= sure_lead ? Certainty::sure : lead >= likely_lead ? Certainty::likely : Certainty::unsure;
  guess.up_reason = has_area ? why_up(shape, guess.up) : "no triangle has an area";
}

double middle_extent(const ShapeFigures& shape) {
  const glm::dvec3 extent = shape.plant_hi - shape.plant_lo;
  return std::max(std::min(extent.x, extent.y), std::min(std::max(extent.x, extent.y), extent.z));
}

bool shows_leaves(const ShapeFigures& shape) {
  return shape.leaf_pieces >= least_leaf_pieces && shape.usual_leaf > 0.0;
}

// Returns how unusual a plant would be in this unit: the sum of its squared deviations in standard deviations.
double oddity_of(const ShapeFigures& shape, double metres_per_unit) {
  constexpr double usual_extent_m = 0.8, extent_deviation = 0.7;  // the deviations are of decimal logarithms
  constexpr double usual_leaf_m2 = 0.008, leaf_deviation = 0.8;
  const auto squared = [](double x) { return x * x; };
  const double extent_m = middle_extent(shape) * metres_per_unit;
  double oddity = extent_m > 0.0 ? squared(std::log10(extent_m / usual_extent_m) / extent_deviation) : 0.0;
  if (shows_leaves(shape))
    oddity += squared(std::log10(shape.usual_leaf * squared(metres_per_unit) / usual_leaf_m2) / leaf_deviation);
  return oddity;
}

std::string why_unit(const ShapeFigures& shape, double metres_per_unit, FileAxis up) {
  const glm::dvec3 extent_m = (shape.hi - shape.lo) * metres_per_unit;
  const int a = index_of(up);
  std::string why = fmt::format("then the mesh is {:.3g} m tall and {:.3g} x {:.3g} m wide", extent_m[a], extent_m[(a + 1) % 3],
                                extent_m[(a + 2) % 3]);
  if (shows_leaves(shape))
    why += fmt::format(", and half of the leaf area is in pieces of {:.3g} cm2 or more",
                       1e4 * shape.usual_leaf * metres_per_unit * metres_per_unit);
  return why;
}

void guess_unit(const ShapeFigures& shape, FrameGuess& guess) {
  constexpr double sure_lead = 9.2, likely_lead = 1.0;  // a likelihood ratio is exp(lead / 2)
  std::array<double, 3> order = {1.0, 0.01, 0.001};
  std::stable_sort(order.begin(), order.end(), [&](double a, double b) { return oddity_of(shape, a) < oddity_of(shape, b); });
  const double lead = oddity_of(shape, order[1]) - oddity_of(shape, order[0]);
  guess.metres_per_unit = order[0];
  guess.other_metres_per_unit = order[1];
  const bool sure = lead >= sure_lead && shows_leaves(shape);
  guess.unit_certainty = sure ? Certainty::sure : lead >= likely_lead ? Certainty::likely : Certainty::unsure;
  guess.unit_reason = why_unit(shape, guess.metres_per_unit, guess.up);
}

}  // namespace

std::string_view axis_name(FileAxis axis) {
  constexpr std::array<std::string_view, 3> names = {"x", "y", "z"};
  return names[static_cast<std::size_t>(axis)];
}

std::string_view certainty_name(Certainty certainty) {
  constexpr std::array<std::string_view, 4> names = {"known", "sure", "likely", "unsure"};
  return names[static_cast<std::size_t>(certainty)];
}

std::string unit_name(double metres_per_unit) {
  if (metres_per_unit == 1.0) return "metres";
  if (metres_per_unit == 0.01) return "centimetres";
  if (metres_per_unit == 0.001) return "millimetres";
  return fmt::format("units of {:.6g} m", metres_per_unit);
}

std::string FrameGuess::summary() const {
  const auto words = [](std::string_view best, Certainty certainty, std::string_view other) {
    if (certainty == Certainty::likely) return fmt::format("{} (probably)", best);
    return certainty == Certainty::unsure ? fmt::format("{} or {}", best, other) : std::string(best);
  };
  const std::string unit = words(unit_name(metres_per_unit), unit_certainty, unit_name(other_metres_per_unit));
  const std::string axis = words(axis_name(up), up_certainty, axis_name(other_up));
  const bool known = unit_certainty == Certainty::known && up_certainty == Certainty::known;
  return fmt::format("{} {}, {} up", known ? "is in" : "looks like", unit, axis);
}

FrameGuess guess_frame(const ShapeFigures& shape, const KnownFrame& known) {
  FrameGuess guess;
  guess_up(shape, guess);
  if (known.up) {
    guess.up = *known.up;
    guess.up_certainty = Certainty::known;
    guess.up_reason = known.reason;
  }
  guess_unit(shape, guess);
  if (known.metres_per_unit) {
    guess.metres_per_unit = *known.metres_per_unit;
    guess.unit_certainty = Certainty::known;
    guess.unit_reason = known.reason + ", " + why_unit(shape, guess.metres_per_unit, guess.up);
  }
  return guess;
}

}  // namespace sunfleck
