#include "io/plot_script.h"

#include <cmath>
#include <cstdint>
#include <iterator>

namespace sunfleck {
namespace {

constexpr std::string_view replacement = "\xef\xbf\xbd";  // U+FFFD
constexpr std::string_view left_quote = "\xe2\x80\x98";   // U+2018
constexpr std::string_view right_quote = "\xe2\x80\x99";  // U+2019
constexpr std::string_view ellipsis = "\xe2\x80\xa6";     // U+2026

// Returns the length of the well-formed UTF-8 sequence (Unicode 15, table 3-7) at the start of `text`; 0 if there is none.
std::size_t sequence_length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U; };
  const auto follows = [&](std::size_t i, unsigned lo = 0x80, unsigned hi = 0xBF) { return byte(i) >= lo && byte(i) <= hi; };
  const unsigned first = byte(0);
  if (first < 0x80) return 1;
  if (first >= 0xC2 && first <= 0xDF) return follows(1) ? 2 : 0;
  if (first >= 0xE0 && first <= 0xEF) {
    const bool second = follows(1, first == 0xE0 ? 0xA0 : 0x80, first == 0xED ? 0x9F : 0xBF);
    return second && follows(2) ? 3 : 0;
  }
  if (first >= 0xF0 && first <= 0xF4) {
    const bool second = follows(1, first == 0xF0 ? 0x90 : 0x80, first == 0xF4 ? 0x8F : 0xBF);
    return second && follows(2) && follows(3) ? 4 : 0;
  }
  return 0;
}

}  // namespace

std::string plot_quoted(std::string_view text, std::size_t longest) {
  std::string quoted = "'";
  std::size_t characters = 0;
  while (!text.empty()) {
    if (++characters > longest) {
      quoted += ellipsis;
      break;
    }
    const std::size_t length = sequence_length(text);
    const std::string_view character = length == 0 ? replacement : text.substr(0, length);
    const auto first = static_cast<unsigned char>(character[0]);
    const bool control = first < 0x20 || first == 0x7F || (first == 0xC2 && static_cast<unsigned char>(character[1]) < 0xA0);
    if (control) {
      quoted += ' ';
    } else if (character == "'") {
      quoted += right_quote;
    } else if (character == "`") {
      quoted += left_quote;
    } else {
      quoted += character;
    }
    text.remove_prefix(length == 0 ? 1 : length);
  }
  return quoted + '\'';
}

double tic_step(double range, double length_px, double room_px) {
  const double finest = range * room_px / length_px;
  if (!(finest > 0.0) || !std::isfinite(finest)) return 1.0;
  const double decade = std::pow(10.0, std::floor(std::log10(finest)));
  for (const double step : {1.0, 2.0, 5.0}) {
    if (step * decade >= finest) return step * decade;
  }
  return 10.0 * decade;
}

PlotScript::PlotScript(int width_px, int height_px) : width_px_(width_px), height_px_(height_px) {
  add("set encoding utf8");
  add("set terminal pngcairo noenhanced size {},{} font 'DejaVu Sans,20' linewidth 2 background '#ffffff'", width_px,
      height_px);
  add("set datafile missing 'NaN'");
  add("set border linecolor '#404040' linewidth 0.75");
  add("set grid back linetype 1 linecolor '#d9d9d9' linewidth 0.5");
  add("set tics scale 0.6 textcolor '#202020'");
  add("set errorbars small linewidth 0.9");
  add("unset key");
}

void PlotScript::begin_data(std::string_view name) {
  text_ += fmt::format("${} << EOD\n", name);
}

void PlotScript::row(std::span<const double> numbers) {
  for (const double number : numbers) {
    if (std::isfinite(number)) {
      fmt::format_to(std::back_inserter(text_), "{:.9g} ", number);
    } else {
      text_ += "NaN ";
    }
  }
  text_.back() = '\n';
}

void PlotScript::gap() {
  text_ += '\n';
}

void PlotScript::end_data() {
  text_ += "EOD\n";
}

void PlotScript::place(const Box& box) {
  box_ = box;
  add("unset label");
  add("set lmargin at screen {:.6f}", box.left_px / width_px_);
  add("set rmargin at screen {:.6f}", (box.left_px + box.width_px) / width_px_);
  add("set bmargin at screen {:.6f}", box.bottom_px / height_px_);
  add("set tmargin at screen {:.6f}", (box.bottom_px + box.height_px) / height_px_);
}

void PlotScript::x_title(std::string_view text) {
  constexpr double below_px = 80.0;
  add("set label {} at screen {:.6f},{:.6f} center noenhanced", plot_quoted(text),
      (box_.left_px + 0.5 * box_.width_px) / width_px_, (box_.bottom_px - below_px) / height_px_);
}

void PlotScript::y_title(std::string_view text) {
  constexpr double beside_px = 100.0;
  upright(text, box_.left_px - beside_px, box_.bottom_px + 0.5 * box_.height_px);
}

void PlotScript::headline(std::string_view text, double y_px, int size_pt, std::size_t longest) {
  add("set label {} at screen 0.5,{:.6f} center noenhanced font ',{}' textcolor '#101010'", plot_quoted(text, longest),
      1.0 - y_px / height_px_, size_pt);
}

void PlotScript::notice(std::string_view text) {
  add("set label {} at graph 0.5,0.5 center noenhanced", plot_quoted(text));
}

void PlotScript::upright(std::string_view text, double x_px, double y_px) {
  add("set label {} at screen {:.6f},{:.6f} center rotate by 90 noenhanced", plot_quoted(text), x_px / width_px_,
      y_px / height_px_);
}

void PlotScript::legend(double x_px, double y_px, std::size_t columns) {
  add("set key at screen {:.6f},{:.6f} left top horizontal maxcols {} Left reverse noenhanced samplen 2 font ',19'",
      x_px / width_px_, 1.0 - y_px / height_px_, columns);
}

void PlotScript::no_legend() {
  add("unset key");
}

}  // namespace sunfleck
