#pragma once
// Our own tracers over a stand.

#include "bench/stand.h"
#include "gpu/context.h"
#include "tracers/gpu_tree.h"
#include "transport/tracer.h"

#include <memory>
#include <optional>

namespace sunfleck::bench {

// The CPU path, or the Vulkan path on a device.
class Ours {
 public:
  explicit Ours(const Stand& stand, const GpuContext* context = nullptr);
  Ours(const Stand& stand, const Bvh& bvh, const GpuContext* context);

  [[nodiscard]] Tracer& tracer() { return *tracer_; }

 private:
  std::optional<GpuTree> tree_;
  std::unique_ptr<Tracer> tracer_;
};

}  // namespace sunfleck::bench
