#include "files/scene/scene_geometry.h"

#include "base/file.h"
#include "base/suggestions.h"
#include "files/formats/mesh/mesh_content.h"
#include "files/formats/mesh/mesh_survey.h"
#include "files/scene/scene_files.h"
#include "files/scene/scene_positions.h"
#include "files/scene/toml_text.h"
#include "physics/canopy/canopy.h"
#include "physics/canopy/shared_meshes.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <set>
#include <utility>

namespace sunfleck {

namespace {

namespace fs = std::filesystem;

constexpr std::int64_t most_rows = 10000;

GeometryPart read_generator(const TomlTable& table, std::int64_t& plants_so_far) {
  static_cast<void>(table.word("generator", {"maize"}));  // the only generator
  for (const char* key : {"optics", "up", "scale", "heading", "at", "positions", "plant", "role", "split", "instances"}) {
    if (table.has(key))
      table.refuse(key, "it is only for files; a generated stand fills the plot from its corner", "remove it");
  }
  MaizeStand stand;
  stand.rows = static_cast<int>(table.integer("rows", 1, most_rows).value_or(stand.rows));
  stand.per_row = static_cast<int>(table.integer("per_row", 1, most_rows).value_or(stand.per_row));
  plants_so_far += std::int64_t{stand.rows} * stand.per_row;
  constexpr auto most_plants = static_cast<std::int64_t>(most_maize_plants);
  if (plants_so_far > most_plants) {
    table.refuse(table.has("rows")      ? "rows"
                 : table.has("per_row") ? "per_row"
                                        : "generator",
                 fmt::format("rows * per_row gives {} plants, but at most {} are allowed", plants_so_far, most_plants),
                 "use fewer; a periodic plot repeats them without end");
  }
  const auto spacing_m =
      table.numbers("spacing", 2, {.lo = 0.0, .hi = 1000.0, .lo_open = true, .cure = "give metres, as [0.6, 0.6]"});
  if (spacing_m) {
    stand.spacing_in_row_m = (*spacing_m)[0];
    stand.spacing_between_rows_m = (*spacing_m)[1];
  }
  const auto seed = table.integer("seed", 0, std::numeric_limits<std::int64_t>::max());
  if (seed) stand.seed = static_cast<std::uint64_t>(*seed);
  return GeometryPart{.table = table, .maize = stand, .mesh = nullptr, .file = {}, .import = {}, .placements = {Placement{}}};
}

fs::path find_mesh(const TomlTable& table, const fs::path& scene_file, const SceneAccess& access) {
  fs::path file = find_scene_file(table, scene_file, access, "name a mesh file");
  if (!is_mesh_file(file)) {
    if (const auto ending = mesh_ending_of_file(file)) {
      table.refuse("file", fmt::format("its name does not tell the format, but its content looks like {}", *ending),
                   fmt::format("rename it so that it ends in {}", *ending));
    }
    table.refuse("file", "its format is unknown", fmt::format("use {}", readable_meshes));
  }
  return file;
}

const Mesh* find_given_mesh(const TomlTable& table, const SceneText& source) {
  const std::string name = *table.text("mesh");
  const auto found = source.meshes.find(name);
  if (found == source.meshes.end()) table.refuse("mesh", "there is no mesh of that name", "correct the name");
  return &found->second;
}

// Returns whether the names of a mesh's materials need no optics if its role is given.
bool has_plain_role(const std::optional<Role>& role) {
  return role == Role::soil || role == Role::structure;
}

GeometryPart read_mesh_part(const TomlTable& table, const SceneText& source, const Plot& plot, const SceneAccess& access) {
  for (const char* key : {"rows", "per_row", "spacing", "seed"}) {
    if (table.has(key)) table.refuse(key, "it is only for generator = \"maize\"", "remove it; place a file's copies with `at`");
  }
  MeshImport import;
  std::vector<OpticsRule> optics = read_optics_rules(table);
  if (!optics.empty()) import.optics = table.is_table("optics") ? std::string(unnamed_material) : optics.front().optics;
  const std::optional<Role> role = read_role(table);
  if (optics.empty() && has_plain_role(role)) import.optics = role_name(*role);
  import.allow_outside = access.allow_outside;
  import.axes = plot.axes;
  if (const auto up = table.word("up", {"x", "y", "z"})) import.up = static_cast<FileAxis>(*up);
  import.scale = table.number("scale", {.lo = 0.0, .hi = 1e9, .lo_open = true, .cure = "give 0.01 for a file in cm"})
                     .value_or(import.scale);
  if (const auto split = table.word("split", organ_split_names())) import.split = static_cast<OrganSplit>(*split);
  std::vector<Placement> placements = read_placements(table, source.file, plot, access);
  const Mesh* given = table.has("mesh") ? find_given_mesh(table, source) : nullptr;
  fs::path file = given != nullptr ? fs::path() : find_mesh(table, source.file, access);
  // What is digitised for a scene with z up has z up itself.
  if (!import.up && plot.axes == Axes::east_north_up && !frame_of_format(file).up) import.up = FileAxis::z;
  return GeometryPart{.table = table,
                      .maize = std::nullopt,
                      .mesh = given,
                      .file = std::move(file),
                      .import = import,
                      .optics = std::move(optics),
                      .placements = std::move(placements),
                      .role = role,
                      .instances = table.boolean("instances")};
}

// Returns the least memory of a direct-only run, including the tree, for this many triangles.
double bytes_of(std::size_t triangles, bool shared) {
  return (shared ? 70.0 : 200.0) * static_cast<double>(triangles);
}

void refuse_many(const GeometryPart& part, std::size_t triangles, double bytes) {
  const double memory = static_cast<double>(physical_memory_bytes());
  if (bytes <= memory) return;
  part.table.refuse(part.source_key(),
                    fmt::format("{} triangles so far need about {:.0f} GB of memory, but this machine has only {:.0f} GB",
                                triangles, bytes * 1e-9, 1e-9 * memory),
                    "place fewer copies, or use a coarser mesh");
}

void refuse_far(const GeometryPart& part, const Mesh& mesh) {
  double farthest = 0.0;
  double largest_scale = 1.0;
  for (const Placement& placement : part.placements) largest_scale = std::max(largest_scale, placement.scale);
  for (const glm::dvec3& vertex_m : mesh.vertices) {
    farthest = std::max({farthest, std::abs(vertex_m.x), std::abs(vertex_m.y), std::abs(vertex_m.z)});
  }
  farthest *= largest_scale;
  if (farthest > farthest_m) {
    part.table.refuse(part.source_key(),
                      fmt::format("it extends to {:.3g} m, but at most {:.0e} m is allowed", farthest, farthest_m),
                      "give its unit with scale, e.g. scale = 0.001 for millimetres");
  }
}

Mesh load_mesh(const GeometryPart& part, SourceFiles& files) {
  if (part.maize) return make_maize(*part.maize);
  return part.mesh != nullptr ? import_mesh(*part.mesh, part.table.place("mesh"), part.import)
                              : read_mesh(part.file, part.import, &files);
}

const OpticsInput* find_optics(const OpticsByName& defined, const std::string& name) {
  const auto found = defined.find(name);
  return found == defined.end() ? nullptr : &found->second;
}

bool is_soil(std::string_view optics_name) {
  return role_from_name(optics_name) == Role::soil;
}

// Returns advice about an undefined name.
std::string cure_of_undefined(const std::string& name, const OpticsByName& defined) {
  std::vector<std::string> names;
  for (const auto& [known, input] : defined) names.push_back(known);
  const std::string add = is_soil(name) ? fmt::format("add [optics.{}] or [soil]", toml_key(printable(name)))
                                        : fmt::format("add [optics.{}] with reflectance", toml_key(printable(name)));
  const auto nearest = nearest_word(name, names);
  return nearest ? fmt::format("did you mean {}? Otherwise {}", printable(*nearest), add) : add;
}

[[noreturn]] void refuse_undefined(const GeometryPart& part, const std::string& name, const OpticsByName& defined) {
  const bool named = part.table.is_text("optics") && part.table.text("optics") == name;
  part.table.refuse(named ? std::string_view("optics") : part.source_key(),
                    fmt::format("it uses optics \"{}\", which is not defined", printable(name)),
                    cure_of_undefined(name, defined));
}

SurfaceOptics structure_optics(std::size_t bands) {
  SurfaceOptics optics;
  optics.name = plain_structure;
  optics.upper.assign(bands, {plain_structure_reflectance, 0.0});
  optics.lower = optics.upper;
  return optics;
}

SurfaceOptics soil_optics(const std::string& name, const Soil& soil) {
  SurfaceOptics optics;
  optics.name = name;
  optics.rgb = soil.rgb;
  for (const double reflectance : soil.reflectance) optics.upper.push_back({reflectance, 0.0});
  optics.lower = optics.upper;
  return optics;
}

void allow_keys(const TomlTable& table, const SceneText& source) {
  if (source.meshes.empty()) {
    table.allow({"generator", "rows", "per_row", "spacing", "seed", "file", "optics", "up", "scale", "heading", "at",
                 "positions", "plant", "role", "split", "instances"});
  } else {
    table.allow({"generator", "rows", "per_row", "spacing", "seed", "file", "mesh", "optics", "up", "scale", "heading", "at",
                 "positions", "plant", "role", "split", "instances"});
  }
}

// Requires exactly one of generator, file and mesh.
void require_one_source(const TomlTable& table) {
  for (const char* other : {"file", "mesh"}) {
    if (!table.has(other)) continue;
    for (const char* first : {"generator", "file"}) {
      if (std::string_view(first) == other || !table.has(first)) continue;
      table.refuse(other, fmt::format("{} is also given", first),
                   "keep one of the two, and add another [[geometry]] for the other");
    }
  }
  if (!table.has("generator") && !table.has("mesh")) table.require("file", "file = \"stand.glb\", or generator = \"maize\"");
}

}  // namespace

std::vector<GeometryPart> read_geometry(const TomlTable& root, const SceneText& source, const Plot& plot,
                                        const SceneAccess& access) {
  std::vector<GeometryPart> parts;
  std::int64_t plants = 0;  // total of all generators
  for (const TomlTable& table : root.tables("geometry")) {
    allow_keys(table, source);
    require_one_source(table);
    parts.push_back(table.has("generator") ? read_generator(table, plants) : read_mesh_part(table, source, plot, access));
  }
  return parts;
}

std::vector<PlacedMesh> load_geometry(std::span<const GeometryPart> parts, SourceFiles& files,
                                      std::vector<std::string>& warnings) {
  constexpr std::size_t least_of_plant = 10'000;  // triangles
  std::vector<PlacedMesh> meshes;
  std::size_t triangles = 0;
  double bytes = 0.0;
  UsedPlants plants;
  for (const GeometryPart& part : parts) {
    if (part.maize) {
      const std::size_t of_maize =
          least_of_plant * static_cast<std::size_t>(part.maize->rows) * static_cast<std::size_t>(part.maize->per_row);
      refuse_many(part, triangles + of_maize, bytes + bytes_of(of_maize, false));
    }
    meshes.push_back({load_mesh(part, files), part.placements, part.role, part.instances});
    Mesh& mesh = meshes.back().mesh;
    apply_optics_rules(part.table, part.optics, mesh, warnings);
    check_plant_numbers(part.table, mesh, part.placements, plants);
    refuse_far(part, mesh);
    const std::size_t placed = mesh.triangles.size() * part.placements.size();
    triangles += placed;
    bytes += bytes_of(placed, shares_triangles(meshes.back(), triangles));
    refuse_many(part, triangles, bytes);
  }
  return meshes;
}

void name_plain_optics(std::span<const GeometryPart> parts, std::span<PlacedMesh> meshes, const OpticsByName& defined,
                       std::vector<std::string>& warnings) {
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (!has_plain_role(parts[i].role) || !parts[i].optics.empty()) continue;
    std::string plain(role_name(*parts[i].role));
    if (parts[i].role == Role::structure && find_optics(defined, plain) == nullptr) plain = plain_structure;
    std::set<std::string> renamed;
    for (std::string& name : meshes[i].mesh.optics_names) {
      if (find_optics(defined, name) != nullptr) continue;
      renamed.insert(printable(name));
      name = plain;
    }
    if (renamed.empty() || plain != plain_structure) continue;
    warnings.push_back(
        fmt::format("{}: the optics of {} are not given, so they reflect {} in every band and transmit nothing; add "
                    "[optics.structure] for all of them",
                    parts[i].table.place(parts[i].source_key()), fmt::join(renamed, ", "), plain_structure_reflectance));
  }
}

void check_optics(std::span<const GeometryPart> parts, std::span<const PlacedMesh> meshes, const OpticsByName& defined,
                  const Scene& scene) {
  const auto is_defined = [&](const std::string& name) {
    return find_optics(defined, name) != nullptr || (is_soil(name) && scene.model.soil) || name == plain_structure;
  };
  for (std::size_t i = 0; i < parts.size(); ++i) {
    for (const OpticsRule& rule : parts[i].optics) {
      if (is_defined(rule.optics) || !parts[i].table.is_table("optics")) continue;
      parts[i].table.table("optics")->refuse(rule.pattern, "these optics are not defined",
                                             cure_of_undefined(rule.optics, defined));
    }
    for (const std::string& name : meshes[i].mesh.optics_names) {
      if (!is_defined(name)) refuse_undefined(parts[i], name, defined);
    }
  }
}

std::vector<SurfaceOptics> optics_of_names(const TomlTable& root, std::span<const std::string> names,
                                           const OpticsByName& defined, const RadiationModel& model) {
  std::vector<SurfaceOptics> chosen;
  for (const std::string& name : names) {
    const OpticsInput* input = find_optics(defined, name);
    if (input != nullptr) {
      chosen.push_back(input->optics);
    } else if (is_soil(name) && model.soil) {
      chosen.push_back(soil_optics(name, *model.soil));
    } else if (name == plain_structure) {
      chosen.push_back(structure_optics(model.bands.size()));
    } else {
      root.refuse_table(fmt::format("the canopy uses optics \"{}\", which is not defined", printable(name)),
                        cure_of_undefined(name, defined));
    }
  }
  return chosen;
}

}  // namespace sunfleck
