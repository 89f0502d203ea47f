#pragma once
// The sunlit share of each element, from points spread over it that are asked whether they see the sun.

#include "physics/transport/model/counters.h"
#include "physics/transport/model/exposure.h"
#include "physics/transport/model/model.h"
#include "physics/transport/model/tracer.h"
#include "physics/transport/triangles/surface_tree.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace sunfleck {

// What the points showed of an element; the error of its share depends on that.
enum class ShadeKind : std::uint8_t {
  unasked,      // the beam cannot hit the element
  inner_shade,  // no point of it or of its neighbours sees the sun
  inner_light,  // all of them do
  edge_shade,   // no point of it sees the sun, but one of a neighbour does
  edge_light,   // all of its points see the sun, but one of a neighbour does not
  found,        // mixed, which only additional points showed
  doubted,      // the beam landed on it, although none of its first points sees the sun: it has more of them
  mixed
};
inline constexpr std::size_t shade_kinds = 8;

struct ElementShade {
  float share = 0.0F;  // of its points that see the sun
  std::uint16_t points = 0;
  ShadeKind kind = ShadeKind::unasked;
};

// Returns the shade of every element, [element]; nothing if stopped. Each element that the beam can hit gets four points of an
// additive sequence (Roberts' R2), 24 more where they disagree, and eight more where those of neighbours do. Neighbours are
// the elements in ranges of up to eight in `tree`, which must hold all such elements. Points of one element that lie below
// the soil are in the shade.
[[nodiscard]] std::optional<std::vector<ElementShade>> ask_shadow_points(const RadiationModel& model,
                                                                         const CounterLayout& layout,
                                                                         const BeamExposure& exposure, const SurfaceTree& tree,
                                                                         Tracer& tracer, std::uint64_t seed,
                                                                         const StopQuestion& stop);

// Asks further points of some elements, as many in all as for elements whose own disagree, and makes them `doubted`. Returns
// false if stopped.
[[nodiscard]] bool ask_doubted(const RadiationModel& model, const CounterLayout& layout,
                               std::span<const std::uint32_t> elements, Tracer& tracer, std::uint64_t seed,
                               const StopQuestion& stop, std::vector<ElementShade>& shades);

}  // namespace sunfleck
