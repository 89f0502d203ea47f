#pragma once
// What a picture can show of a result: one number per surface.

#include "physics/transport/model/counters.h"
#include "physics/transport/model/model.h"
#include "physics/transport/model/result.h"
#include "pictures/charts/picture.h"
#include "pictures/drawing/colour_scale.h"

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

namespace sunfleck {

// Returns the field's title with its unit, for the heading of a legend: "Direct PAR irradiance, W m⁻²", or with both faces
// together "Direct PAR irradiance, W m⁻² (both faces)".
[[nodiscard]] std::string field_title(LightField field, const std::string& band, bool of_both_faces = false);

// Returns true if the scene has this light: a beam, a sky, or anything that scatters or emits light.
[[nodiscard]] bool has_field(const RadiationModel& model, LightField field);

// Arrays are [surface number]: side 2 * element + face of every element, then the cells of the soil's map.
struct FieldValues {
  std::vector<double> w_m2;                                          // 0 where the area is 0
  std::vector<double> area_m2;                                       // one-sided
  std::size_t first_cell = std::numeric_limits<std::size_t>::max();  // surface number of the soil's first cell
};

// Returns the values of a field. Irradiance is that incident on the side. Absorbed flux is the sum of both faces per one-sided
// area, and is given for both; for the soil it is what the cell absorbs. `layout` is the model's and `result` is of the same
// model.
[[nodiscard]] FieldValues field_values(const RadiationModel& model, const CounterLayout& layout, const RadiationResult& result,
                                       std::size_t band, LightField field);

// Returns the values that rank charts divide into classes. Both sides of an element have the light of its two faces together, and
// `area_m2` counts each element once, as its upper side, if it is vegetation; soil and structures have an area only in a scene
// without vegetation.
[[nodiscard]] FieldValues leaf_values(const RadiationModel& model, FieldValues of_sides, LightField field);

// Returns a thousandth of the light from above and from lamps, per ground area: leaves with less are unlit. Of direct light it
// is a thousandth of the beam, of the sky's a thousandth of the sky.
[[nodiscard]] double lit_from_w_m2(const RadiationModel& model, std::size_t band, LightField field);

// Returns the largest irradiance that a side, or both faces of an element together, can have from that light; infinite where
// there is no such limit. It is the sum of the beam on a plane that faces it, of all light of the sky, as on a sphere
// (Sky::spherical_irradiance), and of what surfaces send: with a the largest share that a side sends on (reflected, or transmitted
// from the other side), a / (1 - a) of the other two on each face. There is no limit with lamps, or if a = 1.
[[nodiscard]] double largest_possible_w_m2(const RadiationModel& model, std::size_t band, LightField field, int faces);

// Returns that limit for the level ground: the light from above on open ground, and what surfaces send as above.
[[nodiscard]] double largest_on_soil_w_m2(const RadiationModel& model, std::size_t band, LightField field);

// Returns the reflectance in red, green and blue, [surface number].
[[nodiscard]] std::vector<Colour> surface_reflectance(const RadiationModel& model, const CounterLayout& layout);

}  // namespace sunfleck
