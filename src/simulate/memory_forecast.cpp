#include "simulate/memory_forecast.h"

#include "base/threads.h"
#include "physics/bvh/references.h"
#include "physics/transport/indirect/place_sums.h"
#include "physics/transport/model/surfaces.h"
#include "physics/transport/solve/work_planner.h"
#include "pictures/charts/fields.h"
#include "pictures/charts/pictures.h"

#include <algorithm>
#include <vector>

namespace sunfleck {
namespace {

constexpr double mib = 1048576.0;
// Replicates that take turns at a device seldom reach their peaks at the same time; those of the CPU path, which begin
// together, do.
constexpr double at_their_peak_on_device = 0.7;
// What the program takes from the system for a byte of its arrays: an allocator rounds up, and keeps some of what is freed.
constexpr double memory_per_byte = 1.2;

// Returns the memory of the program and its libraries; on Vulkan it includes the driver and its compiled shaders.
double program_bytes(const TracerDevice& device) {
  return (device.kind == "cpu" ? 22.0 : 116.0) * mib;
}

double canopy_bytes(const RadiationModel& model) {
  const ElementCorners& corners = model.canopy.corners;
  std::size_t triangles = corners.own().size();
  for (const SharedMesh& mesh : corners.meshes()) triangles += mesh.corners.size();
  return static_cast<double>(triangles * sizeof(Triangle) +
                             model.canopy.size() * (sizeof(std::uint32_t) + sizeof(std::uint16_t)));
}

// The memory of the sums over replicates.
struct SumBytes {
  double tracing = 0.0;   // those of the run, and of its pilot until the run has two replicates
  double ending = 0.0;    // those of the run, and the result made from them
  double result = 0.0;    // the result alone
  double refining = 0.0;  // estimating the light of triangles at the end
};

// Covers the trees of surfaces, and pooling over all of them at the same time.
constexpr double bytes_refining_element = 400.0;

// Returns the memory of one set of sums over all cells of the receivers.
double plane_bytes(const RadiationModel& model) {
  std::size_t cells = 0;
  for (const PlaneReceiver& plane : model.planes) cells += plane.cells();
  return static_cast<double>(cells * (2 + model.bands.size()) * sizeof(std::int64_t));
}

SumBytes sum_bytes(const RadiationModel& model, const CounterLayout& layout, ElementErrors element_errors,
                   const RunForecast& run) {
  const auto elements = static_cast<double>(model.canopy.size());
  const auto bands = static_cast<double>(model.bands.size());
  const double numbering = elements * 2.0 * sizeof(std::uint32_t);  // surfaces and layers
  const double exposure = elements * sizeof(float);
  const double landings = elements * sizeof(BeamLandings) + layout.cells() * sizeof(std::uint64_t);
  double sides = 0.0, cells = 0.0;
  if (scatters(model) || model.has_sky()) {
    const double kinds = bands * (model.has_sky() ? 2.0 : 1.0);
    sides = 2.0 * elements * kinds * sizeof(std::int64_t);
    cells = layout.cells() * kinds * sizeof(std::int64_t);
  }
  const PlaceBytes of_run = PlaceSums::likely_bytes(run.place_bytes.times(planned_replicates), {sides, cells});
  const PlaceBytes of_pilot = PlaceSums::likely_bytes(run.place_bytes.times(pilot_replicates), {sides, cells});
  double spreads = 0.0;
  SumBytes bytes;
  if (refines(element_errors)) {
    bytes.refining = elements * bytes_refining_element + 3.0 * sides;
    spreads = 2.0 * (landings + of_run.sides);
  }
  if (keeps_spreads(element_errors)) {
    spreads += 2.0 * elements * (16.0 + 32.0 * bands);
  }
  const double planes = plane_bytes(model);
  bytes.tracing = numbering + 2.0 * (exposure + landings + planes) + of_run.all() + of_pilot.all() + spreads;
  bytes.ending = numbering + exposure + landings + cells + sides + 2.0 * planes + spreads + bytes.refining;
  if (of_run.sides < sides) bytes.ending += of_run.sides;
  if (of_run.cells < cells) bytes.ending += of_run.cells;
  bytes.result = elements * sizeof(std::uint32_t) + landings + cells + sides + planes + 0.5 * spreads;
  return bytes;
}

// Returns the memory for drawing the pictures that a run draws unless others are asked for, together.
double picture_bytes(const RadiationModel& model, const CounterLayout& layout, const TracerDevice& device) {
  const std::vector<Picture> usual = usual_pictures(model.has_beam(), has_field(model, LightField::indirect));
  return drawing_bytes(layout, model, PictureOptions{}, usual.size(), device);
}

}  // namespace

std::optional<MemoryForecast> forecast_memory(Simulation& simulation, const SolveSettings& settings,
                                              ElementErrors without_pictures, const Monitor& monitor) {
  // Bytes of one tree reference while the tree is built, in addition to its place in the finished tree.
  constexpr double building = 40.0 + sizeof(Reference);
  // Bytes of one element packed for the store in the result folder: 19 to 34 in the scenes measured.
  constexpr double stored = 30.0;
  const RadiationModel& model = simulation.model();
  const SceneTree& tree = simulation.tracing().tree;
  Engine& engine = simulation.tracing().engine;
  const CpuThreads limit(simulation.threads());
  const std::optional<RunForecast> run = forecast(model, tree.layout, engine.tracer(), settings, monitor);
  if (!run) return std::nullopt;
  const auto elements = static_cast<double>(model.canopy.size());
  const bool on_cpu = engine.device().kind == "cpu";
  const double at_their_peak = on_cpu ? 1.0 : at_their_peak_on_device;
  const double in_the_making = 1.0 + at_their_peak * (static_cast<double>(run->at_once) - 1.0);
  const auto tree_bytes = static_cast<double>(simulation.tree_bytes());
  const double on_device = on_cpu ? 0.0 : tree_bytes + 4.0 * tree.layout.words();
  const double on_host = canopy_bytes(model) + tree_bytes;
  const double while_building = on_host + static_cast<double>(tree.bvh.triangles.size()) * building;
  const auto computing = [&](const SumBytes& sums) {
    return std::max({sums.tracing + in_the_making * run->replicate_bytes, sums.ending, sums.result + elements * stored});
  };
  const SumBytes drawn = sum_bytes(model, tree.layout, settings.element_errors, *run);
  const SumBytes plain = sum_bytes(model, tree.layout, without_pictures, *run);
  const double drawing = drawn.result + picture_bytes(model, tree.layout, engine.device());
  const auto whole = [&](double at_most) {
    const double while_running = memory_per_byte * (on_host + at_most) + on_device;  // a driver takes what it is asked for
    return static_cast<std::uint64_t>(program_bytes(engine.device()) +
                                      std::max(memory_per_byte * while_building, while_running));
  };
  return MemoryForecast{whole(std::max(computing(drawn), drawing)), whole(computing(plain)), *run};
}

}  // namespace sunfleck
