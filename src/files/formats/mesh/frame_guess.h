#pragma once
// Guesses the unit of a mesh and which of its axes points up, where its format does not say.

#include "files/formats/mesh/file_axis.h"

#include <cstddef>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <string_view>

namespace sunfleck {

// How far a guess can be trusted. `known` is no guess: the format defines it.
enum class Certainty { known, sure, likely, unsure };

[[nodiscard]] std::string_view axis_name(FileAxis axis);             // x, y, z
[[nodiscard]] std::string_view certainty_name(Certainty certainty);  // known, sure, likely, unsure
// Returns the plural name of a length: metres, centimetres, millimetres; "units of ... m" for any other.
[[nodiscard]] std::string unit_name(double metres_per_unit);

// Figures of a mesh as its file has it, on which the guess rests.
struct ShapeFigures {
  glm::dvec3 lo{0.0}, hi{0.0};              // box, file units
  glm::dvec3 net_facing{0.0};               // |sum of area * normal| / area along each axis, 0..1
  glm::dvec3 facing{0.0};                   // sum of |area * normal| / area along each axis, 0..1
  glm::dvec3 plant_lo{0.0}, plant_hi{0.0};  // box of what no name calls soil, structure or lamp; of everything if that is all
  std::size_t pieces = 0;
  std::size_t leaf_pieces = 0;  // by name or, where no name says leaf, by shape
  double usual_leaf = 0.0;      // file units squared: half of the area of these is in pieces of at least this area
};

// What the format defines; see frame_of_format.
struct KnownFrame {
  std::optional<FileAxis> up;
  std::optional<double> metres_per_unit;
  std::string reason;
};

struct FrameGuess {
  FileAxis up = FileAxis::y;
  Certainty up_certainty = Certainty::unsure;
  std::string up_reason;
  FileAxis other_up = FileAxis::z;  // the next best, for a guess that is not sure
  double metres_per_unit = 1.0;
  Certainty unit_certainty = Certainty::unsure;
  std::string unit_reason;
  double other_metres_per_unit = 0.01;  // the next best

  // Returns e.g. "looks like millimetres, z up", or "looks like centimetres or millimetres, y (probably) up".
  [[nodiscard]] std::string summary() const;
};

// Guesses what `known` leaves open.
//
// Up: leaves show the sky most of their area, on the same side of nearly all of them, and plants stand on 0. Each axis scores its
// net facing, half its facing, and up to half a point for a lower bound near 0; the highest score wins, and its lead decides
// the certainty, which is `unsure` for a mesh without area. Which of the two sides faces up does not matter, since some programs
// wind leaves downwards.
//
// Unit: metres, centimetres or millimetres, whichever makes plant and leaves most usual. The middle one of the three extents is
// taken as log-normal about 0.8 m (a factor of 5 is one standard deviation), the usual leaf about 80 cm2 (a factor of 6.3). Both
// laws were fitted to 16 meshes of a dozen species, from seedlings of 10 cm to maize stands of 3 m. `sure` is a unit that is a
// hundred times as likely as the next one, so that a plant of usual size in centimetres, which might be a tiny one in
// millimetres, is `likely`. In a mesh of fewer than three leaf pieces only the extents count, and nothing is sure.
[[nodiscard]] FrameGuess guess_frame(const ShapeFigures& shape, const KnownFrame& known);

}  // namespace sunfleck
