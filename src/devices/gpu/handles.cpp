#include "devices/gpu/handles.h"

#include "base/check.h"
#include "base/error.h"

#include <fmt/format.h>

#include <cstdint>
#include <limits>

namespace sunfleck {

vk::raii::DeviceMemory allocate(const GpuContext::Handles& context, const vk::MemoryRequirements& needs,
                                vk::MemoryPropertyFlags required, vk::MemoryPropertyFlags preferred) {
  const auto memory = context.physical.getMemoryProperties();
  for (const auto wanted : {required | preferred, required}) {
    for (std::uint32_t i = 0; i < memory.memoryTypeCount; ++i) {
      const bool allowed = (needs.memoryTypeBits >> i & 1u) != 0;
      if (allowed && (memory.memoryTypes[i].propertyFlags & wanted) == wanted) {
        return context.device.allocateMemory({needs.size, i});
      }
    }
  }
  throw vk::OutOfDeviceMemoryError("no memory type fits");
}

void begin_commands(const GpuContext& context) {
  try {
    context.handles().commands.begin({vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
  } catch (const vk::SystemError& error) {
    throw_call_failed(context, fmt::format("Vulkan device {}", context.description().name), error);
  }
  let_later_commands_see(context);
}

void let_later_commands_see(const GpuContext& context) {
  using Stage = vk::PipelineStageFlagBits;
  using Access = vk::AccessFlagBits;
  const vk::MemoryBarrier barrier(Access::eTransferWrite | Access::eShaderWrite,
                                  Access::eTransferRead | Access::eTransferWrite | Access::eShaderRead | Access::eShaderWrite |
                                      Access::eIndirectCommandRead);
  const auto stages = Stage::eTransfer | Stage::eComputeShader | Stage::eDrawIndirect;
  context.handles().commands.pipelineBarrier(stages, stages, {}, barrier, {}, {});
}

void drop_commands(const GpuContext& context) noexcept {
  try {
    context.handles().commands.reset();
  } catch (const vk::SystemError&) {  // out of memory; the next begin_commands() fails, too, and says so
  }
}

void submit_and_wait(const GpuContext& context) {
  using Stage = vk::PipelineStageFlagBits;
  using Access = vk::AccessFlagBits;
  const GpuContext::Handles& handles = context.handles();
  const vk::MemoryBarrier barrier(Access::eTransferWrite | Access::eShaderWrite, Access::eHostRead);
  handles.commands.pipelineBarrier(Stage::eTransfer | Stage::eComputeShader, Stage::eHost, {}, barrier, {}, {});
  try {
    handles.commands.end();
    const vk::CommandBuffer commands = *handles.commands;
    // Before the work, not after it: if a reset after the work failed, the next call, perhaps of another thread, would find a
    // fence that is already signalled, would not wait, and the memory that its work uses could be freed meanwhile.
    handles.device.resetFences(*handles.fence);
    handles.queue.submit(vk::SubmitInfo({}, {}, commands), *handles.fence);
    const auto result = handles.device.waitForFences(*handles.fence, VK_TRUE, std::numeric_limits<std::uint64_t>::max());
    ENSURE(static_cast<int>(result), ==, static_cast<int>(vk::Result::eSuccess));
  } catch (const vk::SystemError& error) {
    throw_call_failed(context, fmt::format("Vulkan device {}", context.description().name), error);
  }
}

void throw_call_failed(const GpuContext& context, const std::string& what, const vk::SystemError& error) {
  const auto is = [&](vk::Result result) { return error.code() == result; };
  const std::string on = what.find(context.description().name) == std::string::npos
                             ? fmt::format("{} on {}", what, context.description().name)
                             : what;
  if (is(vk::Result::eErrorOutOfDeviceMemory) || is(vk::Result::eErrorOutOfHostMemory)) {
    throw_failure(on, fmt::format("out of memory: {}", error.what()),
                  "make the scene smaller, or use another device or the CPU path (--device cpu)");
  }
  if (is(vk::Result::eErrorDeviceLost)) {
    throw_failure(on, fmt::format("the device was lost: {}", error.what()),
                  "run again; if it fails again, use another device or the CPU path (--device cpu)");
  }
  throw_failure(on, error.what(), "update the driver, or use another device or the CPU path (--device cpu)");
}

}  // namespace sunfleck
