#include "physics/bvh/references.h"

#include "base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace sunfleck {
namespace {

constexpr std::uint64_t max_references = std::uint64_t{1} << 31U;

// The period numbers first..last of the copies that reach into the enlarged plot.
struct ImageRange {
  int first = 0;
  int last = 0;
};

struct ImageRanges {
  ImageRange x, z;

  [[nodiscard]] std::uint64_t count() const {
    return static_cast<std::uint64_t>(x.last - x.first + 1) * static_cast<std::uint64_t>(z.last - z.first + 1);
  }
  [[nodiscard]] bool holds_origin() const { return x.first <= 0 && x.last >= 0 && z.first <= 0 && z.last >= 0; }
};

// Returns the images with lo + n * period <= period + margin and hi + n * period >= -margin.
ImageRange images_on_axis(float lo_m, float hi_m, double period_m, double margin_m, std::size_t element) {
  if (period_m == 0.0) return {};
  const double first = std::ceil((-margin_m - hi_m) / period_m);
  const double last = std::floor((period_m + margin_m - lo_m) / period_m);
  constexpr double limit = std::numeric_limits<std::int16_t>::max();
  if (!(first >= -limit && last <= limit)) {
    throw_input(fmt::format("plot.size: element {} reaches over {:.0f} periods of {} m", element, last - first + 1.0, period_m),
                fmt::format("a copy may lie at most {:.0f} periods away", limit),
                "enlarge plot.size, leave this element out, or set plot.periodic = false");
  }
  return {static_cast<int>(first), static_cast<int>(last)};
}

ImageRanges images_of(const Canopy& canopy, std::size_t element, glm::vec2 margin_m) {
  const auto& [a, b, c] = canopy.corners[element];
  const auto [lo_x, hi_x] = std::minmax({a.x, b.x, c.x});
  const auto [lo_z, hi_z] = std::minmax({a.z, b.z, c.z});
  return {images_on_axis(lo_x, hi_x, canopy.period_m.x, margin_m.x, element),
          images_on_axis(lo_z, hi_z, canopy.period_m.y, margin_m.y, element)};
}

void append_images(std::vector<Reference>& references, std::size_t element, const ImageRanges& images) {
  const auto append = [&](int dx, int dz) {
    references.push_back({static_cast<std::uint32_t>(element), static_cast<std::int16_t>(dx), static_cast<std::int16_t>(dz)});
  };
  if (images.holds_origin()) append(0, 0);
  for (int dz = images.z.first; dz <= images.z.last; ++dz) {
    for (int dx = images.x.first; dx <= images.x.last; ++dx) {
      if (dx != 0 || dz != 0) append(dx, dz);
    }
  }
}

}  // namespace

glm::vec2 border_margin_m(const Canopy& canopy) {
  constexpr double share = 1.0 / (1 << 18);
  return {static_cast<float>(canopy.period_m.x * share), static_cast<float>(canopy.period_m.y * share)};
}

std::vector<Reference> make_references(const Canopy& canopy) {
  const glm::vec2 margin_m = border_margin_m(canopy);
  std::uint64_t total = 0;
  for (std::size_t element = 0; element < canopy.size(); ++element) total += images_of(canopy, element, margin_m).count();
  if (total > max_references) {
    throw_input(fmt::format("canopy: {} triangles, counting the copies that reach into the plot", total),
                fmt::format("a tree holds at most {}", max_references),
                "place fewer plants, or enlarge plot.size if elements are larger than the plot");
  }
  std::vector<Reference> references;
  references.reserve(total);
  const std::vector<bool> copied = copied_elements(canopy.copies, canopy.size());
  for (std::size_t element = 0; element < canopy.size(); ++element) {
    if (copied[element] || !(area_m2(canopy.corners[element]) > 0.0)) continue;
    append_images(references, element, images_of(canopy, element, margin_m));
  }
  return references;
}

Triangle reference_corners(const Canopy& canopy, const Reference& reference) {
  Triangle corners = canopy.corners[reference.element];
  for (glm::vec3& corner : corners) {
    corner.x = static_cast<float>(corner.x + reference.dx * canopy.period_m.x);
    corner.z = static_cast<float>(corner.z + reference.dz * canopy.period_m.y);
  }
  return corners;
}

}  // namespace sunfleck
