#include "programs/viewer/session.h"

#include "base/text.h"
#include "files/formats/mesh/mesh_reader.h"
#include "physics/canopy/axes.h"
#include "simulate/scene_source.h"

#include <fmt/format.h>

namespace sunfleck {
namespace {

Scene checked_scene(const ViewOptions& options, const std::filesystem::path& file, SourceFiles& files) {
  // CARIBU's files belong to the file of the command line, not to one that was dropped on the window.
  const StandFiles stand = file == options.run.scene ? options.run.stand : StandFiles{};
  Scene scene = load_scene({file, stand, options.run.allow_outside, true}, ScenePurpose::moment, &files);
  check_view(scene.model, options.run.pictures);
  check_grid(options.run, scene);
  return scene;
}

template <class Named>
std::vector<std::string> names_of(const std::vector<Named>& things) {
  std::vector<std::string> names;
  for (const Named& thing : things) names.push_back(thing.name);
  return names;
}

// Returns the number of triangles and the size of the plot in a line.
std::string text_of_plot(const RadiationModel& model) {
  const Plot& plot = model.plot;
  const glm::dvec2 size_m = along_level_axes(plot.axes, {plot.size_x_m, plot.size_z_m});
  return fmt::format("{}, plot {:.4g} x {:.4g} m{}", counted(model.canopy.size(), "triangle"), size_m.x, size_m.y,
                     plot.periodic ? ", periodic" : "");
}

// Returns the run options for the scene that is shown, which decides the folder and the name of saved files.
RunOptions run_options(const ViewOptions& options, const std::filesystem::path& file) {
  RunOptions run = options.run;
  run.scene = file;
  return run;
}

}  // namespace

bool can_show(const std::filesystem::path& file) {
  return lower_case(file.extension().string()) == ".toml" || is_mesh_file(file);
}

Session::Session(const ViewOptions& options, const std::filesystem::path& scene_file, SourceFiles& files,
                 const std::function<void()>& notify)
    : file(scene_file),
      simulation(checked_scene(options, file, files), options.run, EngineUse::shared_with_window),
      title(simulation.scene().title),
      plot_text(text_of_plot(simulation.model())),
      light_of_scene(request_of(simulation.scene())),
      bands(names_of(simulation.model().bands)),
      optics(names_of(simulation.model().optics)),
      warnings(simulation.scene().warnings),
      box(shown_box(simulation.model(), simulation.layout())),
      light(simulation, run_options(options, file), notify),
      picture(light, simulation.tracing(), notify) {}

}  // namespace sunfleck
