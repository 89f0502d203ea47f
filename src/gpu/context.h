#pragma once
// Vulkan instance, device and queue; compute only. Not one word about what is computed, and none of Vulkan itself: that
// stands in gpu/handles.h, for it takes a compiler seconds to read.

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace sunfleck {

// A Vulkan device as the loader lists it.
struct DeviceDescription {
  std::string name;
  std::string driver;     // name and version
  bool software = false;  // runs on the CPU (lavapipe)
  std::string unusable;   // empty, or one line that names what it lacks
};

// Thorough adds synchronisation validation and checks inside the shaders (reads and writes out of bounds); far slower.
enum class Validation { off, on, thorough };

// Which device to take: any real GPU before software; or by number in list_devices() or a part of its name in any case
// ("lavapipe" is understood too: Mesa calls that device llvmpipe). Of several that fit, usable ones come first, then discrete
// before integrated before virtual ones.
struct DeviceWish {
  enum class Kind { any, hardware, software, index, name } kind = Kind::any;
  int index = 0;
  std::string name;
  int turn = 0;  // of several that are as good as each other the one that is so many places behind the first, counted round
};

struct DeviceLimits {
  std::uint64_t max_texel_buffer_elements = 0;
  std::uint64_t max_storage_buffer_bytes = 0;
  std::uint64_t max_allocation_bytes = 0;     // of one buffer of any use
  std::uint64_t max_groups_per_dispatch = 0;  // along x
  std::uint64_t heap_bytes = 0;               // largest device-local heap
};

// Threads of software Vulkan; must come before the first context or list of devices. 0: as many as there are cores.
void set_software_threads(int threads);

// The place of the smallest of the values that are there; of several equal ones the one whose turn it is. None if none is
// there.
[[nodiscard]] std::optional<std::size_t> smallest_in_turn(std::span<const std::optional<int>> values, int turn);

// All devices of this machine; empty where there is no Vulkan at all. Never throws for lack of a driver.
[[nodiscard]] std::vector<DeviceDescription> list_devices();

// Is the Khronos validation layer installed?
[[nodiscard]] bool validation_installed();

// Owns instance, device, one compute queue, one command buffer and the staging memory. Used by one thread at a time.
class GpuContext {
 public:
  // Throws Error (device) if no device fits the wish, or the one that fits lacks what is needed; the line names the limit.
  // Throws Error (failure) if memory runs out or the device is lost meanwhile.
  // Unless validation is off every warning or error of the validation layer is kept in validation_messages(); if the layer is
  // not installed that is an Error (device) too.
  GpuContext(const DeviceWish& wish, Validation validation);
  ~GpuContext();
  GpuContext(const GpuContext&) = delete;
  GpuContext& operator=(const GpuContext&) = delete;

  [[nodiscard]] const DeviceDescription& description() const { return description_; }
  [[nodiscard]] const DeviceLimits& limits() const { return limits_; }
  [[nodiscard]] const std::vector<std::string>& validation_messages() const { return messages_; }

  // What Vulkan knows it by (gpu/handles.h).
  struct Handles;
  [[nodiscard]] const Handles& handles() const { return *handles_; }

 private:
  void take_device(const DeviceWish& wish);

  std::vector<std::string> messages_;
  std::unique_ptr<Handles> handles_;
  DeviceDescription description_;
  DeviceLimits limits_;
};

}  // namespace sunfleck
