#include "devices/gpu/buffer.h"

#include "devices/gpu/handles.h"
#include "devices/gpu/submission.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/check.h"
#include "base/error.h"

namespace sunfleck {

namespace {

// The format of every uniform_texel buffer, which passes bits unchanged. On lavapipe (Mesa 22.3.6) random fetches of it take as
// long as those of R32G32B32A32_SFLOAT (within 4 %) and 0.4 times as long as those from a storage buffer.
constexpr vk::Format texel_format = vk::Format::eR32G32B32A32Uint;
constexpr std::size_t texel_bytes = 16;

void check_limits(const GpuContext& context, BufferUse use, std::size_t bytes, const char* what) {
  const auto refuse = [&](const char* limit, std::uint64_t most, const char* unit) {
    throw_device(fmt::format("{}: {:.1f} MiB on {}", what, static_cast<double>(bytes) / (1 << 20), context.description().name),
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

}  // namespace

void GpuBuffer::Destroy::operator()(Handles* handles) const noexcept {
  delete handles;
}

GpuBuffer create_buffer(const GpuContext& context, BufferUse use, std::size_t bytes, const char* what) {
  using Usage = vk::BufferUsageFlagBits;
  check_limits(context, use, bytes, what);
  const auto own_usage = use == BufferUse::storage ? Usage::eStorageBuffer | Usage::eIndirectBuffer
                                                   : vk::BufferUsageFlags(Usage::eUniformTexelBuffer);
  GpuBuffer result{use, bytes, std::unique_ptr<GpuBuffer::Handles, GpuBuffer::Destroy>(new GpuBuffer::Handles)};
  try {
    const vk::raii::Device& device = context.handles().device;
    auto& [memory, buffer, view] = *result.handles;
    const std::size_t room = std::max(bytes, texel_bytes);
    buffer = device.createBuffer({{}, room, own_usage | Usage::eTransferSrc | Usage::eTransferDst});
    memory = allocate(context.handles(), buffer.getMemoryRequirements(), vk::MemoryPropertyFlagBits::eDeviceLocal, {});
    buffer.bindMemory(*memory, 0);
    if (use == BufferUse::uniform_texel) view = device.createBufferView({{}, *buffer, texel_format, 0, VK_WHOLE_SIZE});
  } catch (const vk::SystemError& error) {
    throw_call_failed(context, fmt::format("{}: {:.1f} MiB", what, static_cast<double>(bytes) / (1 << 20)), error);
  }
  return result;
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

void fill(const GpuContext& context, const GpuBuffer& buffer, std::uint32_t word) {
  Submission submission(context);
  submission.fill(buffer, word);
  submission.finish();
}

}  // namespace sunfleck
