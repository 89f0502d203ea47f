#include "files/scene/caribu_scene.h"

#include "base/check.h"
#include "base/error.h"
#include "base/file.h"
#include "base/text.h"
#include "files/formats/caribu/caribu_reader.h"
#include "files/formats/caribu/light_reader.h"
#include "files/formats/mesh/mesh_reader.h"
#include "files/scene/plain_name.h"
#include "files/scene/toml_text.h"
#include "files/scene/toml_view.h"
#include "physics/canopy/canopy.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <glm/common.hpp>
#include <glm/trigonometric.hpp>
#include <system_error>
#include <utility>

namespace sunfleck {

namespace {

constexpr double smallest_plot_m = 1e-6, largest_plot_m = 1e6;  // as in a scene file
// Least width of an isolated stand's plot as a share of the stand's largest extent; a stand seen edge-on has no width.
constexpr double least_width = 0.01;
constexpr double largest_sum = 1e15;  // W m-2, as in a scene file

struct NamedOptics {
  std::string file;  // for messages
  std::string band;
  CaribuOptics optics;
};

std::string shown(const std::filesystem::path& file) {
  return printable(file.filename().string());
}

struct CaribuSurface {
  enum class Kind { leaf, stem } kind = Kind::leaf;
  std::size_t species = 1;
};

// Returns the surface and species that optics of this name belong to; nothing for soil.
std::optional<CaribuSurface> surface_named(const std::string& canopy, const std::string& name) {
  if (role_from_name(name) == Role::soil) return std::nullopt;
  for (const auto& [prefix, kind] : {std::pair<std::string_view, CaribuSurface::Kind>{"leaf", CaribuSurface::Kind::leaf},
                                     {"stem", CaribuSurface::Kind::stem}}) {
    if (!name.starts_with(prefix)) continue;
    const std::string_view digits = std::string_view(name).substr(prefix.size());
    CaribuSurface surface{kind, 1};
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), surface.species);
    if (digits.empty() || (error == std::errc() && end == digits.data() + digits.size() && surface.species > 0)) return surface;
  }
  throw_input(fmt::format("{}: optics \"{}\"", canopy, printable(name)),
              "an .opt file describes only the leaves and stems of species",
              "name its material leaf, stem, leaf2, stem2, ... or soil");
}

class CaribuSceneText {
 public:
  CaribuSceneText(const CaribuSet& set, const CaribuNames& names, SourceFiles* files)
      : set_(set), names_(names), files_(files), canopy_(printable(set.canopy.string())) {}

  CaribuScene write() {
    for (const std::string& name : {names_.canopy, names_.light}) check_nameable(name);
    read_bands();
    const std::vector<SkyLight> lights = read_lights(set_.light, files_);
    std::optional<CaribuDomain> domain;
    if (set_.domain) domain = read_domain(*set_.domain, files_);
    mesh_ = read_mesh(set_.canopy,
                      {.optics = std::nullopt, .up = std::nullopt, .scale = set_.scale, .allow_outside = set_.allow_outside},
                      files_);
    find_bounds();

    text_ = "# Made by sunfleck from " + shown(set_.canopy);
    for (const CaribuBand& band : set_.bands) text_ += ", " + shown(band.file);
    text_ += ", " + shown(set_.light) + (set_.domain ? ", " + shown(*set_.domain) : "") + "\n";
    text_ += fmt::format("title = {}\n", toml_string(title()));
    domain ? add_plot(*domain) : add_plot();
    add_light(lights);
    add_optics();
    add_geometry();
    return {std::move(text_), names_light_};
  }

 private:
  [[nodiscard]] std::string title() const {
    std::filesystem::path name = set_.canopy.filename();
    if (name.extension() == ".gz") name = name.stem();
    return printable(name.stem().string());
  }

  void read_bands() {
    EXPECT(set_.bands.empty(), ==, false);
    for (const CaribuBand& band : set_.bands) {
      if (std::any_of(bands_.begin(), bands_.end(), [&](const NamedOptics& other) { return other.band == band.name; }))
        throw_input(fmt::format("--optics {}", printable(band.file.string())),
                    fmt::format("there is already a band named {}", band.name), "name it: --optics NAME=FILE");
      bands_.push_back({printable(band.file.string()), band.name, read_opt(band.file, files_)});
    }
  }

  void find_bounds() {
    lo_m_ = hi_m_ = mesh_.vertices.at(0);
    for (const glm::dvec3& vertex_m : mesh_.vertices) {
      lo_m_ = glm::min(lo_m_, vertex_m);
      hi_m_ = glm::max(hi_m_, vertex_m);
    }
    const glm::dvec3 reach_m = glm::max(glm::abs(lo_m_), glm::abs(hi_m_));
    const double farthest = std::max({reach_m.x, reach_m.y, reach_m.z});
    if (farthest > farthest_m)
      throw_input(canopy_, fmt::format("it extends to {:.3g} m, but at most {:.0e} m is allowed", farthest, farthest_m),
                  "give its unit with --scale, e.g. 0.01 for centimetres");
  }

  void add_plot(const CaribuDomain& domain) {
    const std::string place = printable(set_.domain->string());
    size_m_ = {set_.scale * (domain.y_max - domain.y_min), set_.scale * (domain.x_max - domain.x_min)};
    at_m_ = {set_.scale * domain.y_max, 0.0, set_.scale * domain.x_max};
    check_plot(place);
    if (std::max(std::abs(at_m_.x), std::abs(at_m_.z)) > farthest_m)
      throw_input(place, fmt::format("its corner lies farther from zero than {:.0e} m", farthest_m),
                  "give its unit with --scale, e.g. 0.01 for centimetres");
    text_ += fmt::format("\n[plot]\nsize     = [{}, {}]\nperiodic = true\n", size_m_.x, size_m_.y);
  }

  // Adds an isolated plot as large as the canopy.
  void add_plot() {
    const glm::dvec3 extent_m = hi_m_ - lo_m_;
    const double least_m = least_width * std::max({extent_m.x, extent_m.y, extent_m.z});
    size_m_ = glm::max(glm::dvec2(extent_m.x, extent_m.z), least_m);
    at_m_ = {0.5 * (size_m_.x - lo_m_.x - hi_m_.x) + 0.0, 0.0, 0.5 * (size_m_.y - lo_m_.z - hi_m_.z) + 0.0};
    check_plot(canopy_);
    text_ += fmt::format("\n[plot]\nsize     = [{}, {}]\nperiodic = false\n", size_m_.x, size_m_.y);
  }

  void check_plot(const std::string& place) const {
    for (const double size_m : {size_m_.x, size_m_.y}) {
      if (size_m >= smallest_plot_m && size_m <= largest_plot_m) continue;
      throw_input(fmt::format("{}: a plot of {:.6g} x {:.6g} m", place, size_m_.x, size_m_.y),
                  fmt::format("each side must lie in {}..{} m", smallest_plot_m, largest_plot_m),
                  "give its unit with --scale, e.g. 0.01 for centimetres");
    }
  }

  void add_light(const std::vector<SkyLight>& lights) {
    double sum = 0.0;
    std::vector<SkyLight> shining;
    for (const SkyLight& light : lights) {
      sum += light.weight;
      if (light.weight > 0.0) shining.push_back(light);
    }
    if (!(sum <= largest_sum))
      throw_input(printable(set_.light.string()),
                  fmt::format("its weights sum to {:.3g} W m-2, but at most {:.0e} is allowed", sum, largest_sum),
                  "give the weights in W m-2 on a horizontal plane");
    const bool beam = shining.size() == 1;
    names_light_ = !beam;
    if (beam) {
      const glm::dvec3& to_sun = shining.front().to_sky;
      const double elevation_deg = glm::degrees(std::atan2(to_sun.y, std::hypot(to_sun.x, to_sun.z)));
      const bool zenith = to_sun.x == 0.0 && to_sun.z == 0.0;
      double azimuth_deg = zenith ? 0.0 : glm::degrees(std::atan2(-to_sun.z, -to_sun.x));
      if (azimuth_deg < 0.0) azimuth_deg += 360.0;
      text_ += fmt::format("\n[sun]  # the one direction of {}\nelevation = {}\nazimuth   = {}\n", shown(set_.light),
                           elevation_deg, azimuth_deg);
    } else {
      text_ += fmt::format("\n[sky]\nmodel = \"lights\"\nfile  = {}\n", toml_string(names_.light));
    }
    for (const NamedOptics& band : bands_)
      text_ += fmt::format("\n[[band]]\nname    = \"{}\"\n{} = {:.15g}\n", band.band, beam ? "direct " : "diffuse", sum);
  }

  void add_optics() {
    text_ += fmt::format("\n[soil]\nreflectance = {}\n",
                         by_band([](const NamedOptics& band) { return band.optics.soil_reflectance; }));
    for (const std::string& name : mesh_.optics_names) {
      const std::optional<CaribuSurface> surface = surface_named(canopy_, name);
      if (!surface) continue;
      const std::size_t index = surface->species - 1;
      for (const NamedOptics& band : bands_) check_species(name, surface->species, band);
      const auto species = [index](const NamedOptics& band) -> const SpeciesOptics& { return band.optics.species[index]; };
      if (surface->kind == CaribuSurface::Kind::stem) {
        text_ += fmt::format("\n[optics.{}]\nreflectance = {}\n", name,
                             by_band([&](const NamedOptics& band) { return species(band).stem_reflectance; }));
      } else {
        add_face(name + ".upper", [&](const NamedOptics& band) { return species(band).upper; });
        add_face(name + ".lower", [&](const NamedOptics& band) { return species(band).lower; });
      }
    }
  }

  void check_species(const std::string& name, std::size_t species, const NamedOptics& band) const {
    const std::size_t known = band.optics.species.size();
    if (species <= known) return;
    throw_input(fmt::format("{}: {}", canopy_, name),
                fmt::format("it belongs to species {}, but {} has only {}", species, band.file, known),
                fmt::format("add the species to {}, or correct the labels", band.file));
  }

  template <class Face>
  void add_face(const std::string& name, const Face& face) {
    text_ += fmt::format("\n[optics.{}]\nreflectance   = {}\ntransmittance = {}\n", name,
                         by_band([&](const NamedOptics& band) { return face(band).reflectance; }),
                         by_band([&](const NamedOptics& band) { return face(band).transmittance; }));
  }

  template <class Value>
  [[nodiscard]] std::string by_band(const Value& value) const {
    std::vector<std::string> cells;
    for (const NamedOptics& band : bands_) cells.push_back(fmt::format("{} = {}", band.band, value(band)));
    return fmt::format("{{ {} }}", fmt::join(cells, ", "));
  }

  void add_geometry() {
    text_ += fmt::format("\n[[geometry]]\nfile  = {}\n", toml_string(names_.canopy));
    if (set_.scale != 1.0) text_ += fmt::format("scale = {}\n", set_.scale);
    text_ += fmt::format("at    = [[{}, {}, {}]]\n", at_m_.x, at_m_.y, at_m_.z);
  }

  const CaribuSet& set_;
  const CaribuNames& names_;
  SourceFiles* const files_;
  const std::string canopy_;  // for messages
  std::vector<NamedOptics> bands_;
  Mesh mesh_;
  glm::dvec3 lo_m_{0.0}, hi_m_{0.0}, at_m_{0.0};
  glm::dvec2 size_m_{0.0};  // along X and Z
  std::string text_;
  bool names_light_ = false;
};

}  // namespace

CaribuBand caribu_band(std::string_view word) {
  const std::size_t equals = word.find('=');
  if (equals != word.npos && is_plain_name(word.substr(0, equals))) {
    return {std::string(word.substr(0, equals)), std::filesystem::path(word.substr(equals + 1))};
  }
  CaribuBand band{"", std::filesystem::path(word)};
  band.name = upper_case(band.file.stem().string());
  if (!is_plain_name(band.name)) {
    throw_input(fmt::format("--optics {}: invalid band name {}", printable(word), printable(band.name)), plain_name_rule,
                "name it: --optics NAME=FILE");
  }
  return band;
}

CaribuScene caribu_scene(const CaribuSet& set, const CaribuNames& names, SourceFiles* files) {
  EXPECT(set.scale, >, 0.0);
  return CaribuSceneText(set, names, files).write();
}

}  // namespace sunfleck
