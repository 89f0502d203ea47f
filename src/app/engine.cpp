#include "app/engine.h"

#include "base/error.h"
#include "base/log.h"
#include "tracers/vulkan_tracer.h"

#include <algorithm>
#include <charconv>
#include <utility>

namespace sunfleck {
namespace {

#ifdef NDEBUG
constexpr Validation validation = Validation::off;
#else
constexpr Validation validation = Validation::on;
#endif

DeviceWish wish_of(const std::string& device) {
  if (device == "auto") return {DeviceWish::Kind::any, 0, ""};
  if (device == "gpu") return {DeviceWish::Kind::hardware, 0, ""};
  if (device == "lavapipe") return {DeviceWish::Kind::software, 0, ""};
  int index = 0;
  const auto [end, error] = std::from_chars(device.data(), device.data() + device.size(), index);
  if (error == std::errc() && end == device.data() + device.size()) return {DeviceWish::Kind::index, index, ""};
  return {DeviceWish::Kind::name, 0, device};
}

bool any_usable_device() {
  const std::vector<DeviceDescription> devices = list_devices();
  return std::any_of(devices.begin(), devices.end(), [](const DeviceDescription& device) { return device.unusable.empty(); });
}

}  // namespace

std::unique_ptr<GpuContext> open_device(const std::string& device) {
  if (device == "cpu" || (device == "auto" && !any_usable_device())) return nullptr;
  return std::make_unique<GpuContext>(wish_of(device), validation);
}

Engine::Engine(const std::string& device, const Bvh& bvh, CpuTracer::Scene scene, std::size_t counter_words)
    : bvh_(bvh), context_(open_device(device)) {
  if (!context_) {
    tracer_ = std::make_unique<CpuTracer>(bvh, scene);
    return;
  }
  const TreeFetch fetch = preferred_fetch(*context_, bvh);
  if (fetch == TreeFetch::storage_buffers)
    say("the tree is too large for this device's texel buffers: storage buffers are used");
  tree_ = std::make_unique<GpuTree>(*context_, bvh, fetch);
  tracer_ = std::make_unique<VulkanTracer>(*context_, bvh, *tree_, scene, counter_words);
}

std::unique_ptr<CanopyViewer> Engine::viewer(CanopyLook look) const {
  return context_ ? view_with_gpu(*context_, *tree_, bvh_, std::move(look)) : view_with_cpu(bvh_, std::move(look));
}

std::vector<std::string> Engine::validation_messages() const {
  return context_ ? context_->validation_messages() : std::vector<std::string>();
}

}  // namespace sunfleck
