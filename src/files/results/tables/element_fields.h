#pragma once
// The results of every triangle as columns, built once and written by every exporter under the same names.

#include "files/results/tables/table.h"
#include "physics/transport/model/model.h"
#include "physics/transport/model/result.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

namespace sunfleck {

// The light on a triangle. The names of the enumerators end the column names: BAND_direct_upper, ...
enum class LightColumn {
  direct_upper,
  direct_lower,
  sky_upper,
  sky_lower,
  indirect_upper,
  indirect_lower,
  total,  // all light incident on both faces
  absorbed,
  absorbed_error  // half-width of the confidence interval of absorbed
};

[[nodiscard]] const char* ending(LightColumn column);  // e.g. direct_upper
[[nodiscard]] const char* meaning(LightColumn column);

constexpr const char* light_units = "W m-2";  // unit of all light columns, per one-sided area

struct LightValues {
  LightColumn column = LightColumn::total;
  std::string name;            // BAND_direct_upper, ...
  std::vector<double> values;  // [element], W m-2; NaN where there is no value, as for errors from too few hits
};

// One value per element, in the order of the files.
struct ElementFields {
  std::vector<std::uint32_t> plant;               // [element]
  std::vector<std::int32_t> rank;                 // [element]
  std::vector<std::int32_t> organ;                // [element], index into organ_names
  std::vector<std::int32_t> optics;               // [element], index into optics_names
  std::vector<double> area_m2;                    // [element], one-sided
  std::array<std::vector<double>, 3> centroid_m;  // [axis][element], in the user's axes, after wrapping
  std::vector<std::string> organ_names;           // distinct names: leaf, stem, ...
  std::vector<std::string> optics_names;          // same as in the canopy
  std::vector<std::vector<LightValues>> light;    // [band][column]; there are no sky columns without a sky
  Axes axes = Axes::south_up_west;                // of the user

  [[nodiscard]] std::size_t size() const { return area_m2.size(); }
};

[[nodiscard]] ElementFields make_element_fields(const RadiationModel& model, const RadiationResult& result);
[[nodiscard]] ElementFields make_element_places(const RadiationModel& model);  // leaves `light` empty

// Returns the columns of the triangles, which are views of `fields`. The columns in_csv are those of triangles.csv.
[[nodiscard]] Table triangles_table(const ElementFields& fields);
[[nodiscard]] inline bool is_light(const Column& column) {
  return column.unit == light_units;
}

// Returns a corner of an element in the user's axes. Single precision holds it exactly in the scene's own axes if the canopy
// has no separate origin.
[[nodiscard]] glm::dvec3 corner_m(const RadiationModel& model, std::size_t element, std::size_t corner);
[[nodiscard]] bool corners_fit_float(const RadiationModel& model);

}  // namespace sunfleck
