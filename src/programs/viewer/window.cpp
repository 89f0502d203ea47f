#include "programs/viewer/window.h"

#include "base/error.h"
#include "devices/gpu/instance.h"
#include "programs/viewer/presenter.h"

#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_vulkan.h>
#include <imgui.h>

#define GLFW_INCLUDE_NONE
#define GLFW_INCLUDE_VULKAN
#include <GLFW/glfw3.h>

#include <algorithm>
#include <utility>

namespace sunfleck {
namespace {

constexpr float font_px = 15.0F;

std::string glfw_reason() {
  const char* reason = nullptr;
  glfwGetError(&reason);
  return reason != nullptr ? reason : "no reason given";
}

// Initialises GLFW and terminates it at the end.
class Library {
 public:
  Library() {
    if (glfwInit() != GLFW_TRUE) throw_device("the window", "no display: " + glfw_reason(), no_window_cure);
    if (glfwVulkanSupported() == GLFW_TRUE) return;
    glfwTerminate();
    throw_device("the window", "no Vulkan driver on this machine draws into windows", no_window_cure);
  }
  ~Library() { glfwTerminate(); }
  Library(const Library&) = delete;
  Library& operator=(const Library&) = delete;
};

std::vector<const char*> surface_extensions() {
  std::uint32_t count = 0;
  const char** names = glfwGetRequiredInstanceExtensions(&count);
  return {names, names + count};
}

void throw_vulkan_failed(const vk::SystemError& error) {
  throw_failure("the window", error.what(), "update the driver; `sunfleck render` draws without a window");
}

}  // namespace

// Members are destroyed in the reverse of this order.
class Window::Screen {
 public:
  explicit Screen(const WindowSettings& settings) : loader_(open_loader()) {
    try {
      instance_ = create_instance(loader_, settings.validation, surface_extensions());
      if (settings.validation != Validation::off) messenger_ = create_messenger(instance_, messages_);
      open(settings);
      VkSurfaceKHR surface = VK_NULL_HANDLE;
      if (glfwCreateWindowSurface(*instance_, window_, nullptr, &surface) != VK_SUCCESS)
        throw_device("the window", "no Vulkan surface: " + glfw_reason(), no_window_cure);
      presenter_ = std::make_unique<Presenter>(instance_, vk::raii::SurfaceKHR(instance_, surface));
      start_panels(settings);
    } catch (const vk::SystemError& error) {
      close();
      throw_vulkan_failed(error);
    } catch (...) {
      close();
      throw;
    }
  }
  ~Screen() { close(); }
  Screen(const Screen&) = delete;
  Screen& operator=(const Screen&) = delete;

  [[nodiscard]] GLFWwindow* window() const { return window_; }
  [[nodiscard]] Presenter& presenter() const { return *presenter_; }
  [[nodiscard]] const std::vector<std::string>& messages() const { return messages_; }
  [[nodiscard]] double scale() const { return scale_; }
  [[nodiscard]] std::vector<KeyPress> take_pressed() { return std::exchange(pressed_, {}); }
  [[nodiscard]] std::vector<std::filesystem::path> take_dropped() { return std::exchange(dropped_, {}); }

  [[nodiscard]] glm::ivec2 size_px() const {
    glm::ivec2 size(0);
    glfwGetFramebufferSize(window_, &size.x, &size.y);
    return size;
  }

  // Returns false if there is nothing to draw on (minimised).
  [[nodiscard]] bool has_room() const {
    const glm::ivec2 size = size_px();
    return size.x > 0 && size.y > 0 && glfwGetWindowAttrib(window_, GLFW_ICONIFIED) != GLFW_TRUE;
  }

  // Returns whether the last frame took a button for pressed that was up again by then. Dear ImGui's backend notices that in the
  // next frame, and takes the pointer's place in that frame for the place of the click, so that it has to come at once.
  [[nodiscard]] bool owes_a_release() const {
    for (const int button : {GLFW_MOUSE_BUTTON_LEFT, GLFW_MOUSE_BUTTON_RIGHT, GLFW_MOUSE_BUTTON_MIDDLE})
      if (ImGui::IsMouseDown(button) && glfwGetMouseButton(window_, button) == GLFW_RELEASE) return true;
    return false;
  }

 private:
  void open(const WindowSettings& settings) {
    glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
    glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
    window_ = glfwCreateWindow(settings.width, settings.height, settings.title.c_str(), nullptr, nullptr);
    if (window_ == nullptr) throw_device("the window", "it cannot be opened: " + glfw_reason(), no_window_cure);
    glfwSetWindowUserPointer(window_, this);
    glfwSetDropCallback(window_, [](GLFWwindow* window, int count, const char** files) {
      auto& screen = *static_cast<Screen*>(glfwGetWindowUserPointer(window));
      for (int i = 0; i < count; ++i) screen.dropped_.emplace_back(files[i]);
    });
    glfwSetKeyCallback(window_, [](GLFWwindow* window, int key, int, int action, int mods) {
      if (action != GLFW_PRESS) return;
      auto& screen = *static_cast<Screen*>(glfwGetWindowUserPointer(window));
      screen.pressed_.push_back({key == GLFW_KEY_ESCAPE ? 27 : key, (mods & GLFW_MOD_CONTROL) != 0});
    });
    float scale_x = 1.0F;
    float scale_y = 1.0F;
    glfwGetWindowContentScale(window_, &scale_x, &scale_y);
    scale_ = std::clamp(std::max(scale_x, scale_y), 1.0F, 4.0F);
  }

  void start_panels(const WindowSettings& settings) {
    IMGUI_CHECKVERSION();
    ImGui::CreateContext();
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;  // panels begin where they belong; nothing is left behind on disk
    ImGui::StyleColorsLight();
    ImGui::GetStyle().ScaleAllSizes(scale_);
    static constexpr ImWchar glyphs[] = {0x20, 0xff, 0x2010, 0x2026, 0x2070, 0x209f, 0x2190, 0x2193, 0x2260, 0x2265, 0};
    ImFontConfig font;
    font.FontDataOwnedByAtlas = false;
    // ImGui does not write to the font, although it takes a pointer to non-const data.
    void* const bytes = const_cast<unsigned char*>(settings.font.data());
    io.Fonts->AddFontFromMemoryTTF(bytes, static_cast<int>(settings.font.size()), font_px * scale_, &font, glyphs);
    ImGui_ImplGlfw_InitForVulkan(window_, true);
    const Presenter::Handles handles = presenter_->handles();
    ImGui_ImplVulkan_InitInfo info{};
    info.Instance = *instance_;
    info.PhysicalDevice = handles.physical;
    info.Device = handles.device;
    info.QueueFamily = handles.family;
    info.Queue = handles.queue;
    info.DescriptorPool = handles.pool;
    info.MinImageCount = 2;
    info.ImageCount = handles.images;
    info.MSAASamples = VK_SAMPLE_COUNT_1_BIT;
    ImGui_ImplVulkan_Init(&info, handles.pass);
    panels_ = true;
    presenter_->run([](VkCommandBuffer commands) { ImGui_ImplVulkan_CreateFontsTexture(commands); });
    ImGui_ImplVulkan_DestroyFontUploadObjects();
  }

  void close() {
    if (presenter_) presenter_->wait_idle();
    if (panels_) {
      ImGui_ImplVulkan_Shutdown();
      ImGui_ImplGlfw_Shutdown();
      ImGui::DestroyContext();
      panels_ = false;
    }
    presenter_.reset();
    if (window_ != nullptr) glfwDestroyWindow(window_);
    window_ = nullptr;
  }

  Library library_;
  std::vector<std::string> messages_;
  vk::raii::Context loader_;
  vk::raii::Instance instance_{nullptr};
  vk::raii::DebugUtilsMessengerEXT messenger_{nullptr};
  GLFWwindow* window_ = nullptr;
  std::unique_ptr<Presenter> presenter_;
  std::vector<KeyPress> pressed_;
  std::vector<std::filesystem::path> dropped_;
  float scale_ = 1.0F;
  bool panels_ = false;
};

Window::Window(const WindowSettings& settings) : screen_(std::make_unique<Screen>(settings)) {}

Window::~Window() = default;

bool Window::is_open() const {
  return glfwWindowShouldClose(screen_->window()) == GLFW_FALSE;
}

void Window::close() {
  glfwSetWindowShouldClose(screen_->window(), GLFW_TRUE);
}

bool Window::begin_frame(double most_wait_s) {
  if (screen_->has_room() && screen_->owes_a_release()) most_wait_s = 0.0;
  if (most_wait_s > 0.0) {
    glfwWaitEventsTimeout(most_wait_s);
  } else {
    glfwPollEvents();
  }
  if (!screen_->has_room()) return false;
  ImGui_ImplVulkan_NewFrame();
  ImGui_ImplGlfw_NewFrame();
  ImGui::NewFrame();
  return true;
}

void Window::end_frame(const WindowPicture& picture, bool changed, std::uint32_t background) {
  ImGui::Render();
  try {
    screen_->presenter().draw(size_px(), picture, changed, background, [](VkCommandBuffer commands) {
      ImGui_ImplVulkan_RenderDrawData(ImGui::GetDrawData(), commands);
    });
  } catch (const vk::SystemError& error) {
    throw_vulkan_failed(error);
  }
}

void Window::wake() {
  glfwPostEmptyEvent();
}

glm::ivec2 Window::size_px() const {
  return screen_->size_px();
}

double Window::scale() const {
  return screen_->scale();
}

void Window::set_title(const std::string& title) {
  glfwSetWindowTitle(screen_->window(), title.c_str());
}

void Window::set_clipboard(const std::string& text) {
  glfwSetClipboardString(screen_->window(), text.c_str());
}

std::vector<KeyPress> Window::take_key_presses() {
  std::vector<KeyPress> presses = screen_->take_pressed();
  if (ImGui::GetIO().WantTextInput) presses.clear();
  return presses;
}

std::vector<std::filesystem::path> Window::take_dropped_files() {
  return screen_->take_dropped();
}

const DeviceDescription& Window::device() const {
  return screen_->presenter().description();
}

const std::vector<std::string>& Window::validation_messages() const {
  return screen_->messages();
}

}  // namespace sunfleck
