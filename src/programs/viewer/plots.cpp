#include "programs/viewer/plots.h"

#include <imgui.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

namespace sunfleck {
namespace {

constexpr ImU32 axis_colour = IM_COL32(90, 90, 90, 255);
constexpr ImU32 fleck_colour = IM_COL32(214, 120, 0, 255);
constexpr ImU32 fleck_band = IM_COL32(214, 120, 0, 60);
constexpr ImU32 down_colour = IM_COL32(0, 90, 180, 255);
constexpr ImU32 down_band = IM_COL32(0, 90, 180, 50);

// Maps a share 0..1 and a height 0..1 to pixels.
struct PlotArea {
  ImVec2 lo, hi;
  [[nodiscard]] ImVec2 at(double share, double height) const {
    return {lo.x + (hi.x - lo.x) * static_cast<float>(std::clamp(share, 0.0, 1.0)),
            hi.y - (hi.y - lo.y) * static_cast<float>(std::clamp(height, 0.0, 1.0))};
  }
};

struct Curve {
  std::function<Estimate(const LayerResult&)> value;
  double whole = 1.0;
  ImU32 line = 0, band = 0;
};

void draw_curve(const PlotArea& area, const std::vector<LayerResult>& layers, const Curve& curve) {
  ImDrawList& canvas = *ImGui::GetWindowDrawList();
  const double top = layers.back().height_m;
  if (!(curve.whole > 0.0) || !(top > 0.0)) return;
  for (std::size_t i = 0; i + 1 < layers.size(); ++i) {
    const Estimate a = curve.value(layers[i]);
    const Estimate b = curve.value(layers[i + 1]);
    if (std::isnan(a.value) || std::isnan(b.value)) continue;
    const double height_a = layers[i].height_m / top;
    const double height_b = layers[i + 1].height_m / top;
    const double half_a = std::isnan(a.half_width) ? 0.0 : a.half_width;
    const double half_b = std::isnan(b.half_width) ? 0.0 : b.half_width;
    canvas.AddQuadFilled(
        area.at((a.value - half_a) / curve.whole, height_a), area.at((a.value + half_a) / curve.whole, height_a),
        area.at((b.value + half_b) / curve.whole, height_b), area.at((b.value - half_b) / curve.whole, height_b), curve.band);
    canvas.AddLine(area.at(a.value / curve.whole, height_a), area.at(b.value / curve.whole, height_b), curve.line, 2.0F);
  }
}

}  // namespace

void draw_profile(const std::vector<LayerResult>& layers, std::size_t band, float width_px) {
  if (layers.size() < 2) return;
  const float line = ImGui::GetTextLineHeight();
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const float height_px = 9.0F * line;
  const PlotArea area{{corner.x + 2.6F * line, corner.y + 0.3F * line},
                      {corner.x + width_px - 0.5F * line, corner.y + height_px - 1.4F * line}};
  ImDrawList& canvas = *ImGui::GetWindowDrawList();
  canvas.AddRect(area.lo, area.hi, axis_colour);
  const double above = layers.back().down[band].value;
  draw_curve(area, layers, {[&](const LayerResult& layer) { return layer.down[band]; }, above, down_colour, down_band});
  draw_curve(area, layers, {[](const LayerResult& layer) { return layer.sunfleck_ratio; }, 1.0, fleck_colour, fleck_band});
  const std::string top = fmt::format("{:.2f} m", layers.back().height_m);
  canvas.AddText({corner.x, area.lo.y}, axis_colour, top.c_str());
  canvas.AddText({corner.x, area.hi.y - line}, axis_colour, "0");
  canvas.AddText({area.lo.x, area.hi.y + 0.1F * line}, axis_colour, "0");
  canvas.AddText({area.hi.x - 0.6F * line, area.hi.y + 0.1F * line}, axis_colour, "1");
  canvas.AddText({area.lo.x + 2.0F * line, area.hi.y + 0.1F * line}, fleck_colour, "sunfleck ratio");
  canvas.AddText({area.lo.x + 9.0F * line, area.hi.y + 0.1F * line}, down_colour, "light share");
  ImGui::Dummy({width_px, height_px});
}

void draw_balance(const BandResult& band, float width_px) {
  struct Part {
    const char* name;
    Estimate value;
    ImU32 colour;
  };
  const std::array<Part, 6> parts{{{"vegetation", band.absorbed_vegetation, IM_COL32(60, 140, 60, 255)},
                                   {"structures", band.absorbed_structure, IM_COL32(120, 120, 140, 255)},
                                   {"soil", band.absorbed_soil, IM_COL32(140, 100, 60, 255)},
                                   {"reflected", band.reflected, IM_COL32(230, 190, 60, 255)},
                                   {"transmitted", band.transmitted, IM_COL32(90, 150, 200, 255)},
                                   {"unshot", {band.unshot, std::nan("")}, IM_COL32(170, 170, 170, 255)}}};
  const float line = ImGui::GetTextLineHeight();
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  ImDrawList& canvas = *ImGui::GetWindowDrawList();
  float left = corner.x;
  for (const Part& part : parts) {
    if (!(band.incident.value > 0.0) || !(part.value.value > 0.0)) continue;
    const float right = left + width_px * static_cast<float>(part.value.value / band.incident.value);
    canvas.AddRectFilled({left, corner.y}, {right, corner.y + line}, part.colour);
    left = right;
  }
  ImGui::Dummy({width_px, 1.3F * line});
  ImGui::Text("%s", fmt::format("{} incident {:.4g} W m⁻²", band.name, band.incident.value).c_str());
  for (const Part& part : parts) {  // all of them, so that what follows stays in its place
    const ImVec2 at = ImGui::GetCursorScreenPos();
    canvas.AddRectFilled({at.x, at.y + 0.15F * line}, {at.x + 0.7F * line, at.y + 0.85F * line}, part.colour);
    ImGui::Dummy({0.8F * line, line});
    ImGui::SameLine();
    std::string text = fmt::format("{:<11} {:.4g}", part.name, part.value.value);
    if (!std::isnan(part.value.half_width)) text += fmt::format(" ± {:.2g}", part.value.half_width);
    ImGui::Text("%s", text.c_str());
  }
}

}  // namespace sunfleck
