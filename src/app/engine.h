#pragma once
// The device a run works on: tree and tracer, on Vulkan or on the CPU.

#include "bvh/bvh.h"
#include "gpu/context.h"
#include "tracers/canopy_view.h"
#include "tracers/cpu_tracer.h"
#include "tracers/gpu_tree.h"
#include "transport/tracer.h"

#include <memory>
#include <string>
#include <vector>

namespace sunfleck {

// The Vulkan device of that name on the command line (auto | gpu | lavapipe | cpu | INDEX | NAME); none stands for the CPU
// path. Throws Error (device) if there is none such.
[[nodiscard]] std::unique_ptr<GpuContext> open_device(const std::string& device);

class Engine {
 public:
  // `device` as in open_device. Tree and engine live together: the tree must outlive it.
  Engine(const std::string& device, const Bvh& bvh, CpuTracer::Scene scene, std::size_t counter_words);

  [[nodiscard]] Tracer& tracer() { return *tracer_; }
  [[nodiscard]] TracerDevice device() const { return tracer_->device(); }
  // The engine must outlive it.
  [[nodiscard]] std::unique_ptr<CanopyViewer> viewer(CanopyLook look) const;
  // What the validation layer had to say; only builds with checks have it look.
  [[nodiscard]] std::vector<std::string> validation_messages() const;

 private:
  const Bvh& bvh_;
  std::unique_ptr<GpuContext> context_;  // none on the CPU path
  std::unique_ptr<GpuTree> tree_;
  std::unique_ptr<Tracer> tracer_;
};

}  // namespace sunfleck
