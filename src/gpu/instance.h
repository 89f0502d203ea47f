#pragma once
// Loader and instance of Vulkan, as both those who compute and the window open them.

#include "gpu/context.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>
#include <vulkan/vulkan_raii.hpp>

namespace sunfleck {

inline constexpr std::uint32_t api_version = VK_API_VERSION_1_2;
inline constexpr const char* validation_layer_name = "VK_LAYER_KHRONOS_validation";
inline constexpr const char* no_vulkan_cure = "install a Vulkan driver (Debian: mesa-vulkan-drivers) or use the CPU path";

// Throws Error (device) where no loader is installed.
[[nodiscard]] vk::raii::Context open_loader();

[[nodiscard]] bool has_layer(const vk::raii::Context& loader, std::string_view name);
[[nodiscard]] bool has_extension(const std::vector<vk::ExtensionProperties>& extensions, std::string_view name);

// With these extensions and what validation needs. Throws Error (device) if the validation layer is wanted and not installed;
// Vulkan-Hpp's exceptions pass through.
[[nodiscard]] vk::raii::Instance create_instance(const vk::raii::Context& loader, Validation validation,
                                                 std::vector<const char*> extensions);

// Keeps every warning and error of the validation layer, as one line each. `messages` must stay where it is.
[[nodiscard]] vk::raii::DebugUtilsMessengerEXT create_messenger(const vk::raii::Instance& instance,
                                                                std::vector<std::string>& messages);

}  // namespace sunfleck
