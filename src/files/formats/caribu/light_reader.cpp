#include "files/formats/caribu/light_reader.h"

#include "base/text_reader.h"
#include "files/formats/caribu/caribu_lines.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <string>
#include <string_view>

namespace sunfleck {

namespace {

constexpr std::uintmax_t most_light_bytes = std::uintmax_t{64} << 20U;  // enough for most_lights with long comments

constexpr std::string_view line_form = "write: weight dx dy dz";
constexpr std::string_view line_rule = "a line has four numbers";

SkyLight parse_light(CaribuLines& lines) {
  SkyLight light;
  light.weight = lines.number("weight", line_form, line_rule);
  const double east = lines.number("dx", line_form, line_rule);
  const double north = lines.number("dy", line_form, line_rule);
  const double up = lines.number("dz", line_form, line_rule);
  if (const std::string_view more = lines.word(); !more.empty())
    lines.refuse_here(fmt::format("{} after dz", in_quotes(more)), line_rule, line_form);
  if (light.weight < 0.0) lines.refuse_here(fmt::format("weight = {}", light.weight), "must be >= 0", "correct its sign");

  const glm::dvec3 travel(-north, up, -east);
  const double largest = std::max({std::abs(travel.x), std::abs(travel.y), std::abs(travel.z)});
  if (largest > 0.0) light.to_sky = glm::normalize(-travel / largest);
  if (largest == 0.0 || light.to_sky.y < least_sky_sine)
    lines.refuse_here(fmt::format("direction {} {} {}", east, north, up), "light must travel downwards, dz < 0",
                      up > 0.0 ? "reverse it" : "raise the light above the horizon");
  return light;
}

}  // namespace

std::vector<SkyLight> read_lights(const std::filesystem::path& file, SourceFiles* files) {
  const std::string bytes = read_source(file, files, most_light_bytes);
  std::vector<SkyLight> lights;
  CaribuLines lines(file, bytes);
  while (lines.next()) {
    if (lights.size() == most_lights)
      lines.refuse_here("too many directions", fmt::format("a list may have at most {}", most_lights),
                        "merge neighbouring directions");
    lights.push_back(parse_light(lines));
  }
  if (lights.empty()) lines.refuse_file("no directions", "a sky needs at least one", line_form);
  if (std::none_of(lights.begin(), lights.end(), [](const SkyLight& light) { return light.weight > 0.0; }))
    lines.refuse_file("all weights are 0", "a sky must send light", "give one direction a weight above 0");
  return lights;
}

}  // namespace sunfleck
