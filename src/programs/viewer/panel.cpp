#include "programs/viewer/panel.h"

#include "base/units.h"
#include "programs/viewer/plots.h"

#include <imgui.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <initializer_list>
#include <string>
#include <vector>

namespace sunfleck {
namespace {

constexpr ImU32 problem_colour = IM_COL32(190, 25, 13, 255);

void text(const std::string& line) {
  ImGui::TextUnformatted(line.c_str());
}

// Records the position of the control just drawn.
void note(ViewerState& state, const std::string& name) {
  const ImVec2 lo = ImGui::GetItemRectMin();
  const ImVec2 hi = ImGui::GetItemRectMax();
  state.controls[name] = {lo.x, lo.y, hi.x, hi.y};
}

struct Span {
  double lo = 0.0, hi = 1.0;
  const char* format = "%.2f";
};

// `name` identifies the control to programs, `label` is shown to people.
bool slider(ViewerState& state, const std::string& name, const char* label, double& value, const Span& span) {
  const bool changed = ImGui::SliderScalar((label + ("##" + name)).c_str(), ImGuiDataType_Double, &value, &span.lo, &span.hi,
                                           span.format, ImGuiSliderFlags_AlwaysClamp);
  note(state, name);
  return changed;
}

bool slider(ViewerState& state, const std::string& name, const char* label, int& value, int lo, int hi) {
  const bool changed = ImGui::SliderInt((label + ("##" + name)).c_str(), &value, lo, hi, "%d", ImGuiSliderFlags_AlwaysClamp);
  note(state, name);
  return changed;
}

// A width of 0 fits the label; a button whose label changes needs another, so that what follows stays in its place.
bool button(ViewerState& state, const std::string& name, const char* label, float width_px = 0.0F) {
  const bool pressed = ImGui::Button((label + ("##" + name)).c_str(), {width_px, 0.0F});
  note(state, name);
  return pressed;
}

template <class Choice>
bool choose(ViewerState& state, const std::string& name, const char* label, Choice& choice,
            const std::vector<std::string>& names) {
  auto number = static_cast<std::size_t>(choice);
  bool changed = false;
  if (ImGui::BeginCombo((label + ("##" + name)).c_str(), names[number].c_str())) {
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (ImGui::Selectable(names[i].c_str(), i == number) && i != number) {
        choice = static_cast<Choice>(i);
        changed = true;
      }
      note(state, name + "/" + names[i]);
    }
    ImGui::EndCombo();
  } else {
    note(state, name);
  }
  return changed;
}

std::string error_text(const char* pass, const std::optional<double>& error, double bound) {
  if (!error) return fmt::format("{} error: not known yet", pass);
  return fmt::format("{} error {:.2g} (target {:.2g})", pass, *error, bound);
}

void draw_state(const ViewerState& state) {
  const LightNews& news = state.news;
  ImGui::TextWrapped("%s", state.title.c_str());
  ImGui::TextDisabled("%s", state.plot_text.c_str());
  const bool current = news.version > 0 && news.result_request == news.request;
  const double reached = std::max(news.direct_error.value_or(1.0) / std::max(1e-9, news.direct_bound),
                                  news.indirect_error.value_or(0.0) / std::max(1e-9, news.indirect_bound));
  const float done = current && news.complete ? 1.0F : static_cast<float>(std::min(0.99, 1.0 / (reached * reached)));
  const std::string phase = !news.problem.empty() ? "not possible"
                            : !current            ? "restarting"
                            : news.complete
                                ? fmt::format("{}, {:.1f} s", is_done(news.stop) ? "done" : "stopped early", news.seconds)
                                : fmt::format("{:.1f} s", news.seconds);
  ImGui::ProgressBar(current ? done : 0.0F, {-1.0F, 0.0F}, phase.c_str());
  text(error_text("Direct", news.direct_error, news.direct_bound));
  text(error_text("Indirect", news.indirect_error, news.indirect_bound));
  const auto rays = static_cast<double>(news.rays);
  text(fmt::format("{:.2f} million rays, {:.2f} million per second", 1e-6 * rays,
                   news.seconds > 0.0 ? 1e-6 * rays / news.seconds : 0.0));
  const double look_ms = state.frame ? 1e3 * (state.frame->look_s + state.frame->paint_s) : 0.0;
  text(fmt::format("Frame {:.0f} ms, picture {:.0f} ms", state.frame_ms, look_ms));
  ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
  ImGui::TextWrapped("%s", state.device.c_str());
  ImGui::PopStyleColor();
}

void draw_clock(ViewerState& state) {
  SunRequest& sun = state.light.sun;
  const int minutes = static_cast<int>(std::lround(60.0 * sun.hour));
  const std::string clock = fmt::format("{:02d}:{:02d}", minutes / 60, minutes % 60);
  slider(state, "hour", "Local time", sun.hour, {0.0, 24.0, clock.c_str()});
  slider(state, "month", "Month", sun.month, 1, 12);
  const std::chrono::year_month_day_last end(std::chrono::year(sun.year) / sun.month / std::chrono::last);
  const int days = static_cast<int>(static_cast<unsigned>(end.day()));
  sun.day = std::min(sun.day, days);
  slider(state, "day", "Day", sun.day, 1, days);
  if (ImGui::InputInt("Year", &sun.year)) sun.year = std::clamp(sun.year, 1900, 2100);
  slider(state, "latitude", "Latitude °N", sun.latitude_deg, {-90.0, 90.0, "%.2f"});
  slider(state, "longitude", "Longitude °E", sun.longitude_deg, {-180.0, 180.0, "%.2f"});
  double offset_h = sun.offset_minutes / 60.0;
  if (slider(state, "utc_offset", "UTC offset, h", offset_h, {-12.0, 14.0, "%+.2f"}))
    sun.offset_minutes = static_cast<int>(std::lround(60.0 * offset_h));
  if (button(state, "play", state.playing ? "Stop" : "Play the day", 7.0F * ImGui::GetFontSize()))
    state.playing = !state.playing;
  ImGui::SameLine();
  ImGui::SetNextItemWidth(5.0F * ImGui::GetFontSize());
  slider(state, "play_step", "min", state.play_step_min, {1.0, 60.0, "%.0f"});
}

void draw_sun(ViewerState& state) {
  SunRequest& sun = state.light.sun;
  ImGui::Checkbox("Sun", &sun.shines);
  note(state, "sun");
  if (!sun.shines) return;
  ImGui::SameLine();
  int by_clock = sun.by_clock ? 1 : 0;
  if (ImGui::RadioButton("angles", &by_clock, 0)) {
    // Start from the sun's current position.
    if (sun.by_clock && state.news.sun) {
      sun.elevation_deg = in_degrees(state.news.sun->elevation_rad);
      sun.azimuth_deg = in_degrees(state.news.sun->azimuth_rad);
    }
    sun.by_clock = false;
    state.playing = false;
  }
  note(state, "by_angles");
  ImGui::SameLine();
  if (ImGui::RadioButton("date and time", &by_clock, 1)) sun.by_clock = true;
  note(state, "by_clock");
  if (sun.by_clock) return draw_clock(state);
  slider(state, "elevation", "Elevation °", sun.elevation_deg, {-5.0, 90.0, "%.2f"});
  slider(state, "azimuth", "Azimuth °", sun.azimuth_deg, {0.0, 360.0, "%.2f"});
}

void draw_sky(ViewerState& state) {
  SkyRequest& sky = state.light.sky;
  std::vector<std::string> names{"none", "uniform", "CIE overcast", "CIE clear", "CIE type", "Perez", "as in the scene"};
  choose(state, "sky", "Sky", sky.kind, names);
  if (sky.kind == SkyRequestKind::general) slider(state, "cie_type", "CIE type", sky.cie_type, 1, 15);
  if (sky.kind == SkyRequestKind::all_weather) {
    slider(state, "dni", "DNI, W m⁻²", sky.dni_w_m2, {0.0, 1100.0, "%.0f"});
    slider(state, "dhi", "DHI, W m⁻²", sky.dhi_w_m2, {1.0, 600.0, "%.0f"});
  }
  if (ImGui::Checkbox("Own irradiance", &state.light.own_irradiance) && state.light.own_irradiance) {
    for (std::size_t b = 0; b < state.news.incoming.size(); ++b) state.light.bands[b] = band_request(state.news.incoming[b]);
  }
  note(state, "own_irradiance");
  if (!state.light.own_irradiance) return;
  for (std::size_t b = 0; b < state.bands.size(); ++b) {
    BandRequest& band = state.light.bands[b];
    slider(state, "total/" + state.bands[b], (state.bands[b] + ", W m⁻²").c_str(), band.total_w_m2, {0.0, 1200.0, "%.0f"});
    slider(state, "diffuse/" + state.bands[b], (state.bands[b] + " diffuse share").c_str(), band.diffuse_share,
           {0.0, 1.0, "%.3f"});
  }
}

// Says what light comes in, always on three lines.
void draw_incoming(const ViewerState& state) {
  const LightNews& news = state.news;
  if (state.band() >= news.incoming.size()) {
    for (int line = 0; line < 3; ++line) text(" ");
    return;
  }
  const Waveband& shown = news.incoming[state.band()];
  text(fmt::format("{}: beam {:.4g}, sky {:.4g} W m⁻²", shown.name, shown.direct_w_m2, shown.diffuse_w_m2));
  const bool sky = state.light.sky.kind != SkyRequestKind::none;
  const bool no_sky_light =
      std::all_of(news.incoming.begin(), news.incoming.end(), [](const Waveband& band) { return !(band.diffuse_w_m2 > 0.0); });
  std::string of_sky = " ";
  if (sky && no_sky_light) of_sky = "The sky has no light: give `diffuse`";
  if (news.assumed_diffuse_share)
    of_sky = fmt::format("Sky: {:.0f} % of the light, assumed", 100.0 * *news.assumed_diffuse_share);
  text(of_sky);
  const bool fixed = state.light.sun.shines && state.light.sun.by_clock && (state.fixed_beam || state.light.own_irradiance);
  text(fixed ? "Beam fixed: it does not follow the hour" : " ");
}

// Keeps reflectance plus transmittance at 1 or below by lowering the one that is not being changed.
void draw_faces(ViewerState& state, const std::string& name, std::initializer_list<FaceRequest*> faces) {
  FaceRequest face = **faces.begin();
  if (slider(state, "reflectance/" + name, "reflectance", face.reflectance, {0.0, 1.0, "%.3f"}))
    face.transmittance = std::min(face.transmittance, 1.0 - face.reflectance);
  if (slider(state, "transmittance/" + name, "transmittance", face.transmittance, {0.0, 1.0, "%.3f"}))
    face.reflectance = std::min(face.reflectance, 1.0 - face.transmittance);
  for (FaceRequest* each : faces) *each = face;
}

void draw_optics(ViewerState& state) {
  const std::size_t band = state.band();
  text(state.bands[band] + " (the band shown)");
  for (std::size_t i = 0; i < state.optics_names.size(); ++i) {
    const std::string& name = state.optics_names[i];
    const auto same = std::find(state.optics_names.begin(), state.optics_names.end(), name) - state.optics_names.begin();
    if (static_cast<std::size_t>(same) < i) {  // optics of plants and of structures
      state.light.optics[i] = state.light.optics[static_cast<std::size_t>(same)];
      continue;
    }
    FaceRequest& upper = state.light.optics[i].upper[band];
    FaceRequest& lower = state.light.optics[i].lower[band];
    if (upper == lower) {
      text(name);
      draw_faces(state, name, {&upper, &lower});
    } else {
      text(name + ", upper face");
      draw_faces(state, name + "/upper", {&upper});
      text(name + ", lower face");
      draw_faces(state, name + "/lower", {&lower});
    }
  }
  if (state.light.soil_reflectance.empty()) return;
  text("soil");
  slider(state, "soil_reflectance", "reflectance", state.light.soil_reflectance[band], {0.0, 1.0, "%.3f"});
}

void draw_picture(ViewerState& state) {
  choose(state, "field", "Light", state.picture.field, field_names());
  std::size_t band = state.band();
  if (choose(state, "band", "Band", band, state.bands)) state.options.band = state.bands[band];
  choose(state, "chart", "Chart", state.picture.chart, chart_names());
  const bool scaled = has_top(state.picture.chart);
  if (scaled) {
    ImGui::Checkbox("Own range", &state.own_range);
    note(state, "own_range");
    if (state.own_range) slider(state, "range", "up to, W m⁻²", state.range_top_w_m2, {1.0, 1500.0, "%.0f"});
  }
  state.options.top_w_m2 = scaled && state.own_range ? std::optional(state.range_top_w_m2) : std::nullopt;
  slider(state, "samples", "Samples per pixel", state.options.samples, 1, 16);
}

void draw_views(ViewerState& state, PanelOrders& orders) {
  constexpr std::array views{std::pair{"Camera", ViewKind::camera}, std::pair{"Top", ViewKind::top},
                             std::pair{"Side", ViewKind::side}, std::pair{"Fisheye", ViewKind::fisheye}};
  for (const auto& [label, kind] : views) {
    if (button(state, std::string("view_") + label, label)) orders.view = kind;
    ImGui::SameLine();
  }
  orders.fit = button(state, "fit", "Fit");
  orders.copy_camera = button(state, "copy_camera", "Copy camera as TOML");
  ImGui::TextDisabled(
      "Drag: orbit. Right: pan. Wheel: zoom.\nW A S D Q E: fly. F: fit. 1-4: views.\nH: hide panel. Click: pick. Ctrl+Q: "
      "quit.");
}

std::string with_error(const Estimate& figure) {
  if (std::isnan(figure.value)) return "too few rays";
  if (std::isnan(figure.half_width)) return fmt::format("{:.4g} (too few rays)", figure.value);
  return fmt::format("{:.4g} ± {:.2g}", figure.value, figure.half_width);
}

void draw_picked_organ(const PickedOrgan& picked) {
  text(fmt::format("{} of plant {}{}", picked.organ, picked.plant,
                   picked.rank > 0 ? fmt::format(", rank {}", picked.rank) : ""));
  text(fmt::format("{:.4g} cm², triangles: {}, optics {}", 1e4 * picked.area_m2, picked.triangles, picked.optics));
  text("W m⁻² of its area, both faces:");
  text(fmt::format("Direct: {}", with_error(picked.direct)));
  text(fmt::format("Sky and scattered: {}", with_error(picked.indirect)));
  text(fmt::format("Absorbed: {}", with_error(picked.absorbed)));
  text(fmt::format("Share in direct sun: {}", with_error(picked.sunlit_fraction)));
  ImGui::TextDisabled("Click it again for a triangle.");
}

void draw_picked_triangle(const PickedOrgan& organ, const PickedElement& picked) {
  text(fmt::format("Triangle {} of {}, plant {}{}", picked.element, organ.organ, organ.plant,
                   organ.rank > 0 ? fmt::format(", rank {}", organ.rank) : ""));
  text(fmt::format("{:.4g} cm², optics {}", 1e4 * picked.area_m2, organ.optics));
  const auto figure = [&](double value, double half_width) {
    return picked.errors_known ? with_error({value, half_width}) : fmt::format("{:.4g} (error not kept)", value);
  };
  const auto face = [&](const char* name, const PickedElement::Face& light) {
    text(fmt::format("{}: {} W m⁻²", name, figure(light.total_w_m2(), light.half_width_w_m2)));
    ImGui::TextDisabled("%s", fmt::format("  direct {:.4g}, sky {:.4g}, scattered {:.4g}", light.direct_w_m2, light.sky_w_m2,
                                          light.scattered_w_m2)
                                  .c_str());
  };
  face("Upper face", picked.upper);
  face("Lower face", picked.lower);
  text(fmt::format("Absorbed: {} W m⁻²", figure(picked.absorbed_w_m2, picked.absorbed_half_width_w_m2)));
}

// Chooses the size of saved pictures.
void draw_save_size(ViewerState& state) {
  constexpr int least = 64;
  constexpr int most = 4096;
  ImGui::Checkbox("Own size", &state.own_size);
  note(state, "own_size");
  ImGui::SameLine();
  std::array<int, 2> size{state.save_width, state.save_height};
  ImGui::SetNextItemWidth(8.0F * ImGui::GetFontSize());
  if (ImGui::InputInt2("px##save_size", size.data(), ImGuiInputTextFlags_EnterReturnsTrue)) {
    state.save_width = std::clamp(size[0], least, most);
    state.save_height = std::clamp(size[1], least, most);
  }
  note(state, "save_size");
}

bool section(ViewerState& state, const char* name, bool open) {
  const bool shown = ImGui::CollapsingHeader(name, open ? ImGuiTreeNodeFlags_DefaultOpen : ImGuiTreeNodeFlags_None);
  note(state, std::string("section/") + name);
  return shown;
}

}  // namespace

PanelOrders draw_panel(ViewerState& state, float width_px, float height_px) {
  PanelOrders orders;
  ImGui::SetNextWindowPos({0.0F, 0.0F});
  ImGui::SetNextWindowSize({width_px, height_px});
  constexpr ImGuiWindowFlags fixed = ImGuiWindowFlags_AlwaysVerticalScrollbar | ImGuiWindowFlags_NoMove |
                                     ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoTitleBar;
  ImGui::Begin("sunfleck", nullptr, fixed);
  ImGui::PushItemWidth(0.55F * width_px);
  draw_state(state);
  orders.save_picture = button(state, "save_picture", "Save picture");
  ImGui::SameLine();
  orders.save_result =
      button(state, "save_result", state.news.saving ? "Saving …" : "Save result", 7.0F * ImGui::GetFontSize());
  draw_save_size(state);
  if (section(state, "Light", true)) {
    draw_sun(state);
    draw_sky(state);
    draw_incoming(state);
    if (button(state, "reset_light", "As in the scene")) orders.reset_light = true;
  }
  if (section(state, "Picture", true)) draw_picture(state);
  if (section(state, "View", true)) draw_views(state, orders);
  if (section(state, "Optics", false)) draw_optics(state);
  const std::size_t band = state.band();
  const float inner = ImGui::GetContentRegionAvail().x;
  if (!state.news.bands.empty() && section(state, "Energy balance", true)) draw_balance(state.news.bands[band], inner);
  if (!state.news.layers.empty() && section(state, "Profile", true)) draw_profile(state.news.layers, band, inner);
  ImGui::PopItemWidth();
  ImGui::End();
  return orders;
}

void draw_selected(const ViewerState& state, float left_px, float height_px) {
  if (!is_picked_shown(state)) return;
  const float line = ImGui::GetTextLineHeightWithSpacing();
  const ImVec2 size(19.0F * line, 9.0F * line);
  ImGui::SetNextWindowPos({left_px + line, height_px - size.y - 5.0F * line});
  ImGui::SetNextWindowSize(size);
  ImGui::SetNextWindowBgAlpha(0.93F);
  ImGui::Begin("selected", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoInputs | ImGuiWindowFlags_NoFocusOnAppearing);
  const LivePictureFrame& frame = *state.frame;
  if (frame.picked) {
    draw_picked_triangle(*frame.organ, *frame.picked);
  } else {
    draw_picked_organ(*frame.organ);
  }
  ImGui::End();
}

void draw_message(const ViewerState& state, float left_px, float width_px, float height_px) {
  if (state.message.empty()) return;
  const float line = ImGui::GetTextLineHeight();
  const float wrap_px = std::max(10.0F * line, width_px - 3.0F * line);
  const ImVec2 size = ImGui::CalcTextSize(state.message.c_str(), nullptr, false, wrap_px);
  ImGui::SetNextWindowPos({left_px + line, height_px - size.y - 2.5F * line});
  ImGui::SetNextWindowSize({size.x + 1.5F * line, size.y + 1.5F * line});
  ImGui::SetNextWindowBgAlpha(0.95F);
  ImGui::Begin("message", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoInputs | ImGuiWindowFlags_NoFocusOnAppearing);
  if (state.message_is_problem) ImGui::PushStyleColor(ImGuiCol_Text, problem_colour);
  ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + wrap_px);
  text(state.message);
  ImGui::PopTextWrapPos();
  if (state.message_is_problem) ImGui::PopStyleColor();
  ImGui::End();
}

}  // namespace sunfleck
