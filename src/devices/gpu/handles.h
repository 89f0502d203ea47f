#pragma once
// Vulkan's handles behind contexts, buffers and pipelines. Only for the sources of gpu.

#include "devices/gpu/buffer.h"
#include "devices/gpu/compute.h"
#include "devices/gpu/context.h"

#include <cstddef>
#include <memory>
#include <string>
#include <vector>
#include <vulkan/vulkan_raii.hpp>

namespace sunfleck {

// Host-visible, coherent, permanently mapped memory through which all data travel to and from the device.
struct Staging {
  static constexpr std::size_t bytes = std::size_t{16} << 20;
  vk::raii::DeviceMemory memory{nullptr};
  vk::raii::Buffer buffer{nullptr};
  std::byte* data = nullptr;
};

// Members are destroyed in the reverse of this order.
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
  mutable DeviceTraffic traffic;
};

struct GpuBuffer::Handles {
  std::shared_ptr<vk::raii::DeviceMemory> memory;  // which several buffers may share
  vk::raii::Buffer buffer{nullptr};
  vk::raii::BufferView view{nullptr};  // of a texel buffer
};

struct ComputePipeline::Handles {
  // Buffers bound to the pipeline.
  struct Binding {
    vk::raii::DescriptorPool pool{nullptr};
    vk::raii::DescriptorSet set{nullptr};
  };
  vk::raii::DescriptorSetLayout set_layout{nullptr};
  vk::raii::PipelineLayout layout{nullptr};
  vk::raii::Pipeline pipeline{nullptr};
  std::vector<Binding> bindings;  // as many as a submission needed at most
};

// Allocates memory of a type that has all `required` properties, and the `preferred` ones too if such a type exists. Lets
// Vulkan-Hpp's exceptions pass through.
[[nodiscard]] vk::raii::DeviceMemory allocate(const GpuContext::Handles& context, const vk::MemoryRequirements& needs,
                                              vk::MemoryPropertyFlags required, vk::MemoryPropertyFlags preferred);

// Resets and begins the single command buffer. Writes of earlier submissions are visible to the transfers, compute shaders and
// numbers of groups recorded in it. Throws Error (failure).
void begin_commands(const GpuContext& context);
// Makes what the commands recorded so far write visible to those that follow.
void let_later_commands_see(const GpuContext& context);
// Forgets what was recorded since begin_commands().
void drop_commands(const GpuContext& context) noexcept;
// Ends that command buffer, submits it and waits; afterwards its writes are visible to the host. Throws Error (failure) if the
// device is lost.
void submit_and_wait(const GpuContext& context);

// Reports every Vulkan call that fails after a device was chosen. Throws Error (failure) that names the operation `what`, the
// device and the reason.
[[noreturn]] void throw_call_failed(const GpuContext& context, const std::string& what, const vk::SystemError& error);

}  // namespace sunfleck
