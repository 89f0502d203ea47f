#pragma once
// What the user of the window picks, how it is described, and how it is outlined in the picture.

#include "files/scene/scene_reader.h"
#include "physics/transport/model/result.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace sunfleck {

// What the user has picked: the organ of an element, or the element itself.
struct Pick {
  enum class What { organ, triangle };
  std::uint32_t element = 0;
  What what = What::organ;

  friend bool operator==(const Pick&, const Pick&) = default;
};

// The organ of a picked element, and the light it receives, W m-2 of its one-sided area, both faces together.
struct PickedOrgan {
  std::string organ, optics;
  std::int64_t plant = 0, rank = 0;
  std::size_t triangles = 0;
  double area_m2 = 0.0;
  Estimate sunlit_fraction, direct, indirect, absorbed;
};

// A picked element and the light it receives.
struct PickedElement {
  std::uint32_t element = 0;
  double area_m2 = 0.0;
  bool errors_known = false;  // false for a scene whose triangles are too many
  struct Face {
    double direct_w_m2 = 0.0, sky_w_m2 = 0.0, scattered_w_m2 = 0.0;  // incident
    double half_width_w_m2 = 0.0;                                    // of their sum; NaN if there are too few hits
    [[nodiscard]] double total_w_m2() const { return direct_w_m2 + sky_w_m2 + scattered_w_m2; }
  };
  Face upper, lower;
  double absorbed_w_m2 = 0.0, absorbed_half_width_w_m2 = 0.0;
};

// Return the light that an element receives in a band, and its organ.
[[nodiscard]] PickedElement describe_element(const Scene& scene, const RadiationResult& result, std::uint32_t element,
                                             std::size_t band);
[[nodiscard]] PickedOrgan describe_organ(const Scene& scene, const RadiationResult& result, std::uint32_t element,
                                         std::size_t band);

// Draws a line around the pixels that see the picked organ or triangle, outside of it. `surface` holds what each pixel sees;
// both are [row][column], `width` wide.
void outline_pick(const Pick& pick, const Canopy& canopy, std::span<const std::uint32_t> surface, int width,
                  std::span<std::uint32_t> pixels);

}  // namespace sunfleck
