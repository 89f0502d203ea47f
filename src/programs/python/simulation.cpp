#include "programs/python/simulation.h"

#include "base/error.h"
#include "base/units.h"
#include "programs/python/arrays.h"
#include "programs/python/long_work.h"
#include "programs/python/outcome.h"
#include "simulate/requests.h"
#include "simulate/simulation.h"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <atomic>
#include <map>
#include <memory>
#include <optional>
#include <string>

namespace sunfleck {
namespace {

namespace py = pybind11;

// A Simulation as Python uses it: one call at a time.
class PythonSimulation {
 public:
  PythonSimulation(const std::filesystem::path& file, const std::optional<std::string>& text,
                   std::map<std::string, Mesh> meshes, bool allow_outside, const std::string& device, int threads)
      : access_{.allow_outside = allow_outside} {
    const py::gil_scoped_release release;
    Scene scene = text ? read_scene(SceneText{file, *text, std::move(meshes)}, access_) : read_scene(file, access_);
    simulation_.emplace(std::move(scene), DeviceRequest{device_word(device), 0, threads});
  }

  void relight(const std::filesystem::path& file, const std::string& text) {
    // Other threads of the interpreter wait, since they may read the scene.
    const Turn turn(busy_);
    simulation_->relight(SceneText{file, text, {}}, access_);
  }

  std::unique_ptr<Outcome> run(const WorkRequest& request, const py::object& progress) {
    const Turn turn(busy_);
    std::optional<SimulatedScene> simulated;
    const auto work = [&](const Monitor& monitor) {
      check_grid(request, simulation_->scene());
      simulated = simulation_->run(solve_settings(request, simulation_->scene(), simulation_->threads()), {monitor});
    };
    do_long_work(work, progress);
    return std::make_unique<Outcome>(std::move(*simulated));
  }

  // Returns the text of the scene as it was read; empty after `relight`.
  [[nodiscard]] py::bytes scene_text() const { return simulation_->scene().text; }
  [[nodiscard]] std::vector<std::string> warnings() const { return simulation_->scene().warnings; }
  // Returns the names of the optics that the canopy uses.
  [[nodiscard]] std::vector<std::string> optics_names() const { return simulation_->scene().model.canopy.optics_names; }
  [[nodiscard]] std::size_t triangles() const { return simulation_->scene().model.canopy.size(); }
  [[nodiscard]] std::size_t tree_bytes() const { return simulation_->tree_bytes(); }
  [[nodiscard]] py::dict device() const {
    const TracerDevice device = simulation_->device();
    py::dict dict;
    dict["kind"] = device.kind;
    dict["name"] = device.name;
    dict["driver"] = device.driver;
    return dict;
  }
  // Returns the sun's position in degrees; None without a sun.
  [[nodiscard]] py::object sun() const {
    const auto& sun = simulation_->scene().model.sun;
    if (!sun) return py::none();
    return py::make_tuple(in_degrees(sun->elevation_rad), in_degrees(sun->azimuth_rad));
  }

 private:
  // Admits one call at a time, because the interpreter's other threads run while it traces.
  class Turn {
   public:
    explicit Turn(std::atomic<bool>& busy) : busy_(busy) {
      if (busy.exchange(true)) {
        throw_failure("Simulation", "already running in another thread; one call at a time",
                      "wait for it, or create one Simulation per thread");
      }
    }
    ~Turn() { busy_ = false; }
    Turn(const Turn&) = delete;
    Turn& operator=(const Turn&) = delete;

   private:
    std::atomic<bool>& busy_;
  };

  SceneAccess access_;
  std::optional<Simulation> simulation_;
  std::atomic<bool> busy_ = false;
};

// Builds the request that limits the work.
WorkRequest work_request(std::optional<double> direct_error, std::optional<double> indirect_error, std::optional<double> grid_m,
                         std::optional<int> passes, std::optional<double> max_seconds, std::optional<std::uint64_t> max_rays,
                         std::optional<std::uint64_t> memory_bytes, std::uint64_t seed, bool triangle_errors) {
  WorkRequest request;
  request.direct_error = direct_error;
  request.indirect_error = indirect_error;
  request.grid_m = grid_m;
  request.passes = passes;
  request.max_seconds = max_seconds;
  request.max_rays = max_rays;
  request.memory_bytes = memory_bytes;
  request.seed = seed;
  request.triangle_light = triangle_errors;
  return request;
}

}  // namespace

void bind_simulation(py::module_& module) {
  py::class_<Mesh>(module, "Mesh").def(py::init(&mesh_of));
  py::class_<WorkRequest>(module, "WorkRequest")
      .def(py::init(&work_request), py::kw_only(), py::arg("direct_error"), py::arg("indirect_error"), py::arg("grid"),
           py::arg("passes"), py::arg("max_seconds"), py::arg("max_rays"), py::arg("memory"), py::arg("seed"),
           py::arg("triangle_errors"));
  py::class_<PythonSimulation>(module, "Simulation")
      .def(py::init<const std::filesystem::path&, const std::optional<std::string>&, std::map<std::string, Mesh>, bool,
                    const std::string&, int>())
      .def("relight", &PythonSimulation::relight)
      .def("run", &PythonSimulation::run)
      .def_property_readonly("scene_text", &PythonSimulation::scene_text)
      .def_property_readonly("warnings", &PythonSimulation::warnings)
      .def_property_readonly("optics_names", &PythonSimulation::optics_names)
      .def_property_readonly("triangles", &PythonSimulation::triangles)
      .def_property_readonly("tree_bytes", &PythonSimulation::tree_bytes)
      .def_property_readonly("device", &PythonSimulation::device)
      .def_property_readonly("sun", &PythonSimulation::sun);
}

}  // namespace sunfleck
