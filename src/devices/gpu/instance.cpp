#include "devices/gpu/instance.h"

#include "base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <utility>

namespace sunfleck {
namespace {

VKAPI_ATTR VkBool32 VKAPI_CALL keep_message(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
                                            const VkDebugUtilsMessengerCallbackDataEXT* data, void* messages) {
  std::string line = data->pMessage;
  std::replace(line.begin(), line.end(), '\n', ' ');
  static_cast<std::vector<std::string>*>(messages)->push_back(std::move(line));
  return VK_FALSE;
}

}  // namespace

vk::raii::Context open_loader() {
  try {
    return {};
  } catch (const std::exception& error) {
    throw_device("no Vulkan device", error.what(), no_vulkan_cure);
  }
}

bool has_layer(const vk::raii::Context& loader, std::string_view name) {
  const auto layers = loader.enumerateInstanceLayerProperties();
  return std::any_of(layers.begin(), layers.end(), [&](const auto& layer) { return name == layer.layerName.data(); });
}

bool has_extension(const std::vector<vk::ExtensionProperties>& extensions, std::string_view name) {
  return std::any_of(extensions.begin(), extensions.end(), [&](const auto& one) { return name == one.extensionName.data(); });
}

vk::raii::Instance create_instance(const vk::raii::Context& loader, Validation validation,
                                   std::vector<const char*> extensions) {
  std::vector<const char*> layers;
  vk::InstanceCreateFlags flags;
  if (has_extension(loader.enumerateInstanceExtensionProperties(), VK_KHR_PORTABILITY_ENUMERATION_EXTENSION_NAME)) {
    extensions.push_back(VK_KHR_PORTABILITY_ENUMERATION_EXTENSION_NAME);
    flags |= vk::InstanceCreateFlagBits::eEnumeratePortabilityKHR;
  }
  const vk::ApplicationInfo application("sunfleck", 1, nullptr, 0, api_version);
  const std::vector<vk::ValidationFeatureEnableEXT> thorough = {vk::ValidationFeatureEnableEXT::eSynchronizationValidation,
                                                                vk::ValidationFeatureEnableEXT::eGpuAssisted,
                                                                vk::ValidationFeatureEnableEXT::eGpuAssistedReserveBindingSlot};
  const vk::ValidationFeaturesEXT features(thorough);
  if (validation != Validation::off) {
    if (!has_layer(loader, validation_layer_name)) {
      throw_device("Vulkan validation", fmt::format("{} is not installed", validation_layer_name),
                   "install it (Debian: vulkan-validationlayers) or run without validation");
    }
    layers.push_back(validation_layer_name);
    extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
  }
  if (validation == Validation::thorough) extensions.push_back(VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME);
  return {loader, vk::InstanceCreateInfo(flags, &application, layers, extensions,
                                         validation == Validation::thorough ? &features : nullptr)};
}

vk::raii::DebugUtilsMessengerEXT create_messenger(const vk::raii::Instance& instance, std::vector<std::string>& messages) {
  using Severity = vk::DebugUtilsMessageSeverityFlagBitsEXT;
  return {instance,
          vk::DebugUtilsMessengerCreateInfoEXT({}, Severity::eWarning | Severity::eError,
                                               vk::DebugUtilsMessageTypeFlagBitsEXT::eValidation, keep_message, &messages)};
}

}  // namespace sunfleck
