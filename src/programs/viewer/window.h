#pragma once
// A window with a picture and Dear ImGui's panels over it, drawn by Vulkan. Knows nothing about the content.

#include "devices/gpu/context.h"

#include <cstdint>
#include <filesystem>
#include <glm/vec2.hpp>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace sunfleck {

struct WindowSettings {
  std::string title;
  int width = 1280;  // in desktop units
  int height = 800;
  Validation validation = Validation::off;
  std::span<const unsigned char> font;  // of the panels: the bytes of a TrueType file, which must outlive the window
};

// Colours of the picture: one 32-bit word per pixel, 0x00RRGGBB, sRGB.
struct WindowPicture {
  std::span<const std::uint32_t> pixels;  // [row from the top][column]
  int width = 0;
  int height = 0;
  glm::ivec2 at{0};  // position of its upper left corner in the window
};

// A key that was pressed. Letters and digits are upper-case ASCII; Escape is 27.
struct KeyPress {
  int key = 0;
  bool control = false;
};

// A window. Only the thread that created it may use it, and only one may exist at a time, because Dear ImGui has one context.
// Between begin_frame and end_frame panels are described with ImGui's functions. Sizes and fonts follow the desktop's scale.
class Window {
 public:
  // Throws Error (device) if there is no display, or no Vulkan device that can draw into its windows; Error (failure) if memory
  // runs out.
  explicit Window(const WindowSettings& settings);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  // Returns true until the user or the program closes the window.
  [[nodiscard]] bool is_open() const;
  void close();

  // Waits for input, at most `most_wait_s`, and begins a frame. Returns false without beginning one if there is nothing to draw
  // on (minimised).
  [[nodiscard]] bool begin_frame(double most_wait_s);
  // Draws the picture and the panels over it. Pixels that the picture does not cover are `background`, 0x00RRGGBB. `changed`
  // says whether the picture differs from the last frame's; an unchanged one is not copied again.
  void end_frame(const WindowPicture& picture, bool changed, std::uint32_t background);

  // Ends a wait in begin_frame. Any thread may call it.
  static void wake();

  [[nodiscard]] glm::ivec2 size_px() const;
  [[nodiscard]] double scale() const;  // of fonts and panels
  void set_title(const std::string& title);
  void set_clipboard(const std::string& text);
  // Returns the keys pressed since the last call, even if a key was released before a frame began; excludes those typed into a
  // panel's text.
  [[nodiscard]] std::vector<KeyPress> take_key_presses();
  // Returns the files dropped since the last call.
  [[nodiscard]] std::vector<std::filesystem::path> take_dropped_files();
  // Returns the device that draws.
  [[nodiscard]] const DeviceDescription& device() const;
  [[nodiscard]] const std::vector<std::string>& validation_messages() const;

 private:
  class Screen;
  std::unique_ptr<Screen> screen_;
};

}  // namespace sunfleck
