#pragma once
// A window with a picture and Dear ImGui's panels over it, drawn by Vulkan. Knows nothing of what is shown.

#include "gpu/context.h"

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
  int width = 1280;  // as the desktop counts
  int height = 800;
  std::string device;  // name of the one that draws, if it can draw into windows; else the best that can
  Validation validation = Validation::off;
  std::span<const unsigned char> font;  // of the panels: the bytes of a TrueType file, which must outlive the window
};

// Colours of the picture: one 32-bit word a pixel, 0x00RRGGBB, sRGB.
struct WindowPicture {
  std::span<const std::uint32_t> pixels;  // [row from the top][column]
  int width = 0;
  int height = 0;
  glm::ivec2 at{0};  // of its upper left corner in the window
};

// A key that went down. Letters and digits are ASCII, in upper case; Escape is 27.
struct KeyPress {
  int key = 0;
  bool control = false;
};

// Used by the thread that made it; there is one at a time, for Dear ImGui has one context. Between begin_frame and end_frame
// panels are described with ImGui's functions. Sizes and fonts follow the desktop's
// scale.
class Window {
 public:
  // Throws Error (device) if there is no display, or no Vulkan device that can draw into its windows; Error (failure) if
  // memory runs out.
  explicit Window(const WindowSettings& settings);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  // Until the user or the program closes it.
  [[nodiscard]] bool is_open() const;
  void close();

  // Waits for input, at most so long, and begins a frame. False while there is nothing to draw on (minimised): no frame is
  // begun.
  [[nodiscard]] bool begin_frame(double most_wait_s);
  // Draws the picture and over it the panels. Pixels that the picture does not cover are `background`, 0x00RRGGBB. Only what
  // differs from the last frame's picture need be copied: `changed` says whether it does.
  void end_frame(const WindowPicture& picture, bool changed, std::uint32_t background);

  // Ends a wait in begin_frame. Any thread may call it.
  static void wake();

  [[nodiscard]] glm::ivec2 size_px() const;
  [[nodiscard]] double scale() const;  // of fonts and panels
  void set_title(const std::string& title);
  void set_clipboard(const std::string& text);
  // Since the last question, even if the key was up again before a frame began; none that went into a panel's text.
  [[nodiscard]] std::vector<KeyPress> take_key_presses();
  // Dropped since the last question.
  [[nodiscard]] std::vector<std::filesystem::path> take_dropped_files();
  // The one that draws.
  [[nodiscard]] const DeviceDescription& device() const;
  [[nodiscard]] const std::vector<std::string>& validation_messages() const;

 private:
  class Screen;
  std::unique_ptr<Screen> screen_;
};

}  // namespace sunfleck
