#pragma once
// Device buffers.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <type_traits>
#include <vector>

#include "devices/gpu/context.h"

namespace sunfleck {

enum class BufferUse {
  storage,        // read and written by shaders
  uniform_texel,  // read-only, fetched as four 32-bit unsigned words per texel (usamplerBuffer)
};

// A device-local buffer with its memory.
struct GpuBuffer {
  struct Handles;  // devices/gpu/handles.h
  struct Destroy {
    void operator()(Handles* handles) const noexcept;
  };

  BufferUse use = BufferUse::storage;
  std::size_t bytes = 0;
  std::unique_ptr<Handles, Destroy> handles;  // null: the buffer does not exist yet
};

// Creates a buffer with undefined contents. `bytes` may be 0: the buffer then has room for one texel, so that it can be bound.
// Throws Error (failure) naming `what` if memory runs out, Error (device) if the size exceeds the device's limit for this use.
[[nodiscard]] GpuBuffer create_buffer(const GpuContext& context, BufferUse use, std::size_t bytes, const char* what);

// Creates a buffer with this content. Throws as create_buffer does.
[[nodiscard]] GpuBuffer create_filled_buffer(const GpuContext& context, BufferUse use, std::span<const std::byte> content,
                                             const char* what);

// Creates storage buffers in one piece of memory, which is freed with the last of them: devices take a tenth of a millisecond
// for each piece. Where a device gives no piece as large, each buffer has its own. Throws as create_buffer does.
[[nodiscard]] std::vector<GpuBuffer> create_storage_buffers(const GpuContext& context, std::span<const std::size_t> bytes,
                                                            const char* what);

// Do what Submission does with the same names, each in a submission of its own.
void upload(const GpuContext& context, const GpuBuffer& buffer, std::span<const std::byte> data, std::size_t offset = 0);
void download(const GpuContext& context, const GpuBuffer& buffer, std::span<std::byte> data, std::size_t offset = 0);

// Return an object as the bytes that are copied.
template <class T>
requires std::is_trivially_copyable_v<T>
[[nodiscard]] std::span<const std::byte> bytes_of(const T& object) {
  return std::as_bytes(std::span(&object, 1));
}
template <class T>
requires std::is_trivially_copyable_v<T>
[[nodiscard]] std::span<std::byte> writable_bytes_of(T& object) {
  return std::as_writable_bytes(std::span(&object, 1));
}

}  // namespace sunfleck
