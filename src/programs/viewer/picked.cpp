#include "programs/viewer/picked.h"

#include "files/results/tables/irradiance.h"
#include "files/results/tables/table.h"

#include <algorithm>
#include <limits>
#include <vector>

namespace sunfleck {
namespace {

constexpr std::uint32_t outline_colour = 0x00ff00c8;

PickedElement::Face face_of(const RadiationModel& model, const RadiationResult& result, std::size_t side, std::size_t band) {
  const std::size_t element = side / 2;
  const double area = area_m2(model.canopy.corners[element]);
  const Irradiance light = side_irradiance(model, result, side, area, band);
  PickedElement::Face face;
  face.direct_w_m2 = light.direct_w_m2;
  face.sky_w_m2 = light.sky_w_m2;
  face.scattered_w_m2 = light.scattered_w_m2();
  face.half_width_w_m2 = result.side_error.empty() ? std::numeric_limits<double>::quiet_NaN()
                                                   : result.side_error[side * model.bands.size() + band];
  return face;
}

}  // namespace

PickedElement describe_element(const Scene& scene, const RadiationResult& result, std::uint32_t element, std::size_t band) {
  const RadiationModel& model = scene.model;
  const SurfaceOptics& optics = model.optics[model.canopy.optics_of[element]];
  PickedElement picked;
  picked.element = element;
  picked.errors_known = !result.side_error.empty();
  picked.area_m2 = area_m2(model.canopy.corners[element]);
  picked.upper = face_of(model, result, 2 * std::size_t{element}, band);
  picked.lower = face_of(model, result, 2 * std::size_t{element} + 1, band);
  picked.absorbed_w_m2 = absorbed_w_m2(optics, picked.upper.total_w_m2(), picked.lower.total_w_m2(), band);
  picked.absorbed_half_width_w_m2 = result.element_error.empty() ? std::numeric_limits<double>::quiet_NaN()
                                                                 : result.element_error[band * model.canopy.size() + element];
  return picked;
}

PickedOrgan describe_organ(const Scene& scene, const RadiationResult& result, std::uint32_t element, std::size_t band) {
  const Canopy& canopy = scene.model.canopy;
  const std::uint32_t number = canopy.organ_of[element];
  const OrganResult& light = result.organs[number];
  PickedOrgan picked;
  picked.organ = canopy.organs[number].name;
  picked.plant = canopy.organs[number].plant;
  picked.rank = canopy.organs[number].rank;
  picked.optics = scene.model.optics[canopy.optics_of[element]].name;
  for (std::size_t e = 0; e < canopy.size(); ++e) picked.triangles += canopy.organ_of[e] == number ? 1 : 0;
  picked.area_m2 = light.area_m2;
  picked.sunlit_fraction = as_share(light.sunlit_fraction);
  picked.direct = light.direct[band];
  picked.indirect = light.indirect[band];
  picked.absorbed = light.absorbed[band];
  return picked;
}

void outline_pick(const Pick& pick, const Canopy& canopy, std::span<const std::uint32_t> surface, int width,
                  std::span<std::uint32_t> pixels) {
  const int height = static_cast<int>(surface.size()) / width;
  const auto is_picked = [&](std::uint32_t seen) {
    const std::size_t element = seen / 2;
    if (element >= canopy.size()) return false;
    if (pick.what == Pick::What::triangle) return element == pick.element;
    return canopy.organ_of[element] == canopy.organ_of[pick.element];
  };
  const int reach = std::max(1, height / 400);  // px
  const auto at = [&](int row, int column) {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(width) + static_cast<std::size_t>(column);
  };
  std::vector<char> inside(surface.size());
  std::transform(surface.begin(), surface.end(), inside.begin(), is_picked);
  for (int row = 0; row < height; ++row) {
    for (int column = 0; column < width; ++column) {
      if (!inside[at(row, column)]) continue;
      for (int y = std::max(0, row - reach); y <= std::min(height - 1, row + reach); ++y) {
        for (int x = std::max(0, column - reach); x <= std::min(width - 1, column + reach); ++x) {
          if (!inside[at(y, x)]) pixels[at(y, x)] = outline_colour;
        }
      }
    }
  }
}

}  // namespace sunfleck
