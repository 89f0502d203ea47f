// Fuzzes the files that days and runs keep in order to be resumed.

#include "files/results/stores/run_store.h"
#include "files/results/stores/step_store.h"
#include "fuzz/support.h"

#include <zlib.h>

#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>

namespace sunfleck::fuzz {

void feed_step(std::string_view bytes);
void feed_step_settings(std::string_view bytes);
void feed_run_state(std::string_view bytes);

namespace {

// Returns a file with this eight-letter mark, the right checksum and any bytes, so that fuzzing reaches beyond the checksum.
std::string sealed_as(std::string file, std::string_view bytes) {
  const auto sum = static_cast<std::uint32_t>(crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
  file.resize(file.size() + sizeof sum);
  std::memcpy(file.data() + 8, &sum, sizeof sum);
  return file.append(bytes);
}

RadiationModel small_model() {
  RadiationModel model;
  model.canopy.corners = std::vector<Triangle>(3);
  model.canopy.organ_of = {0, 0, 1};
  model.canopy.optics_of = {0, 0, 0};
  model.canopy.optics_names = {"leaf"};
  model.canopy.plants = {{1, {0.5, 0.0, 0.5}}};
  model.canopy.organs.resize(2);
  model.bands.resize(2);
  model.sky = SkyModel{};
  model.planes = {{0.5, 2, 1}};
  model.sensors = {{"point", {{0.5, 0.0, 0.5}}}};
  return model;
}

StepStore store() {
  return {folder(), small_model(), {{"scene_digest", "0123"}, {"seed", 1}}, StepFields::kept};
}

}  // namespace

void feed_step(std::string_view bytes) {
  std::filesystem::create_directories(folder() / "steps");
  static_cast<void>(write("steps/step_00007.bin", sealed_as("SUNSTEP9", bytes)));
  read_or_refuse([] {
    const auto step = store().read(7);
    if (step)
      promise(step->light.bands.size() == 2 && step->light.organ_absorbed.size() == 4 &&
                  step->light.plant_absorbed_w.size() == 2 && step->light.points.size() == 2 &&
                  step->light.plane_down.size() == 2 && step->maps.size() == 10,
              "a step of this scene");
  });
}

void feed_step_settings(std::string_view bytes) {
  std::filesystem::create_directories(folder() / "steps");
  static_cast<void>(write("steps/settings.json", bytes));
  read_or_refuse([] { static_cast<void>(store().find()); });
}

void feed_run_state(std::string_view bytes) {
  static_cast<void>(write(run_state_file, sealed_as("SUNRUNSA", bytes)));
  read_or_refuse([&] {
    const auto state = RunStore(folder(), {{"scene_digest", "0123"}, {"seed", 1}}).read(StateShape{2, 3, 2, 1.0});
    promise(state && state->replicates() >= 2 && state->sums.reals.size() == 2, "a state of this run");
  });
}

}  // namespace sunfleck::fuzz
