#include "programs/viewer/compass.h"

#include "pictures/drawing/chart.h"

#include <imgui.h>

#include <array>
#include <cfloat>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <numbers>

namespace sunfleck {
namespace {

constexpr ImU32 face_colour = IM_COL32(255, 255, 255, 255);
constexpr ImU32 rim_colour = IM_COL32(70, 70, 70, 255);
constexpr ImU32 north_colour = IM_COL32(190, 25, 13, 255);
constexpr ImU32 sun_colour = IM_COL32(250, 190, 0, 255);
constexpr double right_angle = 0.5 * std::numbers::pi;

// Cosine of the angle to the vertical above which a view counts as straight down or up.
constexpr double steep = 0.99;

}  // namespace

glm::dvec2 place_on_compass(const Camera& camera, double azimuth_rad, double elevation_rad) {
  const glm::dvec3 level = std::abs(camera.forward.y) > steep ? camera.up : camera.forward;
  const glm::dvec3 ahead = glm::normalize(glm::dvec3(level.x, 0.0, level.z));
  const glm::dvec3 right = glm::normalize(glm::dvec3(camera.right.x, 0.0, camera.right.z));
  const glm::dvec3 towards(-std::cos(azimuth_rad), 0.0, -std::sin(azimuth_rad));  // north is -X, east is -Z
  return (1.0 - elevation_rad / right_angle) * glm::dvec2(glm::dot(towards, right), glm::dot(towards, ahead));
}

CompassPlace compass_place(float left_px, float width_px, float height_px) {
  const NorthArrowPlace arrow = north_arrow_place(width_px, height_px);
  const float reach = 1.15F * static_cast<float>(arrow.radius_px);
  return {{left_px + static_cast<float>(arrow.centre_px.x), static_cast<float>(arrow.centre_px.y)}, 0.68F * reach, reach};
}

void draw_compass(const CompassPlace& place, const Camera& camera, const std::optional<SunPosition>& sun) {
  ImDrawList& canvas = *ImGui::GetBackgroundDrawList();
  ImFont& font = *ImGui::GetFont();
  const ImVec2 centre(place.centre_px.x, place.centre_px.y);
  const auto at = [&](double azimuth_rad, double elevation_rad, double reach) {
    const glm::dvec2 on = reach * place.radius_px * place_on_compass(camera, azimuth_rad, elevation_rad);
    return ImVec2(centre.x + static_cast<float>(on.x), centre.y - static_cast<float>(on.y));
  };
  canvas.AddCircleFilled(centre, place.reach_px, face_colour);
  canvas.AddCircle(centre, place.radius_px, rim_colour, 0, 1.5F);
  constexpr std::array letters{"N", "E", "S", "W"};
  for (std::size_t i = 0; i < letters.size(); ++i) {
    const double azimuth_rad = static_cast<double>(i) * right_angle;
    const ImU32 colour = i == 0 ? north_colour : rim_colour;
    canvas.AddLine(at(azimuth_rad, 0.0, 0.8), at(azimuth_rad, 0.0, 1.0), colour, 2.0F);
    const float size_px = 0.36F * place.radius_px;
    const ImVec2 size = font.CalcTextSizeA(size_px, FLT_MAX, 0.0F, letters[i]);
    const ImVec2 middle = at(azimuth_rad, 0.0, 1.22);
    canvas.AddText(&font, size_px, {middle.x - 0.5F * size.x, middle.y - 0.5F * size.y}, colour, letters[i]);
  }
  if (!sun || !(sun->elevation_rad > 0.0)) return;
  const ImVec2 shown = at(sun->azimuth_rad, sun->elevation_rad, 1.0);
  canvas.AddCircleFilled(shown, 0.16F * place.radius_px, sun_colour);
  canvas.AddCircle(shown, 0.16F * place.radius_px, rim_colour, 0, 1.0F);
}

}  // namespace sunfleck
