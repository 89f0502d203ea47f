#include "devices/gpu/context.h"

#include "base/check.h"
#include "base/error.h"
#include "base/text.h"
#include "devices/gpu/handles.h"
#include "devices/gpu/instance.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <tuple>
#include <utility>

namespace sunfleck {

namespace {

struct FoundDevice {
  DeviceDescription description;
  vk::PhysicalDeviceType type;
};

std::optional<std::uint32_t> compute_family(const vk::raii::PhysicalDevice& physical) {
  const auto families = physical.getQueueFamilyProperties();
  for (std::uint32_t i = 0; i < families.size(); ++i) {
    if (families[i].queueFlags & vk::QueueFlagBits::eCompute) return i;
  }
  return std::nullopt;
}

// Returns what the device lacks; empty if nothing. Vulkan 1.0 guarantees the limits checked besides the feature and the version
// (table "Required Limits" of the specification), and the buffers and shaders of this program rely on them.
std::string find_lack(const vk::raii::PhysicalDevice& physical) {
  const auto properties = physical.getProperties();
  if (properties.apiVersion < api_version) {
    return fmt::format("it has Vulkan {}.{}, 1.2 is needed", VK_API_VERSION_MAJOR(properties.apiVersion),
                       VK_API_VERSION_MINOR(properties.apiVersion));
  }
  const auto features = physical.getFeatures2<vk::PhysicalDeviceFeatures2, vk::PhysicalDeviceVulkan12Features>();
  if (!features.get<vk::PhysicalDeviceVulkan12Features>().scalarBlockLayout) return "it lacks the feature scalarBlockLayout";
  if (!compute_family(physical)) return "it has no compute queue";
  const auto format = physical.getFormatProperties(vk::Format::eR32G32B32A32Uint);
  if (!(format.bufferFeatures & vk::FormatFeatureFlagBits::eUniformTexelBuffer)) {
    return "it lacks uniform texel buffers of format R32G32B32A32_UINT";
  }
  const auto& limits = properties.limits;
  const std::tuple<const char*, std::uint64_t, std::uint64_t> needs[] = {
      {"maxPushConstantsSize", limits.maxPushConstantsSize, 128},
      {"maxStorageBufferRange", limits.maxStorageBufferRange, 1u << 27},
      {"maxComputeWorkGroupInvocations", limits.maxComputeWorkGroupInvocations, 128},
      {"maxComputeWorkGroupSize[0]", limits.maxComputeWorkGroupSize[0], 128},
      {"maxComputeWorkGroupCount[0]", limits.maxComputeWorkGroupCount[0], 65535},
  };
  for (const auto& [name, value, least] : needs) {
    if (value < least) return fmt::format("its {} is {}, {} is needed", name, value, least);
  }
  return {};
}

FoundDevice describe(const vk::raii::PhysicalDevice& physical) {
  const auto properties = physical.getProperties();
  FoundDevice found;
  found.type = properties.deviceType;
  found.description.name = properties.deviceName.data();
  found.description.software = properties.deviceType == vk::PhysicalDeviceType::eCpu;
  found.description.unusable = find_lack(physical);
  if (properties.apiVersion >= api_version) {
    const auto chain = physical.getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceDriverProperties>();
    const auto& driver = chain.get<vk::PhysicalDeviceDriverProperties>();
    found.description.driver = fmt::format("{} {}", driver.driverName.data(), driver.driverInfo.data());
  }
  return found;
}

// Returns the devices in the loader's order; empty if its drivers find none.
std::vector<vk::raii::PhysicalDevice> enumerate(const vk::raii::Instance& instance) {
  try {
    return vk::raii::PhysicalDevices(instance);
  } catch (const vk::SystemError&) {
    return {};
  }
}

bool fits(const DeviceSelector& selector, const DeviceDescription& description, std::size_t index) {
  switch (selector.kind) {
    case DeviceSelector::Kind::any:
      return true;
    case DeviceSelector::Kind::hardware:
      return !description.software;
    case DeviceSelector::Kind::software:
      return description.software;
    case DeviceSelector::Kind::index:
      return selector.index >= 0 && static_cast<std::size_t>(selector.index) == index;
    case DeviceSelector::Kind::name:
      break;
  }
  std::string name = lower_case(description.name);
  if (name.find("llvmpipe") != std::string::npos) name += " lavapipe";
  return name.find(lower_case(selector.name)) != std::string::npos;
}

std::string selector_text(const DeviceSelector& selector) {
  switch (selector.kind) {
    case DeviceSelector::Kind::any:
      return "Vulkan device";
    case DeviceSelector::Kind::hardware:
      return "hardware Vulkan device";
    case DeviceSelector::Kind::software:
      return "software Vulkan device";
    case DeviceSelector::Kind::index:
      return fmt::format("Vulkan device {}", selector.index);
    case DeviceSelector::Kind::name:
      break;
  }
  return fmt::format("Vulkan device \"{}\"", selector.name);
}

// Returns the rank of a device, smaller is better: usable devices first, then by kind.
int preference(const FoundDevice& found) {
  const int unusable = found.description.unusable.empty() ? 0 : 10;
  switch (found.type) {
    case vk::PhysicalDeviceType::eDiscreteGpu:
      return unusable;
    case vk::PhysicalDeviceType::eIntegratedGpu:
      return unusable + 1;
    case vk::PhysicalDeviceType::eVirtualGpu:
      return unusable + 2;
    case vk::PhysicalDeviceType::eOther:
      return unusable + 3;
    case vk::PhysicalDeviceType::eCpu:
      break;
  }
  return unusable + 4;
}

// Returns the index of the best device that fits the request.
std::size_t choose(const DeviceSelector& selector, const std::vector<FoundDevice>& all) {
  std::vector<std::optional<int>> preferences(all.size());
  std::string names;
  for (std::size_t i = 0; i < all.size(); ++i) {
    names += fmt::format("{}{}: {}", i == 0 ? "" : ", ", i, all[i].description.name);
    if (fits(selector, all[i].description, i)) preferences[i] = preference(all[i]);
  }
  const std::optional<std::size_t> best = smallest_in_turn(preferences, selector.turn);
  if (all.empty()) throw_device(selector_text(selector), "this machine has no Vulkan device", no_vulkan_cure);
  if (!best) {
    throw_device(selector_text(selector), fmt::format("this machine has only {}", names),
                 "choose one of these or use the CPU path");
  }
  const DeviceDescription& chosen = all[*best].description;
  if (!chosen.unusable.empty()) {
    throw_device(fmt::format("Vulkan device {}: {}", *best, chosen.name), chosen.unusable,
                 fmt::format("choose another of {} or use the CPU path", names));
  }
  return *best;
}

DeviceLimits read_limits(const vk::raii::PhysicalDevice& physical) {
  const auto chain = physical.getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceMaintenance3Properties>();
  const auto& core = chain.get<vk::PhysicalDeviceProperties2>().properties.limits;
  DeviceLimits limits;
  limits.max_texel_buffer_elements = core.maxTexelBufferElements;
  limits.max_storage_buffer_bytes = core.maxStorageBufferRange;
  limits.max_allocation_bytes = chain.get<vk::PhysicalDeviceMaintenance3Properties>().maxMemoryAllocationSize;
  limits.max_groups_per_dispatch = core.maxComputeWorkGroupCount[0];
  limits.max_storage_buffers = std::min(core.maxPerStageDescriptorStorageBuffers, core.maxDescriptorSetStorageBuffers);
  const auto features = physical.getFeatures2<vk::PhysicalDeviceFeatures2, vk::PhysicalDeviceVulkan12Features>();
  limits.int64 = features.get<vk::PhysicalDeviceFeatures2>().features.shaderInt64 == VK_TRUE;
  limits.int64_atomics = features.get<vk::PhysicalDeviceVulkan12Features>().shaderBufferInt64Atomics == VK_TRUE;
  const auto memory = physical.getMemoryProperties();
  for (std::uint32_t i = 0; i < memory.memoryHeapCount; ++i) {
    const auto& heap = memory.memoryHeaps[i];
    if (heap.flags & vk::MemoryHeapFlagBits::eDeviceLocal)
      limits.heap_bytes = std::max<std::uint64_t>(limits.heap_bytes, heap.size);
  }
  return limits;
}

void create_device(GpuContext::Handles& handles, const DeviceLimits& limits) {
  const std::uint32_t family = compute_family(handles.physical).value();
  const float priority = 1.0f;
  const vk::DeviceQueueCreateInfo queue({}, family, 1, &priority);
  std::vector<const char*> extensions;
  if (has_extension(handles.physical.enumerateDeviceExtensionProperties(), portability_subset))
    extensions.push_back(portability_subset);
  vk::PhysicalDeviceVulkan12Features features;
  features.scalarBlockLayout = VK_TRUE;
  features.shaderBufferInt64Atomics = limits.int64_atomics ? VK_TRUE : VK_FALSE;
  vk::PhysicalDeviceFeatures core_features;
  core_features.shaderInt64 = limits.int64 ? VK_TRUE : VK_FALSE;
  handles.device =
      vk::raii::Device(handles.physical, vk::DeviceCreateInfo({}, queue, {}, extensions, &core_features, &features));
  handles.queue = handles.device.getQueue(family, 0);
  handles.pool = handles.device.createCommandPool({vk::CommandPoolCreateFlagBits::eResetCommandBuffer, family});
  auto commands = handles.device.allocateCommandBuffers({*handles.pool, vk::CommandBufferLevel::ePrimary, 1});
  handles.commands = std::move(commands.front());
  handles.fence = handles.device.createFence({});
}

void create_staging(GpuContext::Handles& handles) {
  using Usage = vk::BufferUsageFlagBits;
  using Property = vk::MemoryPropertyFlagBits;
  auto& [memory, buffer, data] = handles.staging;
  buffer = handles.device.createBuffer({{}, Staging::bytes, Usage::eTransferSrc | Usage::eTransferDst});
  memory = allocate(handles, buffer.getMemoryRequirements(), Property::eHostVisible | Property::eHostCoherent,
                    Property::eHostCached);  // uncached memory is very slow to read
  buffer.bindMemory(*memory, 0);
  data = static_cast<std::byte*>(memory.mapMemory(0, VK_WHOLE_SIZE));
}

}  // namespace

void set_software_threads(int threads) {
  EXPECT(threads, >=, 0);
  if (threads == 0) {
    unsetenv("LP_NUM_THREADS");
  } else {
    setenv("LP_NUM_THREADS", std::to_string(threads).c_str(), 1);
  }
}

std::vector<DeviceDescription> list_devices() {
  std::vector<DeviceDescription> descriptions;
  try {
    const vk::raii::Context loader = open_loader();
    const vk::raii::Instance instance = create_instance(loader, Validation::off, {});
    for (const auto& physical : enumerate(instance)) descriptions.push_back(describe(physical).description);
  } catch (const Error&) {            // no loader
  } catch (const vk::SystemError&) {  // no driver
  }
  return descriptions;
}

bool validation_installed() {
  try {
    return has_layer(open_loader(), validation_layer_name);
  } catch (const Error&) {
    return false;
  }
}

std::optional<std::size_t> smallest_in_turn(std::span<const std::optional<int>> values, int turn) {
  std::vector<std::size_t> smallest;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!values[i] || (!smallest.empty() && *values[i] > *values[smallest.front()])) continue;
    if (!smallest.empty() && *values[i] < *values[smallest.front()]) smallest.clear();
    smallest.push_back(i);
  }
  if (smallest.empty()) return std::nullopt;
  return smallest[static_cast<std::size_t>(turn) % smallest.size()];
}

GpuContext::GpuContext(const DeviceSelector& selector, Validation validation) : handles_(new Handles{open_loader()}) {
  try {
    handles_->instance = create_instance(handles_->loader, validation, {});
  } catch (const vk::SystemError& error) {
    throw_device(selector_text(selector), fmt::format("no driver answers: {}", error.what()), no_vulkan_cure);
  }
  if (validation != Validation::off) handles_->messenger = create_messenger(handles_->instance, messages_);
  take_device(selector);
  try {
    create_device(*handles_, limits_);
    create_staging(*handles_);
  } catch (const vk::SystemError& error) {
    throw_call_failed(*this, fmt::format("Vulkan device {}", description_.name), error);
  }
}

GpuContext::~GpuContext() = default;

const DeviceTraffic& GpuContext::traffic() const {
  return handles_->traffic;
}

void GpuContext::take_device(const DeviceSelector& selector) {
  auto physicals = enumerate(handles_->instance);
  std::vector<FoundDevice> all;
  for (const auto& physical : physicals) all.push_back(describe(physical));
  const std::size_t chosen = choose(selector, all);
  handles_->physical = std::move(physicals[chosen]);
  description_ = all[chosen].description;
  limits_ = read_limits(handles_->physical);
}

}  // namespace sunfleck
