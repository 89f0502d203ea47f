#pragma once
// Opens the Vulkan loader and instance, for computing as well as for the window.

#include "devices/gpu/context.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>
#include <vulkan/vulkan_raii.hpp>

namespace sunfleck {

inline constexpr std::uint32_t api_version = VK_API_VERSION_1_2;
inline constexpr const char* validation_layer_name = "VK_LAYER_KHRONOS_validation";
// A device that only translates Vulkan to another API has this extension, and requires that it is enabled.
inline constexpr const char* portability_subset = "VK_KHR_portability_subset";
inline constexpr const char* no_vulkan_cure = "install a Vulkan driver (Debian: mesa-vulkan-drivers) or use the CPU path";

// Opens the loader. Throws Error (device) if none is installed.
[[nodiscard]] vk::raii::Context open_loader();

[[nodiscard]] bool has_layer(const vk::raii::Context& loader, std::string_view name);
[[nodiscard]] bool has_extension(const std::vector<vk::ExtensionProperties>& extensions, std::string_view name);

// Creates an instance with these extensions and those that validation needs. Throws Error (device) if the validation layer is
// requested but not installed. Lets Vulkan-Hpp's exceptions pass through.
[[nodiscard]] vk::raii::Instance create_instance(const vk::raii::Context& loader, Validation validation,
                                                 std::vector<const char*> extensions);

// Keeps every warning and error of the validation layer, as one line each. `messages` must not move.
[[nodiscard]] vk::raii::DebugUtilsMessengerEXT create_messenger(const vk::raii::Instance& instance,
                                                                std::vector<std::string>& messages);

}  // namespace sunfleck
