#pragma once
// Draws text in the single typeface of all charts, DejaVu Sans, which is embedded in the program.

#include "pictures/drawing/colour_scale.h"
#include "pictures/drawing/image.h"

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

  // Returns its TrueType file, for callers that set text by other means.
  [[nodiscard]] static std::span<const unsigned char> file();

  Typeface(const Typeface&) = delete;
  Typeface& operator=(const Typeface&) = delete;

  // Height of capitals and depth of descenders below the baseline, for a type size (em) of 1.
  static constexpr double cap_height = 0.73;

  // Returns the advance width of a line of UTF-8 with kerning. Invalid UTF-8 counts, and is drawn, as U+FFFD.
  [[nodiscard]] double width_px(std::string_view line, double size_px) const;

  // Draws a line of UTF-8 to the right of `baseline_px`: x to the right, y downwards, (0, 0) is the picture's upper left
  // corner. `size_px` is the type size (em). Parts outside the picture are clipped.
  void draw(Image& image, std::string_view line, glm::dvec2 baseline_px, double size_px, const Colour& colour) const;

 private:
  std::unique_ptr<stbtt_fontinfo> font_;
};

// Draws a line as Typeface::draw, with a thin pale edge that keeps it legible on any background.
void draw_with_halo(Image& image, const Typeface& face, std::string_view line, glm::dvec2 baseline_px, double size_px,
                    const Colour& colour);

// Draws a letter centred on `at_px`, with such an edge.
void draw_letter(Image& image, const Typeface& face, std::string_view letter, glm::dvec2 at_px, double size_px,
                 const Colour& colour);

}  // namespace sunfleck
