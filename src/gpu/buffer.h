#pragma once
// Device buffers.

#include <cstddef>
#include <cstdint>
#include <span>

#include "gpu/context.h"

namespace sunfleck {

enum class BufferUse {
  storage,        // read and written by shaders
  uniform_texel,  // read-only, fetched as four 32-bit unsigned words a texel (usamplerBuffer)
};

// The format of every uniform_texel buffer: bits come through unchanged. On lavapipe (Mesa 22.3.6) random fetches of it take as
// long as those of R32G32B32A32_SFLOAT (within 4 %) and 0.4 times as long as those from a storage buffer.
constexpr vk::Format texel_format = vk::Format::eR32G32B32A32Uint;

// A device-local buffer with its memory; a texel buffer has its view too.
struct GpuBuffer {
  BufferUse use = BufferUse::storage;
  std::size_t bytes = 0;
  vk::raii::DeviceMemory memory{nullptr};
  vk::raii::Buffer buffer{nullptr};
  vk::raii::BufferView view{nullptr};
};

// `bytes` may be 0: the buffer then has room for one texel, so that it can be bound. Throws Error (failure) naming `what` when
// memory runs out, Error (device) when it is above the device's limit for this use. The contents are undefined.
[[nodiscard]] GpuBuffer create_buffer(const GpuContext& context, BufferUse use, std::size_t bytes, const char* what);

// Copies through the staging memory, in pieces; one fence a piece. offset + size <= bytes.
void upload(const GpuContext& context, const GpuBuffer& buffer, std::span<const std::byte> data, std::size_t offset = 0);
void download(const GpuContext& context, const GpuBuffer& buffer, std::span<std::byte> data, std::size_t offset = 0);

// Sets every 32-bit word of the buffer to `word`.
void fill(const GpuContext& context, const GpuBuffer& buffer, std::uint32_t word);

}  // namespace sunfleck
