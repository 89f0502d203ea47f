#include "physics/bvh/references.h"

#include "base/error.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/common.hpp>
#include <limits>
#include <span>

namespace sunfleck {
namespace {

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

ImageRanges images_of(const Canopy& canopy, const Box& box, std::size_t element) {
  const glm::vec2 margin_m = border_margin_m(canopy);
  return {images_on_axis(box.lo.x, box.hi.x, canopy.period_m.x, margin_m.x, element),
          images_on_axis(box.lo.z, box.hi.z, canopy.period_m.y, margin_m.y, element)};
}

std::vector<Reference> make_references(const Canopy& canopy) {
  const std::span<const Triangle> own = canopy.corners.own();
  const std::vector<std::uint32_t> elements = canopy.corners.own_elements();
  std::uint64_t total = 0;
  for (std::size_t k = 0; k < own.size(); ++k) total += images_of(canopy, box_of(own[k]), elements[k]).count();
  if (total > max_references) {
    throw_input(fmt::format("canopy: {} triangles, counting the copies that reach into the plot", total),
                fmt::format("a tree holds at most {}", max_references),
                "place fewer plants, or enlarge plot.size if elements are larger than the plot");
  }
  std::vector<Reference> references;
  references.reserve(total);
  const std::vector<bool> copied = copied_elements(canopy.copies, canopy.size());
  for (std::size_t k = 0; k < own.size(); ++k) {
    if (copied[elements[k]] || !(area_m2(own[k]) > 0.0)) continue;
    append_images(references, elements[k], images_of(canopy, box_of(own[k]), elements[k]));
  }
  return references;
}

Box box_of(const Triangle& corners) {
  const auto& [a, b, c] = corners;
  return {glm::min(glm::min(a, b), c), glm::max(glm::max(a, b), c)};
}

BvhTriangle bvh_triangle(const Triangle& corners, std::uint32_t element, std::uint32_t image) {
  const auto& [a, b, c] = corners;
  return {{a.x, a.y, a.z}, element, {b.x, b.y, b.z}, image, {c.x, c.y, c.z}, 0};
}

BvhTriangle reference_triangle(const Canopy& canopy, const Reference& reference) {
  return bvh_triangle(reference_corners(canopy, reference), reference.element, pack_image(reference.dx, reference.dz));
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
