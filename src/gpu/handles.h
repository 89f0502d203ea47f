#pragma once
// Contexts, buffers and pipelines as Vulkan knows them. For the sources of gpu alone.

#include "gpu/buffer.h"
#include "gpu/compute.h"
#include "gpu/context.h"

#include <cstddef>
#include <string>
#include <vulkan/vulkan_raii.hpp>

namespace sunfleck {

// Host-visible, coherent memory, mapped for good, through which all data travel to and from the device.
struct Staging {
  static constexpr std::size_t bytes = std::size_t{16} << 20;
  vk::raii::DeviceMemory memory{nullptr};
  vk::raii::Buffer buffer{nullptr};
  std::byte* data = nullptr;
};

// Members end in the reverse of this order.
struct GpuContext::Handles {
  vk::raii::Context loader;
  vk::raii::Instance instance{nullptr};
  vk::raii::DebugUtilsMessengerEXT messenger{nullptr};
  vk::raii::PhysicalDevice physical{nullptr};
  vk::raii::Device device{nullptr};
  vk::raii::Queue queue{nullptr};
  vk::raii::CommandPool pool{nullptr};
  vk::raii::CommandBuffer commands{nullptr};
  vk::raii::Fence fence{nullptr};
  Staging staging;
};

struct GpuBuffer::Handles {
  vk::raii::DeviceMemory memory{nullptr};
  vk::raii::Buffer buffer{nullptr};
  vk::raii::BufferView view{nullptr};  // of a texel buffer
};

struct ComputePipeline::Handles {
  vk::raii::DescriptorSetLayout set_layout{nullptr};
  vk::raii::PipelineLayout layout{nullptr};
  vk::raii::Pipeline pipeline{nullptr};
  vk::raii::DescriptorPool pool{nullptr};
  vk::raii::DescriptorSet set{nullptr};
};

// Memory of a type that has all `required` properties, and the `preferred` ones too if there is such a type. Vulkan-Hpp's
// exceptions pass through.
[[nodiscard]] vk::raii::DeviceMemory allocate(const GpuContext::Handles& context, const vk::MemoryRequirements& needs,
                                              vk::MemoryPropertyFlags required, vk::MemoryPropertyFlags preferred);

// The one command buffer, emptied and begun. What earlier submissions wrote is visible to the transfers and compute
// shaders recorded here; barriers between commands of the same recording are the caller's. Throws Error (failure).
[[nodiscard]] const vk::raii::CommandBuffer& begin_commands(const GpuContext& context);
// Ends that command buffer, submits it and waits; then its writes are visible to the host. Throws Error (failure) if the
// device is lost.
void submit_and_wait(const GpuContext& context);

// Every Vulkan call that fails after a device was chosen ends here: Error (failure) saying `what` was being done, on which
// device, and why.
[[noreturn]] void throw_call_failed(const GpuContext& context, const std::string& what, const vk::SystemError& error);

}  // namespace sunfleck
