#include "io/light_reader.h"

#include "io/file.h"
#include "io/mesh_formats.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace sunfleck {

namespace {

constexpr std::uintmax_t most_bytes = std::uintmax_t{64} << 20U;  // enough for most_lights with long comments

constexpr std::string_view line_form = "write: weight dx dy dz";

double number(const MeshSource& source, std::size_t line, std::string_view& rest, std::string_view what) {
  const std::string_view word = next_word(rest);
  if (word.empty()) refuse(source, line, fmt::format("{} is missing", what), "a line has four numbers", line_form);
  const std::optional<double> value = parse_number(word);
  if (!value) refuse(source, line, fmt::format("{} = {}", what, in_quotes(word)), "must be a finite number", line_form);
  return *value;
}

SkyLight parse_light(const MeshSource& source, std::size_t line, std::string_view rest) {
  SkyLight light;
  light.weight = number(source, line, rest, "weight");
  const double east = number(source, line, rest, "dx");
  const double north = number(source, line, rest, "dy");
  const double up = number(source, line, rest, "dz");
  if (const std::string_view more = next_word(rest); !more.empty())
    refuse(source, line, fmt::format("{} after dz", in_quotes(more)), "a line has four numbers", line_form);
  if (light.weight < 0.0) refuse(source, line, fmt::format("weight = {}", light.weight), "must be >= 0", "correct its sign");

  const glm::dvec3 travel(-north, up, -east);
  const double largest = std::max({std::abs(travel.x), std::abs(travel.y), std::abs(travel.z)});
  if (largest > 0.0) light.to_sky = glm::normalize(-travel / largest);
  if (largest == 0.0 || light.to_sky.y < least_sky_sine)
    refuse(source, line, fmt::format("direction {} {} {}", east, north, up), "light must travel downwards, dz < 0",
           up > 0.0 ? "reverse it" : "raise the light above the horizon");
  return light;
}

}  // namespace

std::vector<SkyLight> read_lights(const std::filesystem::path& file, SourceFiles* files) {
  const std::string bytes = read_source(file, files, most_bytes);
  const MeshSource source{file, bytes, {}};
  std::vector<SkyLight> lights;
  LineReader lines(without_mark(bytes));
  while (lines.next()) {
    const std::string_view content = trimmed(lines.line().substr(0, lines.line().find('#')));
    if (content.empty()) continue;
    if (lights.size() == most_lights)
      refuse(source, lines.number(), "too many directions", fmt::format("a list may have at most {}", most_lights),
             "merge neighbouring directions");
    lights.push_back(parse_light(source, lines.number(), content));
  }
  if (lights.empty()) refuse(source, 0, "no directions", "a sky needs at least one", line_form);
  if (std::none_of(lights.begin(), lights.end(), [](const SkyLight& light) { return light.weight > 0.0; }))
    refuse(source, 0, "all weights are 0", "a sky must send light", "give one direction a weight above 0");
  return lights;
}

}  // namespace sunfleck
