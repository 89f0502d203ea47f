#pragma once
// Draws into a window: copies a picture pixel by pixel to each image of the swapchain and lets callers record commands over it.

#include "devices/gpu/context.h"
#include "programs/viewer/window.h"

#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>
#include <vector>
#include <vulkan/vulkan_raii.hpp>

namespace sunfleck {

// What to do without a window.
inline constexpr const char* no_window_cure = "use `sunfleck render` for a picture, or `sunfleck run` for results and pictures";

class Presenter {
 public:
  // The instance must outlive the object. Throws Error (device) if no device can draw into the surface.
  Presenter(const vk::raii::Instance& instance, vk::raii::SurfaceKHR surface);
  ~Presenter();
  Presenter(const Presenter&) = delete;
  Presenter& operator=(const Presenter&) = delete;

  // Handles that the code drawing over the picture needs.
  struct Handles {
    VkPhysicalDevice physical;
    VkDevice device;
    std::uint32_t family;
    VkQueue queue;
    VkDescriptorPool pool;
    VkRenderPass pass;
    std::uint32_t images;
  };
  [[nodiscard]] Handles handles() const;
  [[nodiscard]] const DeviceDescription& description() const { return description_; }

  // Draws one frame in a window of that size; does nothing while the window is changing its size. `overlay` records into a
  // command buffer within the render pass.
  void draw(glm::ivec2 size_px, const WindowPicture& picture, bool changed, std::uint32_t background,
            const std::function<void(VkCommandBuffer)>& overlay);

  // Runs commands and waits for them.
  void run(const std::function<void(VkCommandBuffer)>& commands);

  void wait_idle() const { device_.waitIdle(); }

 private:
  struct Target {
    vk::Image image;
    vk::raii::ImageView view{nullptr};
    vk::raii::Framebuffer framebuffer{nullptr};
    vk::raii::Semaphore drawn{nullptr};
  };
  // Pixels waiting to be copied to the device.
  struct Pixels {
    vk::raii::DeviceMemory memory{nullptr};
    vk::raii::Buffer buffer{nullptr};
    std::uint32_t* data = nullptr;
    std::size_t room = 0;  // capacity in pixels
    int width = 0, height = 0;
    glm::ivec2 at{0};
  };

  void take_device(const vk::raii::Instance& instance);
  void create_device();
  void create_pass();
  void create_swapchain(glm::ivec2 size_px);
  void take_pixels(const WindowPicture& picture);
  void record(const Target& target, std::uint32_t background, const std::function<void(VkCommandBuffer)>& overlay);
  void copy_pixels(const Target& target) const;
  [[nodiscard]] bool present(std::uint32_t image);
  void wait_for_last_frame();

  vk::raii::SurfaceKHR surface_;
  vk::raii::PhysicalDevice physical_{nullptr};
  vk::raii::Device device_{nullptr};
  vk::raii::Queue queue_{nullptr};
  vk::raii::CommandPool commands_pool_{nullptr};
  vk::raii::CommandBuffer commands_{nullptr};
  vk::raii::DescriptorPool descriptors_{nullptr};
  vk::raii::RenderPass pass_{nullptr};
  vk::raii::Semaphore acquired_{nullptr};
  vk::raii::Fence finished_{nullptr};
  bool in_flight_ = false;
  Pixels pixels_;
  vk::raii::SwapchainKHR swapchain_{nullptr};
  std::vector<Target> targets_;
  glm::ivec2 size_px_{0};
  bool fits_ = false;  // the swapchain fits the window
  std::uint32_t family_ = 0;
  vk::SurfaceFormatKHR format_;
  DeviceDescription description_;
};

}  // namespace sunfleck
