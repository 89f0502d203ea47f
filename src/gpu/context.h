#pragma once
// Vulkan instance, device and queue; compute only. Not one word about what is computed.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>
#include <vulkan/vulkan_raii.hpp>

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

// Host-visible, coherent memory, mapped for good, through which all data travel to and from the device.
struct Staging {
  static constexpr std::size_t bytes = std::size_t{16} << 20;
  vk::raii::DeviceMemory memory{nullptr};
  vk::raii::Buffer buffer{nullptr};
  std::byte* data = nullptr;
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

  [[nodiscard]] const vk::raii::Device& device() const { return device_; }
  [[nodiscard]] const vk::raii::PhysicalDevice& physical_device() const { return physical_; }
  [[nodiscard]] const Staging& staging() const { return staging_; }

  // Memory of a type that has all `required` properties, and the `preferred` ones too if there is such a type. Vulkan-Hpp's
  // exceptions pass through.
  [[nodiscard]] vk::raii::DeviceMemory allocate(const vk::MemoryRequirements& needs, vk::MemoryPropertyFlags required,
                                                vk::MemoryPropertyFlags preferred) const;

  // The one command buffer, emptied and begun. What earlier submissions wrote is visible to the transfers and compute
  // shaders recorded here; barriers between commands of the same recording are the caller's. Throws Error (failure).
  [[nodiscard]] const vk::raii::CommandBuffer& begin_commands() const;
  // Ends that command buffer, submits it and waits; then its writes are visible to the host. Throws Error (failure) if the
  // device is lost.
  void submit_and_wait() const;

 private:
  void take_device(const DeviceWish& wish);
  void create_device();
  void create_staging();

  std::vector<std::string> messages_;
  vk::raii::Context loader_;
  vk::raii::Instance instance_{nullptr};
  vk::raii::DebugUtilsMessengerEXT messenger_{nullptr};
  vk::raii::PhysicalDevice physical_{nullptr};
  vk::raii::Device device_{nullptr};
  vk::raii::Queue queue_{nullptr};
  vk::raii::CommandPool pool_{nullptr};
  vk::raii::CommandBuffer commands_{nullptr};
  vk::raii::Fence fence_{nullptr};
  Staging staging_;
  DeviceDescription description_;
  DeviceLimits limits_;
};

// Every Vulkan call that fails after a device was chosen ends here: Error (failure) saying `what` was being done, on which
// device, and why.
[[noreturn]] void throw_call_failed(const GpuContext& context, const std::string& what, const vk::SystemError& error);

}  // namespace sunfleck
