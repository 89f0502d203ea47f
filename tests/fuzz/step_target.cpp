// The steps that a day keeps to be resumed.

#include "fuzz/support.h"
#include "io/step_store.h"

#include <zlib.h>

#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>

namespace sunfleck::fuzz {

void feed_step(std::string_view bytes);
void feed_step_settings(std::string_view bytes);

namespace {

RadiationModel small_model() {
  RadiationModel model;
  model.canopy.corners.resize(3);
  model.canopy.organs.resize(2);
  model.bands.resize(2);
  model.sky = SkyModel{};
  return model;
}

StepStore store() {
  return {folder(), small_model(), {{"scene_digest", "0123"}, {"seed", 1}}};
}

}  // namespace

// The bytes follow the file's letters and their own check sum, so that more than the check sum is tried.
void feed_step(std::string_view bytes) {
  std::filesystem::create_directories(folder() / "steps");
  const auto sum = static_cast<std::uint32_t>(crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
  std::string file = "SUNSTEP1";
  file.resize(file.size() + sizeof sum);
  std::memcpy(file.data() + 8, &sum, sizeof sum);
  static_cast<void>(write("steps/step_00007.bin", file.append(bytes)));
  read_or_refuse([] {
    const auto step = store().read(7);
    if (step) promise(step->light.bands.size() == 2 && step->light.organ_absorbed.size() == 4, "a step of this scene");
  });
}

void feed_step_settings(std::string_view bytes) {
  std::filesystem::create_directories(folder() / "steps");
  static_cast<void>(write("steps/settings.json", bytes));
  read_or_refuse([] { static_cast<void>(store().find()); });
}

}  // namespace sunfleck::fuzz
