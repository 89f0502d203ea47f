#include "programs/cli/new.h"

#include "base/error.h"
#include "base/file.h"
#include "base/log.h"
#include "base/text.h"
#include "files/scene/mesh_scene.h"
#include "programs/cli/terminal.h"
#include "simulate/interrupt.h"
#include "simulate/scene_source.h"

#include <fmt/format.h>

#include <string>
#include <system_error>
#include <vector>

namespace sunfleck {
namespace {

namespace fs = std::filesystem;

void check_output(const NewOptions& options) {
  const std::string name = printable(options.output.string());
  if (options.output.extension() != ".toml") throw_input(name, "a scene file ends in .toml", "give a name like stand.toml");
  std::error_code error;
  if (!options.force && fs::exists(fs::symlink_status(options.output, error)))
    throw_input(name, "it exists already", "give another name, or --force to replace it");
  expect_folder_of(options.output);
}

}  // namespace

int write_new_scene(const NewOptions& options) {
  start_log(Verbosity::normal);
  exit_on_interrupts();
  const bool to_file = !options.output.empty();
  if (to_file) check_output(options);
  const fs::path folder = options.output.parent_path();
  std::vector<MeshToShow> meshes;
  bool outside = false;
  for (const fs::path& file : options.meshes) {
    const fs::path name = name_from(folder, file);
    outside = outside || name.is_absolute();
    meshes.push_back({file, name.generic_string()});
  }
  const std::string text = mesh_scene_text(meshes, options.allow_outside);
  const fs::path scene_file = to_file ? options.output : fs::path("stand.toml");
  const Scene scene = read_scene(SceneText{scene_file, text, {}}, {.allow_outside = options.allow_outside || outside});
  for (const std::string& warning : scene.warnings) warn(warning);
  if (!to_file) {
    fmt::print("{}", text);
    return exit_done;
  }
  write_file(options.output, text);
  const std::string written = printable(options.output.string());
  fmt::print("{}: {}, {}; next: sunfleck run {}{}\n", written, counted(scene.model.canopy.size(), "triangle"),
             counted(scene.model.canopy.organs.size(), "organ"), in_shell(written), outside ? " --allow-outside" : "");
  return exit_done;
}

}  // namespace sunfleck
