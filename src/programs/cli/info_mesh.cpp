#include "programs/cli/info_mesh.h"

#include "base/file.h"
#include "base/text.h"
#include "files/formats/mesh/mesh_survey.h"
#include "physics/canopy/role.h"
#include "programs/cli/terminal.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace sunfleck {
namespace {

using nlohmann::ordered_json;

double squared(double x) {
  return x * x;
}

ordered_json triple(const glm::dvec3& v) {
  return {v.x, v.y, v.z};
}

ordered_json share_json(const MeshShare& share, double unit_m2) {
  return {{"name", share.name},
          {"triangles", share.triangles},
          {"area_m2", share.area * unit_m2},
          {"organs", share.organs},
          {"pieces", share.pieces},
          {"flatness", share.flatness},
          {"role", role_name(share.role)},
          {"role_from", role_source_name(share.role_from)}};
}

ordered_json shares_json(const std::vector<MeshShare>& shares, double unit_m2) {
  ordered_json list = ordered_json::array();
  for (const MeshShare& share : shares) list.push_back(share_json(share, unit_m2));
  return list;
}

ordered_json frame_json(const FrameGuess& frame) {
  return {{"summary", frame.summary()},
          {"up", axis_name(frame.up)},
          {"up_certainty", certainty_name(frame.up_certainty)},
          {"up_reason", frame.up_reason},
          {"other_up", axis_name(frame.other_up)},
          {"metres_per_unit", frame.metres_per_unit},
          {"unit_certainty", certainty_name(frame.unit_certainty)},
          {"unit_reason", frame.unit_reason},
          {"other_metres_per_unit", frame.other_metres_per_unit}};
}

ordered_json survey_json(const std::filesystem::path& file, const MeshSurvey& survey, const NamedParts& named) {
  const double unit_m2 = squared(survey.frame.metres_per_unit);
  return {{"file", file.string()},
          {"frame", frame_json(survey.frame)},
          {"box", {{"lo", triple(survey.shape.lo)}, {"hi", triple(survey.shape.hi)}}},
          {"vertices", survey.vertices},
          {"triangles", survey.triangles},
          {"area_units2", survey.area},
          {"area_m2", survey.area_m2()},
          {"plants", survey.plants},
          {"organs", survey.organs},
          {"objects", named.objects},
          {"groups", named.groups},
          {"organ_names", shares_json(survey.families, unit_m2)},
          {"materials", survey.has_materials() ? shares_json(survey.materials, unit_m2) : ordered_json::array()},
          {"split_in_parts", survey.needs_split()},
          {"pieces", survey.shape.pieces},
          {"closed_pieces", survey.closed_pieces},
          {"usual_piece_m2", survey.shape.usual_leaf * unit_m2},
          {"area_below_ground_m2", survey.area_below_ground * unit_m2},
          {"defects",
           {{"zero_area", survey.defects.flat_triangles},
            {"slivers", survey.defects.slivers},
            {"coincident", survey.defects.coincident},
            {"non_manifold_edges", survey.defects.crowded_edges},
            {"flipped_edges", survey.defects.flipped_edges},
            {"unused_vertices", survey.defects.unused_vertices},
            {"organs", survey.defects.organs}}}};
}

void print_shares(const char* heading, const std::vector<MeshShare>& shares, double unit_m2) {
  constexpr std::size_t most_lines = 20;
  fmt::print("  {}\n", heading);
  for (std::size_t i = 0; i < std::min(shares.size(), most_lines); ++i) {
    const MeshShare& share = shares[i];
    fmt::print("    {}: {}, {}, {:.5g} m2 in {}; counts as {} by its {}\n", printable(share.name),
               counted(share.organs, "organ"), counted(share.triangles, "triangle"), share.area * unit_m2,
               counted(share.pieces, "piece"), role_name(share.role), role_source_name(share.role_from));
  }
  if (shares.size() > most_lines) fmt::print("    and {} more (--json lists them all)\n", shares.size() - most_lines);
}

// Returns the first names, as " (in leaf, stem and 3 more)"; nothing without names.
std::string among(const std::vector<std::string>& names) {
  constexpr std::size_t most_names = 5;
  std::string text;
  for (std::size_t i = 0; i < std::min(names.size(), most_names); ++i) text += (i == 0 ? "" : ", ") + printable(names[i]);
  if (names.size() > most_names) text += fmt::format(" and {} more", names.size() - most_names);
  return text.empty() ? "" : " (in " + text + ")";
}

void print_defects(const MeshDefects& defects) {
  std::vector<std::string> found;
  const auto add = [&](std::size_t count, const char* one, const char* many) {
    if (count > 0) found.push_back(fmt::format("{} {}", count, count == 1 ? one : many));
  };
  add(defects.flat_triangles, "triangle without area", "triangles without area");
  add(defects.slivers, "sliver", "slivers");
  add(defects.coincident, "triangle that coincides with an earlier one", "triangles that coincide with earlier ones");
  if (!found.empty()) found.back() += among(defects.organs);
  add(defects.crowded_edges, "edge of three or more triangles", "edges of three or more triangles");
  add(defects.flipped_edges, "edge whose triangles face opposite ways", "edges whose triangles face opposite ways");
  add(defects.unused_vertices, "vertex in no triangle", "vertices in no triangle");
  std::string line;
  for (const std::string& defect : found) line += (line.empty() ? "" : ", ") + defect;
  fmt::print("  defects: {}\n", line.empty() ? "none" : line);
}

// Returns both ends with as many digits as tell them apart to five digits of the range, five or more.
std::string range_text(double lo, double hi) {
  const double larger = std::max(std::abs(lo), std::abs(hi));
  const double digits = 5.0 + (hi > lo ? std::floor(std::log10(larger / (hi - lo))) : 0.0);
  return fmt::format("{0:.{2}g}..{1:.{2}g}", lo, hi, static_cast<int>(std::clamp(digits, 5.0, 15.0)));
}

void print_survey(const std::filesystem::path& file, const MeshSurvey& survey, const NamedParts& named) {
  const ShapeFigures& shape = survey.shape;
  const double unit_m2 = squared(survey.frame.metres_per_unit);
  fmt::print("{}: {}\n", printable(file.string()), survey.frame.summary());
  fmt::print("  up: {} ({}: {})\n", axis_name(survey.frame.up), certainty_name(survey.frame.up_certainty),
             survey.frame.up_reason);
  fmt::print("  unit: {} ({}: {})\n", unit_name(survey.frame.metres_per_unit), certainty_name(survey.frame.unit_certainty),
             survey.frame.unit_reason);
  fmt::print("  box: x {}, y {}, z {}\n", range_text(shape.lo.x, shape.hi.x), range_text(shape.lo.y, shape.hi.y),
             range_text(shape.lo.z, shape.hi.z));
  fmt::print("  {}, one-sided area {:.5g} m2{}\n", counted(survey.triangles, "triangle"), survey.area_m2(),
             survey.frame.metres_per_unit == 1.0 ? "" : fmt::format(" ({:.5g} square units)", survey.area));
  fmt::print("  {}, {}, {}, {} of them closed\n", counted(survey.plants, "plant"), counted(survey.organs, "organ"),
             counted(shape.pieces, "connected piece"), survey.closed_pieces);
  fmt::print("  named in the file: {}, {}, {}\n", counted(named.objects, "object"), counted(named.groups, "group"),
             counted(survey.has_materials() ? survey.materials.size() : 0, "material"));
  if (survey.needs_split()) fmt::print("  split = \"parts\" in a scene makes an organ of each piece\n");
  print_shares("organs by name:", survey.families, unit_m2);
  if (survey.has_materials())
    print_shares("materials:", survey.materials, unit_m2);
  else
    fmt::print("  materials: none\n");
  print_defects(survey.defects);
  if (survey.area_below_ground > 0.0)
    fmt::print("  below the ground ({} < 0): {:.5g} m2\n", axis_name(survey.frame.up), survey.area_below_ground * unit_m2);
}

}  // namespace

int show_meshes(const InfoOptions& options) {
  start_at_terminal(options.run);
  ordered_json meshes = ordered_json::array();
  for (const std::filesystem::path& file : options.meshes) {
    NamedParts named;
    const Mesh mesh = read_mesh_as_is(file, options.run.allow_outside, nullptr, &named);
    const MeshSurvey survey = survey_mesh(mesh, frame_of_format(file));
    if (options.run.json)
      meshes.push_back(survey_json(file, survey, named));
    else
      print_survey(file, survey, named);
  }
  if (options.run.json)
    fmt::print("{}\n", ordered_json{{"meshes", meshes}}.dump(2, ' ', false, ordered_json::error_handler_t::replace));
  return exit_done;
}

}  // namespace sunfleck
