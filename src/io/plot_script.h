#pragma once
// The text of a gnuplot script: what all our plots have in common, and safe ways to put text and numbers into it.

#include <fmt/format.h>

#include <cstddef>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace sunfleck {

// Colours that readers with any colour vision, and grey prints with the dashes beside them, tell apart (Okabe and Ito 2008,
// Color Universal Design).
inline constexpr const char* plot_colours[] = {"#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9"};

// User's text as a gnuplot string: in single quotes, where nothing is substituted, on one line, valid UTF-8, and no more than
// `longest` characters ("…" for the rest). Single quotes and backquotes of the text become typographic ones, so that none can
// end the string: gnuplot 5.4 misreads the doubled quote that is to stand for one.
[[nodiscard]] std::string plot_quoted(std::string_view text, std::size_t longest = 90);

// Of an axis `length_px` long that spans `range`: the distance of labels, 1, 2 or 5 times a power of ten, so that they stand
// at least `room_px` apart.
[[nodiscard]] double tic_step(double range, double length_px, double room_px);

class PlotScript {
 public:
  PlotScript(int width_px, int height_px);

  // One command; everything in it that a user wrote went through plot_quoted.
  template <class... Arguments>
  void add(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
    text_ += fmt::format(format, std::forward<Arguments>(arguments)...);
    text_ += '\n';
  }

  // `$name << EOD`, rows, `end_data`. Not a number and infinity are left out by the plot.
  void begin_data(std::string_view name);
  void row(std::span<const double> numbers);
  void row(std::initializer_list<double> numbers) { row(std::span<const double>(numbers.begin(), numbers.size())); }
  void gap();  // an empty line: curves are interrupted
  void end_data();

  // The rectangle of the next plot, in pixels from the picture's lower left corner. Labels of earlier plots go.
  struct Box {
    double left_px = 0.0, bottom_px = 0.0, width_px = 0.0, height_px = 0.0;
  };
  void place(const Box& box);
  // Under the box, and upright to its left.
  void x_title(std::string_view text);
  void y_title(std::string_view text);
  // A line of text over the whole picture, its middle `y_px` below the picture's upper edge.
  void headline(std::string_view text, double y_px, int size_pt, std::size_t longest);
  // Text in the middle of the box, where there is nothing to draw.
  void notice(std::string_view text);
  // Upright text, its middle there.
  void upright(std::string_view text, double x_px, double y_px);
  // From now on plots have a legend: columns of entries, its upper left corner there, in pixels from the picture's.
  void legend(double x_px, double y_px, std::size_t columns);
  void no_legend();

  [[nodiscard]] int width_px() const { return width_px_; }
  [[nodiscard]] int height_px() const { return height_px_; }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  int width_px_, height_px_;
  Box box_;
  std::string text_;
};

}  // namespace sunfleck
