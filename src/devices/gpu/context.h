#pragma once
// Vulkan instance, device and queue, for compute only. Knows nothing about what is computed. Vulkan's own types are kept in
// devices/gpu/handles.h, because its headers take a compiler seconds to read.

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace sunfleck {

// A Vulkan device as listed by the loader.
struct DeviceDescription {
  std::string name;
  std::string driver;     // name and version
  bool software = false;  // runs on the CPU (lavapipe)
  std::string unusable;   // empty, or one line that names what the device lacks
};

// Thorough validation adds synchronisation validation and checks of out-of-bounds access inside the shaders; far slower.
enum class Validation { off, on, thorough };

// Which device to use: any, with real GPUs before software; or one given by its index in list_devices() or by part of its name,
// ignoring case ("lavapipe" is also understood: Mesa calls that device llvmpipe). Among several that fit, usable devices come
// first, then discrete before integrated before virtual ones.
struct DeviceSelector {
  enum class Kind { any, hardware, software, index, name } kind = Kind::any;
  int index = 0;
  std::string name;
  // Among equally good devices, selects the one this many places after the first, cyclically.
  int turn = 0;
};

struct DeviceLimits {
  std::uint64_t max_texel_buffer_elements = 0;
  std::uint64_t max_storage_buffer_bytes = 0;
  std::uint64_t max_allocation_bytes = 0;     // of one buffer of any use
  std::uint64_t max_groups_per_dispatch = 0;  // along x
  std::uint64_t heap_bytes = 0;               // largest device-local heap
  std::uint64_t max_storage_buffers = 0;      // that one shader reads or writes
  bool int64 = false;                         // shaders may use 64-bit integers
  bool int64_atomics = false;                 // and add to those in buffers atomically
};

// What a device was given so far: submissions, each with a fence, and bytes to and from its buffers.
struct DeviceTraffic {
  std::uint64_t submissions = 0, uploaded_bytes = 0, downloaded_bytes = 0;
};

// Sets the number of threads of software Vulkan; must precede the first context or list of devices. 0: all cores.
void set_software_threads(int threads);

// Returns the index of the smallest value present; among several equal ones the one at position `turn`, cyclically. None if no
// value is present.
[[nodiscard]] std::optional<std::size_t> smallest_in_turn(std::span<const std::optional<int>> values, int turn);

// Returns all devices of this machine; empty if there is no Vulkan at all. Never throws because a driver is missing.
[[nodiscard]] std::vector<DeviceDescription> list_devices();

// Returns true if the Khronos validation layer is installed.
[[nodiscard]] bool validation_installed();

// Owns instance, device, one compute queue, one command buffer and the staging memory. Only one thread may use it at a time.
class GpuContext {
 public:
  // Throws Error (device) if no device fits the request, or if the one that fits lacks a requirement; the message names the
  // limit. Throws Error (failure) if memory runs out or the device is lost meanwhile. Unless validation is off, every warning
  // or error of the validation layer is kept in validation_messages(); if the layer is not installed, that is an Error (device)
  // too.
  GpuContext(const DeviceSelector& selector, Validation validation);
  ~GpuContext();
  GpuContext(const GpuContext&) = delete;
  GpuContext& operator=(const GpuContext&) = delete;

  [[nodiscard]] const DeviceDescription& description() const { return description_; }
  [[nodiscard]] const DeviceLimits& limits() const { return limits_; }
  [[nodiscard]] const std::vector<std::string>& validation_messages() const { return messages_; }

  [[nodiscard]] const DeviceTraffic& traffic() const;

  // Vulkan's handles (devices/gpu/handles.h).
  struct Handles;
  [[nodiscard]] const Handles& handles() const { return *handles_; }

 private:
  void take_device(const DeviceSelector& selector);

  std::vector<std::string> messages_;
  std::unique_ptr<Handles> handles_;
  DeviceDescription description_;
  DeviceLimits limits_;
};

}  // namespace sunfleck
