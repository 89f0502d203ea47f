#include "pictures/drawing/text.h"

#include "base/check.h"
#include "base/text.h"
#include "dejavu_sans.h"
#include "pictures/drawing/palette.h"

#include <stb_truetype.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace sunfleck {
namespace {

constexpr char32_t replacement = 0xfffd;

// One letter of a set line: its glyph and its origin relative to the line's start.
struct SetGlyph {
  int glyph = 0;
  double x_px = 0.0;
};

struct SetLine {
  std::vector<SetGlyph> glyphs;
  double width_px = 0.0;
};

SetLine set(const stbtt_fontinfo& font, std::string_view line, double scale) {
  SetLine result;
  int previous = -1;
  while (!line.empty()) {
    const int glyph = stbtt_FindGlyphIndex(&font, static_cast<int>(take_code_point(line).value_or(replacement)));
    if (previous >= 0) result.width_px += scale * stbtt_GetGlyphKernAdvance(&font, previous, glyph);
    result.glyphs.push_back({glyph, result.width_px});
    int advance = 0;
    int bearing = 0;
    stbtt_GetGlyphHMetrics(&font, glyph, &advance, &bearing);
    result.width_px += scale * advance;
    previous = glyph;
  }
  return result;
}

// Mixes encoded values: mixed in linear light, the thin strokes of dark type on a light background would look too faint.
void mix_encoded(std::array<std::uint8_t, 3>& pixel, const std::array<std::uint8_t, 3>& colour, double coverage) {
  for (std::size_t i = 0; i < 3; ++i) {
    pixel[i] = static_cast<std::uint8_t>(std::lround(pixel[i] + coverage * (colour[i] - pixel[i])));
  }
}

}  // namespace

std::span<const unsigned char> Typeface::file() {
  return dejavu_sans;
}

Typeface::Typeface() : font_(std::make_unique<stbtt_fontinfo>()) {
  const int ready = stbtt_InitFont(font_.get(), dejavu_sans, stbtt_GetFontOffsetForIndex(dejavu_sans, 0));
  ENSURE(ready, !=, 0);
}

Typeface::~Typeface() = default;

double Typeface::width_px(std::string_view line, double size_px) const {
  return set(*font_, line, stbtt_ScaleForMappingEmToPixels(font_.get(), static_cast<float>(size_px))).width_px;
}

void Typeface::draw(Image& image, std::string_view line, glm::dvec2 baseline_px, double size_px, const Colour& colour) const {
  const float scale = stbtt_ScaleForMappingEmToPixels(font_.get(), static_cast<float>(size_px));
  const std::array<std::uint8_t, 3> encoded = to_srgb(colour);
  // Aligned with the rows, so that stems stay crisp.
  const int baseline_row = static_cast<int>(std::lround(baseline_px.y));
  std::vector<unsigned char> coverage;
  for (const SetGlyph& letter : set(*font_, line, scale).glyphs) {
    const double x_px = baseline_px.x + letter.x_px;
    const int column = static_cast<int>(std::floor(x_px));
    const float shift = static_cast<float>(x_px - column);
    int left = 0, top = 0, right = 0, bottom = 0;
    stbtt_GetGlyphBitmapBoxSubpixel(font_.get(), letter.glyph, scale, scale, shift, 0.0F, &left, &top, &right, &bottom);
    const int width = right - left;
    if (width <= 0 || bottom <= top) continue;
    coverage.assign(static_cast<std::size_t>(width) * (bottom - top), 0);
    stbtt_MakeGlyphBitmapSubpixel(font_.get(), coverage.data(), width, bottom - top, width, scale, scale, shift, 0.0F,
                                  letter.glyph);
    for (int y = std::max(top, -baseline_row); y < std::min(bottom, image.height - baseline_row); ++y) {
      for (int x = std::max(left, -column); x < std::min(right, image.width - column); ++x) {
        const double covered = coverage[static_cast<std::size_t>(y - top) * width + (x - left)] / 255.0;
        const std::size_t pixel = static_cast<std::size_t>(baseline_row + y) * image.width + (column + x);
        mix_encoded(image.pixels[pixel], encoded, covered);
      }
    }
  }
}

void draw_with_halo(Image& image, const Typeface& face, std::string_view line, glm::dvec2 baseline_px, double size_px,
                    const Colour& colour) {
  const double edge_px = std::max(1.0, 0.07 * size_px);
  for (int y = -2; y <= 2; ++y) {
    for (int x = -2; x <= 2; ++x) {
      face.draw(image, line, baseline_px + edge_px * glm::dvec2(x, y), size_px, from_srgb(sky_top));
    }
  }
  face.draw(image, line, baseline_px, size_px, colour);
}

void draw_letter(Image& image, const Typeface& face, std::string_view letter, glm::dvec2 at_px, double size_px,
                 const Colour& colour) {
  const glm::dvec2 baseline_px = at_px + 0.5 * size_px * glm::dvec2(-face.width_px(letter, 1.0), Typeface::cap_height);
  draw_with_halo(image, face, letter, baseline_px, size_px, colour);
}

}  // namespace sunfleck
