#pragma once
// Lists the figures that are compared, and reads how the program states them.

#include "physics/transport/model/model.h"
#include "physics/transport/model/result.h"

#include <cstddef>
#include <string>
#include <vector>

namespace sunfleck::test::differential {

enum class Of {
  absorbed_vegetation,
  absorbed_structure,  // by structures and lamps
  absorbed_soil,
  reflected,
  transmitted,
  sunlit_leaves,
  sunlit_ground,
  organ_sunlit,
  organ_direct,
  organ_indirect,
  organ_absorbed,
  element_absorbed,
  side,  // all light on it
  row_ratio,
  row_sunlit,
  row_down,
  row_up,
  row_absorbed,
  row_structure,  // absorbed by structures and lamps in the row
  plane_ratio,
  plane_down,
  sensor_direct,
  sensor_sky,
  sensor_scattered
};

struct Figure {
  Of of = Of::reflected;
  std::size_t place = 0;  // organ, element, side, row of the profile, plane or sensor
  std::size_t band = 0;
};

// Returns every figure of a model's result: totals, organs, elements, sides, rows of the profile, planes and sensors.
[[nodiscard]] std::vector<Figure> figures_of(const RadiationModel& model);

[[nodiscard]] std::string name_of(const RadiationModel& model, const Figure& figure);

// A value and its standard error; NaN where none is stated.
struct Stated {
  double value = 0.0;
  double error = 0.0;
};

// Returns a figure as the program states it, with its error reduced by the part for unshot flux. `quantile` is that of the
// half-widths.
[[nodiscard]] Stated stated(const RadiationModel& model, const RadiationResult& result, const Figure& figure, double quantile);

}  // namespace sunfleck::test::differential
