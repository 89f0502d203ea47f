#include "files/scene/mesh_scene.h"

#include "base/check.h"
#include "base/error.h"
#include "base/file.h"
#include "base/rounding.h"
#include "base/text.h"
#include "files/formats/mesh/mesh_survey.h"
#include "files/scene/scene_patterns.h"
#include "files/scene/toml_text.h"
#include "physics/canopy/role.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/vec2.hpp>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace sunfleck {

namespace {

// Returns the number rounded up to two digits.
double rounded_up(double x) {
  const double digit = std::pow(10.0, std::floor(std::log10(x)) - 1.0);
  return std::ceil(x / digit - 1e-9) * digit;
}

struct SurveyedMesh {
  MeshToShow mesh;
  MeshSurvey survey;
  glm::dvec3 lo_m{0.0}, hi_m{0.0};  // box in the scene's axes

  [[nodiscard]] glm::dvec3 extent_m() const { return hi_m - lo_m; }
};

SurveyedMesh surveyed(const MeshToShow& mesh, bool allow_outside, SourceFiles* files) {
  check_nameable(mesh.name);
  SurveyedMesh result{mesh, survey_mesh(read_mesh_as_is(mesh.file, allow_outside, files), frame_of_format(mesh.file)), {}, {}};
  const FrameGuess& frame = result.survey.frame;
  const auto in_scene = [&](const glm::dvec3& v) {
    return scene_direction(frame.up, Axes::south_up_west, v) * frame.metres_per_unit;
  };
  const glm::dvec3 a = in_scene(result.survey.shape.lo), b = in_scene(result.survey.shape.hi);
  result.lo_m = glm::min(a, b);
  result.hi_m = glm::max(a, b);
  return result;
}

// Returns the height to add to a mesh that floats or is mostly below the ground; 0 for one that stands on it, roots included.
double lift_m(const SurveyedMesh& mesh) {
  const double height_m = mesh.extent_m().y;
  const bool stands = mesh.lo_m.y >= -0.5 * height_m && mesh.lo_m.y <= 0.2 * height_m;
  return stands ? 0.0 : -mesh.lo_m.y;
}

// Typical values of PAR: leaves after Gates (1965), the rest rounded.
struct TypicalOptics {
  Role role;
  double reflectance, transmittance;
};
constexpr TypicalOptics typical[] = {{Role::leaf, 0.10, 0.05}, {Role::stem, 0.15, 0.0},      {Role::fruit, 0.20, 0.0},
                                     {Role::lamp, 0.50, 0.0},  {Role::structure, 0.40, 0.0}, {Role::soil, 0.15, 0.0}};

class MeshSceneText {
 public:
  explicit MeshSceneText(std::vector<SurveyedMesh> meshes) : meshes_(std::move(meshes)) { lay_out(); }

  std::string write() {
    add_head();
    add_light();
    add_optics();
    for (std::size_t i = 0; i < meshes_.size(); ++i) add_geometry(i);
    return std::move(text_);
  }

 private:
  // Divides the plot into equal cells, one for each mesh, in rows along X.
  void lay_out() {
    constexpr double margin = 1.2;
    constexpr double least_m = 0.001;
    for (const SurveyedMesh& mesh : meshes_) cell_m_ = glm::max(cell_m_, glm::dvec2(mesh.extent_m().x, mesh.extent_m().z));
    const double larger_m = std::max(cell_m_.x, cell_m_.y);
    if (!(larger_m > 0.0))
      throw_input(printable(meshes_.front().mesh.file.string()), "all triangles lie in one vertical line",
                  "give a mesh with an extent");
    // A narrow stand gets a plot that is at least half as wide as long.
    cell_m_ = glm::max(margin * cell_m_, glm::dvec2(std::max(0.5 * larger_m, least_m)));
    cell_m_ = {rounded_up(cell_m_.x), rounded_up(cell_m_.y)};
    rows_ = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(meshes_.size()))));
    columns_ = block_count(meshes_.size(), rows_);
  }

  void add_head() {
    text_ += "# Made by `sunfleck new` from ";
    for (std::size_t i = 0; i < meshes_.size(); ++i) text_ += (i > 0 ? ", " : "") + printable(meshes_[i].mesh.name);
    text_ += ".\n# Every value without a reason is only an example: set your own light and optics.\n";
    text_ += fmt::format("title = {}\n", toml_string(std::filesystem::path(meshes_.front().mesh.name).stem().string()));
    text_ += fmt::format(
        "\n[plot]\nsize     = [{:.6g}, {:.6g}]   # m along X (south) and Z (west)\n"
        "periodic = false   # the plants stand alone; true: a field that repeats this plot without end\n",
        static_cast<double>(columns_) * cell_m_.x, static_cast<double>(rows_) * cell_m_.y);
  }

  void add_light() {
    text_ +=
        "\n[sun]\ntime      = 2024-07-10T14:00:00+02:00   # about noon by the sun\nlatitude  = 48.85\nlongitude = 2.35\n"
        "\n[[band]]\nname   = \"PAR\"\ndirect = 350.0   # W m-2 on level ground\n"
        "\n[soil]\nreflectance = 0.15\n"
        "\n[accuracy]   # for a first look; without this table 0.001 and 0.003\ndirect   = 0.01\nindirect = 0.01\n";
  }

  // Adds optics for each material, whichever mesh has it first; for each role of the organs where these alone tell roles.
  void add_optics() {
    std::set<std::string> written;
    for (const SurveyedMesh& mesh : meshes_) {
      for (const MeshShare& share : has_roles_by_organ(mesh) ? mesh.survey.families : mesh.survey.materials) {
        const std::string name = has_roles_by_organ(mesh) ? std::string(role_name(share.role)) : optics_name(share);
        if (!written.insert(name).second) continue;
        if (share.role == Role::soil && share.role_from == RoleSource::name) continue;  // [soil] describes it
        add_typical_optics(name, share);
      }
    }
  }

  // Returns the name of a material's optics; triangles without one have those of their role.
  [[nodiscard]] static std::string optics_name(const MeshShare& material) {
    return material.name == no_material ? std::string(role_name(material.role)) : material.name;
  }

  void add_typical_optics(const std::string& name, const MeshShare& share) {
    const TypicalOptics& optics = *std::find_if(std::begin(typical), std::end(typical),
                                                [&](const TypicalOptics& known) { return known.role == share.role; });
    text_ += fmt::format("\n[optics.{}]   # {} by its {}\nreflectance   = {:.2f}\n", toml_key(name), role_name(share.role),
                         role_source_name(share.role_from), optics.reflectance);
    if (optics.transmittance > 0.0) text_ += fmt::format("transmittance = {:.2f}\n", optics.transmittance);
    if (share.role_from == RoleSource::shape) text_ += fmt::format("role          = \"{}\"\n", role_name(share.role));
  }

  // Returns whether a mesh names no material, but organs of several roles.
  [[nodiscard]] static bool has_roles_by_organ(const SurveyedMesh& mesh) {
    const std::vector<MeshShare>& families = mesh.survey.families;
    if (mesh.survey.has_materials()) return false;
    return std::any_of(families.begin(), families.end(),
                       [&](const MeshShare& family) { return family.role != families.front().role; });
  }

  // Returns the role of most of a mesh's area.
  [[nodiscard]] static Role usual_role(const std::vector<MeshShare>& families) {
    std::map<Role, double> areas;
    for (const MeshShare& family : families) areas[family.role] += family.area;
    return std::max_element(areas.begin(), areas.end(), [](const auto& a, const auto& b) { return a.second < b.second; })
        ->first;
  }

  // Gives each organ the optics of its role. The longest names come first, since their beginnings may be names, too.
  void add_optics_by_organ(const SurveyedMesh& mesh) {
    std::vector<MeshShare> families = mesh.survey.families;
    const Role usual = usual_role(families);
    std::stable_sort(families.begin(), families.end(),
                     [](const MeshShare& a, const MeshShare& b) { return a.name.size() > b.name.size(); });
    const auto shadowed = [&](const MeshShare& family) {
      return std::any_of(families.begin(), families.end(), [&](const MeshShare& other) {
        return other.role != usual && lower_case(family.name).starts_with(lower_case(other.name));
      });
    };
    text_ += "optics = { ";
    for (const MeshShare& family : families) {
      if (family.role != usual || shadowed(family))
        text_ += fmt::format("{} = \"{}\", ", toml_string(family.name + "*"), role_name(family.role));
    }
    text_ += fmt::format("\"*\" = \"{}\" }}   # by the names of organs: the file names no material\n", role_name(usual));
  }

  void add_geometry(std::size_t number) {
    const SurveyedMesh& mesh = meshes_[number];
    const FrameGuess& frame = mesh.survey.frame;
    const std::size_t column = number / rows_, row = number % rows_;
    const glm::dvec2 centre_m = {(static_cast<double>(column) + 0.5) * cell_m_.x, (static_cast<double>(row) + 0.5) * cell_m_.y};
    text_ += fmt::format("\n[[geometry]]\nfile  = {}   # {} triangles, {:.5g} m2 (one-sided)\n", toml_string(mesh.mesh.name),
                         mesh.survey.triangles, mesh.survey.area_m2());
    add_optics_of_unnamed(mesh);
    if (mesh.survey.needs_split())
      text_ += fmt::format("split = \"parts\"   # {} connected pieces become organs of their own\n", mesh.survey.shape.pieces);
    add_frame(frame);
    const double up_m = lift_m(mesh);
    text_ += fmt::format("at    = [[{:.5f}, {:.5f}, {:.5f}]]   # moves the middle of the mesh there{}\n",
                         centre_m.x - 0.5 * (mesh.lo_m.x + mesh.hi_m.x), up_m, centre_m.y - 0.5 * (mesh.lo_m.z + mesh.hi_m.z),
                         up_m == 0.0 ? "" : ", and its lowest point to the ground");
  }

  // Gives triangles without a material optics, and leaves those of the file's materials as they are.
  void add_optics_of_unnamed(const SurveyedMesh& mesh) {
    const std::vector<MeshShare>& materials = mesh.survey.materials;
    const auto unnamed = [](const MeshShare& share) { return share.name == no_material; };
    if (std::none_of(materials.begin(), materials.end(), unnamed)) return;
    if (has_roles_by_organ(mesh)) {
      add_optics_by_organ(mesh);
      return;
    }
    if (materials.size() == 1) {
      text_ += fmt::format("optics = \"{}\"   # the file names no material\n", optics_name(materials.front()));
      return;
    }
    text_ += fmt::format("optics = {{ \"{}\" = \"{}\"", unnamed_material,
                         optics_name(*std::find_if(materials.begin(), materials.end(), unnamed)));
    for (const MeshShare& share : materials) {
      if (!unnamed(share)) text_ += fmt::format(", {} = {}", toml_string(share.name), toml_string(share.name));
    }
    text_ += " }   # some triangles have no material\n";
  }

  // What the format defines needs no keys.
  void add_frame(const FrameGuess& frame) {
    if (frame.up_certainty != Certainty::known) {
      text_ += fmt::format("# {}: {}\n", certainty_name(frame.up_certainty), frame.up_reason);
      text_ += fmt::format("up    = \"{}\"{}\n", axis_name(frame.up), alternative_up(frame));
    }
    if (frame.unit_certainty != Certainty::known) {
      text_ += fmt::format("# {}: {}\n", certainty_name(frame.unit_certainty), frame.unit_reason);
      text_ += fmt::format("scale = {:.6g}   # metres per unit{}\n", frame.metres_per_unit, alternative_unit(frame));
    }
  }

  static std::string alternative_up(const FrameGuess& frame) {
    const bool open = frame.up_certainty == Certainty::likely || frame.up_certainty == Certainty::unsure;
    return open ? fmt::format("   # if the plant lies on its side: \"{}\"", axis_name(frame.other_up)) : "";
  }

  static std::string alternative_unit(const FrameGuess& frame) {
    const bool open = frame.unit_certainty == Certainty::likely || frame.unit_certainty == Certainty::unsure;
    return open ? fmt::format("; if the plant has the wrong size: {:.6g}", frame.other_metres_per_unit) : "";
  }

  std::vector<SurveyedMesh> meshes_;
  glm::dvec2 cell_m_{0.0};  // along X and Z
  std::size_t rows_ = 1, columns_ = 1;
  std::string text_;
};

}  // namespace

std::string mesh_scene_text(std::span<const MeshToShow> meshes, bool allow_outside, SourceFiles* files) {
  EXPECT(meshes.empty(), ==, false);
  std::vector<SurveyedMesh> found;
  for (const MeshToShow& mesh : meshes) found.push_back(surveyed(mesh, allow_outside, files));
  return MeshSceneText(std::move(found)).write();
}

}  // namespace sunfleck
