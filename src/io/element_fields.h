#pragma once
// What is known of every triangle, as columns: made once, written by every exporter under the same names.

#include "transport/model.h"
#include "transport/result.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

namespace sunfleck {

// The light on a triangle. The names are endings of columns: BAND_direct_upper, ...
enum class LightColumn {
  direct_upper,
  direct_lower,
  sky_upper,
  sky_lower,
  indirect_upper,
  indirect_lower,
  total,  // incident on both faces, of all light
  absorbed,
  error  // half-width of the confidence interval of absorbed
};

[[nodiscard]] const char* ending(LightColumn column);  // direct_upper, ...
[[nodiscard]] const char* meaning(LightColumn column);

constexpr const char* light_units = "W m-2";  // of all of them, per one-sided area

struct LightValues {
  LightColumn column = LightColumn::total;
  std::string name;            // BAND_direct_upper, ...
  std::vector<double> values;  // [element], W m-2; NaN where there is no value: errors of too few hits
};

// Elements are numbered in the order of the files.
struct ElementFields {
  std::vector<std::uint32_t> plant;               // [element]
  std::vector<std::int32_t> rank;                 // [element]
  std::vector<std::int32_t> organ;                // [element], index into organ_names
  std::vector<std::int32_t> optics;               // [element], index into optics_names
  std::vector<double> area_m2;                    // [element], one-sided
  std::array<std::vector<double>, 3> centroid_m;  // [axis][element], in the scene's frame, after wrapping
  std::vector<std::string> organ_names;           // no two equal: leaf, stem, ...
  std::vector<std::string> optics_names;          // as the canopy's
  std::vector<std::vector<LightValues>> light;    // [band][column]: without sky columns where there is no sky

  [[nodiscard]] std::size_t size() const { return area_m2.size(); }
};

[[nodiscard]] ElementFields make_element_fields(const RadiationModel& model, const RadiationResult& result);
[[nodiscard]] ElementFields make_element_places(const Canopy& canopy);  // without light

// What the columns of numbers that do not depend on the band mean, for formats that say so beside them.
struct PlaceColumn {
  const char* name;
  const char* units;  // 1 for plain numbers
  const char* meaning;
};
constexpr PlaceColumn triangle_column{"triangle", "1", "number of the triangle, in the order of the files"};
constexpr PlaceColumn plant_column{"plant", "1", "number of the plant, 0 for soil"};
constexpr PlaceColumn rank_column{"rank", "1", "leaf number from the ground, 0 for organs without one"};
constexpr PlaceColumn organ_column{"organ", "1", "kind of organ"};
constexpr PlaceColumn optics_column{"optics", "1", "optics of the surface"};
constexpr PlaceColumn area_column{"area_m2", "m2", "one-sided area"};

// The corner of an element in the scene's frame. Where the canopy has no origin of its own, single precision holds it exactly.
[[nodiscard]] glm::dvec3 corner_m(const Canopy& canopy, std::size_t element, std::size_t corner);
[[nodiscard]] bool corners_fit_float(const Canopy& canopy);

}  // namespace sunfleck
