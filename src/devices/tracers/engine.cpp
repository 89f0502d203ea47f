#include "devices/tracers/engine.h"

#include "base/log.h"
#include "devices/tracers/cpu_tracer.h"
#include "devices/tracers/vulkan_tracer.h"

#include <algorithm>
#include <charconv>
#include <utility>

namespace sunfleck {
namespace {

// Long enough that its overhead is small, short enough that a hand on the mouse does not notice.
constexpr double dispatch_while_drawing_s = 0.02;

DeviceSelector selector_of(const DeviceChoice& device) {
  const std::string& name = device.name;
  if (name == "auto" || name == "gpu") return {DeviceSelector::Kind::hardware, 0, "", device.turn};
  if (name == "lavapipe") return {DeviceSelector::Kind::software, 0, ""};
  int index = 0;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), index);
  if (error == std::errc() && end == name.data() + name.size()) return {DeviceSelector::Kind::index, index, ""};
  return {DeviceSelector::Kind::name, 0, name, device.turn};
}

// Software Vulkan does not count: the CPU path is faster on the same cores.
bool any_usable_gpu() {
  const std::vector<DeviceDescription> devices = list_devices();
  return std::any_of(devices.begin(), devices.end(),
                     [](const DeviceDescription& device) { return !device.software && device.unusable.empty(); });
}

}  // namespace

std::unique_ptr<GpuContext> open_device(const DeviceChoice& device) {
  if (device.name == "cpu" || (device.name == "auto" && !any_usable_gpu())) return nullptr;
  return std::make_unique<GpuContext>(selector_of(device), build_validation);
}

Engine::Engine(const DeviceChoice& device, const Bvh& bvh, TraceDomain domain, std::size_t counter_words, EngineUse use)
    : bvh_(bvh), context_(open_device(device)) {
  const double seconds = use == EngineUse::shared_with_window ? dispatch_while_drawing_s : 0.0;
  if (context_) {
    open_vulkan(domain, counter_words, seconds);
  } else {
    tracer_ = std::make_unique<CpuTracer>(bvh, domain, CpuWalk::tree, seconds);
  }
  if (use == EngineUse::one_thread) return;
  turn_ = std::make_unique<DeviceTurn>();
  in_turns_ = std::make_unique<TurnTakingTracer>(*tracer_, *turn_);
}

void Engine::open_vulkan(TraceDomain domain, std::size_t counter_words, double seconds_per_dispatch) {
  const BufferUse use = preferred_use(*context_, bvh_);
  if (use == BufferUse::storage) say("the tree is too large for this device's texel buffers: storage buffers are used");
  tree_ = std::make_unique<GpuTree>(*context_, bvh_, use);
  VulkanChoices choices;
  choices.seconds_per_dispatch = seconds_per_dispatch;
  tracer_ = std::make_unique<VulkanTracer>(*context_, bvh_, *tree_, domain, counter_words, choices);
}

std::unique_ptr<CanopyViewer> Engine::viewer(CanopyLook look) const {
  const auto make = [&] {
    return context_ ? view_with_gpu(*context_, *tree_, bvh_, std::move(look)) : view_with_cpu(bvh_, std::move(look));
  };
  if (!turn_) return make();
  std::unique_ptr<CanopyViewer> viewer;
  {
    const DrawingTurn turn(*turn_);
    viewer = make();
  }
  return std::make_unique<TurnTakingViewer>(std::move(viewer), *turn_);
}

std::vector<std::string> Engine::validation_messages() const {
  return context_ ? context_->validation_messages() : std::vector<std::string>();
}

}  // namespace sunfleck
