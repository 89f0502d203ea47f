#pragma once
// Text in the one typeface of all charts, DejaVu Sans, which is embedded in the program.

#include "view/colour_scale.h"
#include "view/image.h"

#include <glm/vec2.hpp>
#include <memory>
#include <span>
#include <string_view>

struct stbtt_fontinfo;

namespace sunfleck {

class Typeface {
 public:
  Typeface();
  ~Typeface();

  // Its TrueType file, for who sets text by other means.
  [[nodiscard]] static std::span<const unsigned char> file();

  Typeface(const Typeface&) = delete;
  Typeface& operator=(const Typeface&) = delete;

  // Height of capitals and depth of the letters that hang below the baseline, for a type size (em) of 1.
  static constexpr double cap_height = 0.73;
  static constexpr double descent = 0.24;

  // Advance width of a line of UTF-8, kerned. What is no UTF-8 counts, and is drawn, as U+FFFD.
  [[nodiscard]] double width_px(std::string_view line, double size_px) const;

  // Draws a line of UTF-8 from `baseline_px` to the right: x to the right, y downwards, (0, 0) the picture's upper left
  // corner. `size_px` is the type size (em). What lies outside the picture is cut off.
  void draw(Image& image, std::string_view line, glm::dvec2 baseline_px, double size_px, const Colour& colour) const;

 private:
  std::unique_ptr<stbtt_fontinfo> font_;
};

}  // namespace sunfleck
