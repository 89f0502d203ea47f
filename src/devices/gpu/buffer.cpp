#include "devices/gpu/buffer.h"

#include "devices/gpu/handles.h"
#include "devices/gpu/submission.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "base/error.h"
#include "base/rounding.h"

namespace sunfleck {

namespace {

// The format of every uniform_texel buffer, which passes bits unchanged. On lavapipe (Mesa 22.3.6) random fetches of it take as
// long as those of R32G32B32A32_SFLOAT (within 4 %) and 0.4 times as long as those from a storage buffer.
constexpr vk::Format texel_format = vk::Format::eR32G32B32A32Uint;
constexpr std::size_t texel_bytes = 16;

std::string size_of(const char* what, std::size_t bytes) {
  return fmt::format("{}: {:.1f} MiB", what, static_cast<double>(bytes) / (1 << 20));
}

void check_limits(const GpuContext& context, BufferUse use, std::size_t bytes, const char* what) {
  const auto refuse = [&](const char* limit, std::uint64_t most, const char* unit) {
    throw_device(fmt::format("{} on {}", size_of(what, bytes), context.description().name),
                 fmt::format("its {} is {} {}", limit, most, unit), "make the scene smaller or use another device");
  };
  const DeviceLimits& limits = context.limits();
  if (use == BufferUse::storage && bytes > limits.max_storage_buffer_bytes) {
    refuse("maxStorageBufferRange", limits.max_storage_buffer_bytes, "bytes");
  }
  if (use == BufferUse::uniform_texel && bytes / texel_bytes > limits.max_texel_buffer_elements) {
    refuse("maxTexelBufferElements", limits.max_texel_buffer_elements, "texels of 16 bytes");
  }
  if (bytes > limits.max_allocation_bytes) refuse("maxMemoryAllocationSize", limits.max_allocation_bytes, "bytes");
}

// Returns a buffer without memory. Lets Vulkan-Hpp's exceptions pass through, as the next two do.
GpuBuffer without_memory(const GpuContext& context, BufferUse use, std::size_t bytes) {
  using Usage = vk::BufferUsageFlagBits;
  const auto own_usage = use == BufferUse::storage ? Usage::eStorageBuffer | Usage::eIndirectBuffer
                                                   : vk::BufferUsageFlags(Usage::eUniformTexelBuffer);
  GpuBuffer result{use, bytes, std::unique_ptr<GpuBuffer::Handles, GpuBuffer::Destroy>(new GpuBuffer::Handles)};
  const std::size_t room = std::max(bytes, texel_bytes);
  result.handles->buffer =
      context.handles().device.createBuffer({{}, room, own_usage | Usage::eTransferSrc | Usage::eTransferDst});
  return result;
}

std::shared_ptr<vk::raii::DeviceMemory> allocate_shared(const GpuContext& context, const vk::MemoryRequirements& needs) {
  return std::make_shared<vk::raii::DeviceMemory>(
      allocate(context.handles(), needs, vk::MemoryPropertyFlagBits::eDeviceLocal, {}));
}

void bind(GpuBuffer& buffer, const std::shared_ptr<vk::raii::DeviceMemory>& memory, std::size_t offset) {
  buffer.handles->memory = memory;
  buffer.handles->buffer.bindMemory(**memory, offset);
}

}  // namespace

void GpuBuffer::Destroy::operator()(Handles* destroyed) const noexcept {
  delete destroyed;
}

GpuBuffer create_buffer(const GpuContext& context, BufferUse use, std::size_t bytes, const char* what) {
  check_limits(context, use, bytes, what);
  try {
    GpuBuffer result = without_memory(context, use, bytes);
    const auto memory = allocate_shared(context, result.handles->buffer.getMemoryRequirements());
    bind(result, memory, 0);
    if (use == BufferUse::uniform_texel) {
      const vk::raii::Device& device = context.handles().device;
      result.handles->view = device.createBufferView({{}, *result.handles->buffer, texel_format, 0, VK_WHOLE_SIZE});
    }
    return result;
  } catch (const vk::SystemError& error) {
    throw_call_failed(context, size_of(what, bytes), error);
  }
}

GpuBuffer create_filled_buffer(const GpuContext& context, BufferUse use, std::span<const std::byte> content, const char* what) {
  GpuBuffer buffer = create_buffer(context, use, content.size(), what);
  upload(context, buffer, content);
  return buffer;
}

std::vector<GpuBuffer> create_storage_buffers(const GpuContext& context, std::span<const std::size_t> bytes, const char* what) {
  std::vector<GpuBuffer> all;
  std::vector<std::size_t> offsets;
  vk::MemoryRequirements together(0, 1, ~std::uint32_t{0});
  try {
    for (const std::size_t each : bytes) {
      check_limits(context, BufferUse::storage, each, what);
      all.push_back(without_memory(context, BufferUse::storage, each));
      const vk::MemoryRequirements own = all.back().handles->buffer.getMemoryRequirements();
      offsets.push_back(rounded_up(together.size, own.alignment));
      together.size = offsets.back() + own.size;
      together.alignment = std::max(together.alignment, own.alignment);
      together.memoryTypeBits &= own.memoryTypeBits;
    }
    const bool fits = together.size <= context.limits().max_allocation_bytes;
    std::shared_ptr<vk::raii::DeviceMemory> memory;
    if (fits && !all.empty()) memory = allocate_shared(context, together);
    for (std::size_t k = 0; k < all.size(); ++k) {
      const auto own = fits ? memory : allocate_shared(context, all[k].handles->buffer.getMemoryRequirements());
      bind(all[k], own, fits ? offsets[k] : 0);
    }
  } catch (const vk::SystemError& error) {
    throw_call_failed(context, size_of(what, together.size), error);
  }
  return all;
}

void upload(const GpuContext& context, const GpuBuffer& buffer, std::span<const std::byte> data, std::size_t offset) {
  Submission submission(context);
  submission.upload(buffer, data, offset);
  submission.finish();
}

void download(const GpuContext& context, const GpuBuffer& buffer, std::span<std::byte> data, std::size_t offset) {
  Submission submission(context);
  submission.download(buffer, data, offset);
  submission.finish();
}

}  // namespace sunfleck
