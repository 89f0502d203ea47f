#pragma once
// The sunlit shares of single elements, from the points that were asked and from the beam's landings.

#include "physics/transport/model/exposure.h"
#include "physics/transport/triangles/shadow_points.h"
#include "physics/transport/triangles/triangle_sums.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace sunfleck {

struct BeamLight {
  std::vector<double> landings;  // [element], expected in all replicates
  std::vector<double> variance;  // [element], of that number
};

class BeamShares {
 public:
  // All arguments must outlive the object. `areas_m2` is [element], 0 where no light comes.
  BeamShares(const BeamExposure& exposure, const TriangleSums& sums, const std::vector<double>& areas_m2)
      : exposure_(exposure), sums_(sums), areas_m2_(areas_m2) {}

  // Returns the number of landings expected on an element in full sun, in that many replicates.
  [[nodiscard]] double landings_in_sun(std::size_t element, std::size_t replicates) const;

  // Returns the elements on which the beam landed although none of their points sees the sun.
  [[nodiscard]] std::vector<std::uint32_t> doubted(std::span<const ElementShade> shades) const;

  // Joins the shares of both sources by their variances. That of landings follows from the difference between the halves of the
  // run; that of points, for each kind of shade, from how far they scatter around the landings.
  [[nodiscard]] BeamLight join(std::span<const ElementShade> shades) const;

 private:
  [[nodiscard]] double seen_share(std::size_t element) const;
  [[nodiscard]] double landing_spread(std::span<const ElementShade> shades) const;
  [[nodiscard]] std::vector<double> point_variance(std::span<const ElementShade> shades, double spread) const;

  const BeamExposure& exposure_;
  const TriangleSums& sums_;
  const std::vector<double>& areas_m2_;
};

}  // namespace sunfleck
