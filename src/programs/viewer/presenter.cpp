#include "programs/viewer/presenter.h"

#include "base/check.h"
#include "base/error.h"
#include "devices/gpu/instance.h"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace sunfleck {
namespace {

constexpr std::uint64_t forever = std::numeric_limits<std::uint64_t>::max();
constexpr std::uint64_t patience_ns = 200'000'000;  // wait for an image; a hidden window may not deliver one

constexpr std::array wanted_formats{vk::Format::eB8G8R8A8Unorm, vk::Format::eR8G8B8A8Unorm};

std::optional<std::uint32_t> drawing_family(const vk::raii::PhysicalDevice& physical, const vk::raii::SurfaceKHR& surface) {
  const auto families = physical.getQueueFamilyProperties();
  for (std::uint32_t i = 0; i < families.size(); ++i) {
    if ((families[i].queueFlags & vk::QueueFlagBits::eGraphics) && physical.getSurfaceSupportKHR(i, *surface)) return i;
  }
  return std::nullopt;
}

std::optional<vk::SurfaceFormatKHR> usable_format(const vk::raii::PhysicalDevice& physical,
                                                  const vk::raii::SurfaceKHR& surface) {
  const auto formats = physical.getSurfaceFormatsKHR(*surface);
  for (const vk::Format wanted : wanted_formats) {
    const auto found = std::find_if(formats.begin(), formats.end(), [&](const auto& one) { return one.format == wanted; });
    if (found != formats.end()) return *found;
  }
  return std::nullopt;
}

bool can_draw(const vk::raii::PhysicalDevice& physical, const vk::raii::SurfaceKHR& surface) {
  return has_extension(physical.enumerateDeviceExtensionProperties(), VK_KHR_SWAPCHAIN_EXTENSION_NAME) &&
         drawing_family(physical, surface) && usable_format(physical, surface) &&
         (physical.getSurfaceCapabilitiesKHR(*surface).supportedUsageFlags & vk::ImageUsageFlagBits::eTransferDst);
}

// Returns the rank of a device, smaller is better.
int rank(const vk::PhysicalDeviceProperties& properties) {
  switch (properties.deviceType) {
    case vk::PhysicalDeviceType::eDiscreteGpu:
      return 1;
    case vk::PhysicalDeviceType::eIntegratedGpu:
      return 2;
    case vk::PhysicalDeviceType::eVirtualGpu:
      return 3;
    default:
      return 4;
  }
}

void change_layout(const vk::raii::CommandBuffer& commands, vk::Image image, vk::ImageLayout from, vk::ImageLayout to) {
  using Stage = vk::PipelineStageFlagBits;
  using Access = vk::AccessFlagBits;
  const bool to_transfer = to == vk::ImageLayout::eTransferDstOptimal;
  const vk::ImageMemoryBarrier barrier(
      to_transfer ? vk::AccessFlags() : Access::eTransferWrite,
      to_transfer ? Access::eTransferWrite : Access::eColorAttachmentRead | Access::eColorAttachmentWrite, from, to,
      VK_QUEUE_FAMILY_IGNORED, VK_QUEUE_FAMILY_IGNORED, image, {vk::ImageAspectFlagBits::eColor, 0, 1, 0, 1});
  commands.pipelineBarrier(Stage::eTransfer, to_transfer ? Stage::eTransfer : Stage::eColorAttachmentOutput, {}, {}, {},
                           barrier);
}

}  // namespace

Presenter::Presenter(const vk::raii::Instance& instance, vk::raii::SurfaceKHR surface) : surface_(std::move(surface)) {
  take_device(instance);
  create_device();
  create_pass();
}

Presenter::~Presenter() {
  if (*device_) device_.waitIdle();
}

void Presenter::take_device(const vk::raii::Instance& instance) {
  int best = std::numeric_limits<int>::max();
  for (vk::raii::PhysicalDevice& physical : vk::raii::PhysicalDevices(instance)) {
    const auto properties = physical.getProperties();
    if (rank(properties) >= best || !can_draw(physical, surface_)) continue;
    best = rank(properties);
    description_.name = properties.deviceName.data();
    description_.software = properties.deviceType == vk::PhysicalDeviceType::eCpu;
    physical_ = std::move(physical);
  }
  if (!*physical_) throw_device("the window", "no Vulkan device of this machine can draw into it", no_window_cure);
  family_ = drawing_family(physical_, surface_).value();
  format_ = usable_format(physical_, surface_).value();
}

void Presenter::create_device() {
  const float priority = 1.0F;
  const vk::DeviceQueueCreateInfo queue({}, family_, 1, &priority);
  std::vector<const char*> extensions{VK_KHR_SWAPCHAIN_EXTENSION_NAME};
  if (has_extension(physical_.enumerateDeviceExtensionProperties(), portability_subset))
    extensions.push_back(portability_subset);
  device_ = vk::raii::Device(physical_, vk::DeviceCreateInfo({}, queue, {}, extensions));
  queue_ = device_.getQueue(family_, 0);
  commands_pool_ = device_.createCommandPool({vk::CommandPoolCreateFlagBits::eResetCommandBuffer, family_});
  commands_ = std::move(device_.allocateCommandBuffers({*commands_pool_, vk::CommandBufferLevel::ePrimary, 1}).front());
  const vk::DescriptorPoolSize samplers(vk::DescriptorType::eCombinedImageSampler, 16);
  descriptors_ = device_.createDescriptorPool({vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet, 16, samplers});
  acquired_ = device_.createSemaphore({});
  finished_ = device_.createFence({});
}

void Presenter::create_pass() {
  using Stage = vk::PipelineStageFlagBits;
  using Access = vk::AccessFlagBits;
  using Layout = vk::ImageLayout;
  const vk::AttachmentDescription colour({}, format_.format, vk::SampleCountFlagBits::e1, vk::AttachmentLoadOp::eLoad,
                                         vk::AttachmentStoreOp::eStore, vk::AttachmentLoadOp::eDontCare,
                                         vk::AttachmentStoreOp::eDontCare, Layout::eColorAttachmentOptimal,
                                         Layout::ePresentSrcKHR);
  const vk::AttachmentReference reference(0, Layout::eColorAttachmentOptimal);
  const vk::SubpassDescription subpass({}, vk::PipelineBindPoint::eGraphics, {}, reference);
  const vk::SubpassDependency dependency(VK_SUBPASS_EXTERNAL, 0, Stage::eColorAttachmentOutput, Stage::eColorAttachmentOutput,
                                         {}, Access::eColorAttachmentRead | Access::eColorAttachmentWrite);
  pass_ = device_.createRenderPass({{}, colour, subpass, dependency});
}

Presenter::Handles Presenter::handles() const {
  return {*physical_, *device_, family_, *queue_, *descriptors_, *pass_, 3};
}

void Presenter::create_swapchain(glm::ivec2 size_px) {
  wait_for_last_frame();
  device_.waitIdle();
  const auto capabilities = physical_.getSurfaceCapabilitiesKHR(*surface_);
  vk::Extent2D extent = capabilities.currentExtent;
  if (extent.width == std::numeric_limits<std::uint32_t>::max()) {
    extent.width =
        std::clamp(static_cast<std::uint32_t>(size_px.x), capabilities.minImageExtent.width, capabilities.maxImageExtent.width);
    extent.height = std::clamp(static_cast<std::uint32_t>(size_px.y), capabilities.minImageExtent.height,
                               capabilities.maxImageExtent.height);
  }
  targets_.clear();
  size_px_ = {extent.width, extent.height};
  if (extent.width == 0 || extent.height == 0) return;
  fits_ = true;
  std::uint32_t images = std::max(2U, capabilities.minImageCount);
  if (capabilities.maxImageCount > 0) images = std::min(images, capabilities.maxImageCount);
  vk::raii::SwapchainKHR old = std::move(swapchain_);
  swapchain_ = device_.createSwapchainKHR({{},
                                           *surface_,
                                           images,
                                           format_.format,
                                           format_.colorSpace,
                                           extent,
                                           1,
                                           vk::ImageUsageFlagBits::eColorAttachment | vk::ImageUsageFlagBits::eTransferDst,
                                           vk::SharingMode::eExclusive,
                                           {},
                                           capabilities.currentTransform,
                                           (capabilities.supportedCompositeAlpha & vk::CompositeAlphaFlagBitsKHR::eOpaque)
                                               ? vk::CompositeAlphaFlagBitsKHR::eOpaque
                                               : vk::CompositeAlphaFlagBitsKHR::eInherit,
                                           vk::PresentModeKHR::eFifo,
                                           VK_TRUE,
                                           *old});
  for (const vk::Image image : swapchain_.getImages()) {
    Target target;
    target.image = image;
    target.view = device_.createImageView(
        {{}, image, vk::ImageViewType::e2D, format_.format, {}, {vk::ImageAspectFlagBits::eColor, 0, 1, 0, 1}});
    target.framebuffer = device_.createFramebuffer({{}, *pass_, *target.view, extent.width, extent.height, 1});
    target.drawn = device_.createSemaphore({});
    targets_.push_back(std::move(target));
  }
}

void Presenter::take_pixels(const WindowPicture& picture) {
  const std::size_t pixels = picture.pixels.size();
  EXPECT(pixels, ==, static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height));
  if (pixels > pixels_.room) {
    using Property = vk::MemoryPropertyFlagBits;
    pixels_ = Pixels();
    pixels_.buffer = device_.createBuffer({{}, pixels * sizeof(std::uint32_t), vk::BufferUsageFlagBits::eTransferSrc});
    const auto needs = pixels_.buffer.getMemoryRequirements();
    const auto memory = physical_.getMemoryProperties();
    const auto wanted = Property::eHostVisible | Property::eHostCoherent;
    std::uint32_t type = 0;
    while ((needs.memoryTypeBits >> type & 1U) == 0 || (memory.memoryTypes[type].propertyFlags & wanted) != wanted) ++type;
    pixels_.memory = device_.allocateMemory({needs.size, type});
    pixels_.buffer.bindMemory(*pixels_.memory, 0);
    pixels_.data = static_cast<std::uint32_t*>(pixels_.memory.mapMemory(0, VK_WHOLE_SIZE));
    pixels_.room = pixels;
  }
  pixels_.width = picture.width;
  pixels_.height = picture.height;
  if (format_.format == vk::Format::eB8G8R8A8Unorm) {
    std::copy(picture.pixels.begin(), picture.pixels.end(), pixels_.data);
    return;
  }
  std::transform(picture.pixels.begin(), picture.pixels.end(), pixels_.data, [](std::uint32_t colour) {
    return (colour & 0x0000ff00U) | (colour >> 16U & 0xffU) | (colour & 0xffU) << 16U;
  });
}

// Copies the part of the picture that lies within the window.
void Presenter::copy_pixels(const Target& target) const {
  const glm::ivec2 at = pixels_.at;
  const int width = std::min(pixels_.width, size_px_.x - at.x);
  const int height = std::min(pixels_.height, size_px_.y - at.y);
  if (width <= 0 || height <= 0) return;
  const vk::BufferImageCopy copy(0, static_cast<std::uint32_t>(pixels_.width), 0, {vk::ImageAspectFlagBits::eColor, 0, 0, 1},
                                 {at.x, at.y, 0}, {static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height), 1});
  commands_.copyBufferToImage(*pixels_.buffer, target.image, vk::ImageLayout::eTransferDstOptimal, copy);
}

void Presenter::record(const Target& target, std::uint32_t background, const std::function<void(VkCommandBuffer)>& overlay) {
  using Layout = vk::ImageLayout;
  commands_.begin({vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
  change_layout(commands_, target.image, Layout::eUndefined, Layout::eTransferDstOptimal);
  const auto channel = [&](unsigned shift) { return static_cast<float>(background >> shift & 0xffU) / 255.0F; };
  const vk::ClearColorValue colour(std::array{channel(16), channel(8), channel(0), 1.0F});
  commands_.clearColorImage(target.image, Layout::eTransferDstOptimal, colour,
                            vk::ImageSubresourceRange(vk::ImageAspectFlagBits::eColor, 0, 1, 0, 1));
  const vk::MemoryBarrier in_order(vk::AccessFlagBits::eTransferWrite, vk::AccessFlagBits::eTransferWrite);
  commands_.pipelineBarrier(vk::PipelineStageFlagBits::eTransfer, vk::PipelineStageFlagBits::eTransfer, {}, in_order, {}, {});
  copy_pixels(target);
  change_layout(commands_, target.image, Layout::eTransferDstOptimal, Layout::eColorAttachmentOptimal);
  const vk::Rect2D all({0, 0}, {static_cast<std::uint32_t>(size_px_.x), static_cast<std::uint32_t>(size_px_.y)});
  commands_.beginRenderPass({*pass_, *target.framebuffer, all, {}}, vk::SubpassContents::eInline);
  overlay(*commands_);
  commands_.endRenderPass();
  commands_.end();
}

void Presenter::wait_for_last_frame() {
  if (!in_flight_) return;
  const auto waited = device_.waitForFences(*finished_, VK_TRUE, forever);
  ENSURE(static_cast<int>(waited), ==, static_cast<int>(vk::Result::eSuccess));
  device_.resetFences(*finished_);
  in_flight_ = false;
}

// Presents the image. Returns false if the swapchain no longer fits the window.
bool Presenter::present(std::uint32_t image) {
  try {
    const vk::SwapchainKHR swapchain = *swapchain_;
    const vk::Semaphore drawn = *targets_[image].drawn;
    return queue_.presentKHR({drawn, swapchain, image}) == vk::Result::eSuccess;
  } catch (const vk::OutOfDateKHRError&) {
    return false;
  }
}

void Presenter::draw(glm::ivec2 size_px, const WindowPicture& picture, bool changed, std::uint32_t background,
                     const std::function<void(VkCommandBuffer)>& overlay) {
  wait_for_last_frame();
  if (changed) take_pixels(picture);
  pixels_.at = picture.at;
  if (size_px != size_px_ || !fits_) create_swapchain(size_px);
  if (targets_.empty()) return;
  std::uint32_t image = 0;
  try {
    const auto [result, number] = swapchain_.acquireNextImage(patience_ns, *acquired_, nullptr);
    if (result == vk::Result::eTimeout || result == vk::Result::eNotReady) return;
    image = number;
  } catch (const vk::OutOfDateKHRError&) {
    fits_ = false;
    return;
  }
  record(targets_[image], background, overlay);
  const vk::PipelineStageFlags wait_before = vk::PipelineStageFlagBits::eTransfer;
  const vk::Semaphore acquired = *acquired_;
  const vk::Semaphore drawn = *targets_[image].drawn;
  const vk::CommandBuffer commands = *commands_;
  queue_.submit(vk::SubmitInfo(acquired, wait_before, commands, drawn), *finished_);
  in_flight_ = true;
  fits_ = present(image);
}

void Presenter::run(const std::function<void(VkCommandBuffer)>& commands) {
  wait_for_last_frame();
  commands_.begin({vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
  commands(*commands_);
  commands_.end();
  const vk::CommandBuffer handle = *commands_;
  queue_.submit(vk::SubmitInfo({}, {}, handle), *finished_);
  in_flight_ = true;
  wait_for_last_frame();
}

}  // namespace sunfleck
