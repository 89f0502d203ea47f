#pragma once
// Builds the text of a gnuplot script: the common parts of all plots, and safe ways to insert text and numbers.

#include <fmt/format.h>

#include <cstddef>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace sunfleck {

// Colours that readers with any colour vision can tell apart; the dashes separate the curves in grey prints (Okabe and Ito
// 2008, Color Universal Design).
inline constexpr const char* plot_colours[] = {"#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9"};

// Returns the user's text as a gnuplot string: in single quotes, where gnuplot substitutes nothing, on one line of valid UTF-8
// with at most `longest` characters ("…" replaces the rest). Single quotes and backquotes in the text become typographic ones,
// so that none can end the string: gnuplot 5.4 misreads a doubled quote, which should stand for one.
[[nodiscard]] std::string plot_quoted(std::string_view text, std::size_t longest = 90);

// Returns the distance between the labels of an axis `length_px` long that spans `range`: 1, 2 or 5 times a power of ten, such
// that labels are at least `room_px` apart.
[[nodiscard]] double tic_step(double range, double length_px, double room_px);

class PlotScript {
 public:
  PlotScript(int width_px, int height_px);

  // Adds one command; any text from a user must have gone through plot_quoted.
  template <class... Arguments>
  void add(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
    text_ += fmt::format(format, std::forward<Arguments>(arguments)...);
    text_ += '\n';
  }

  // Write `$name << EOD`, rows, and the end of the data. The plot skips NaN and infinity.
  void begin_data(std::string_view name);
  void row(std::span<const double> numbers);
  void row(std::initializer_list<double> numbers) { row(std::span<const double>(numbers.begin(), numbers.size())); }
  void gap();  // writes an empty line, which interrupts the curves
  void end_data();

  // The rectangle of the next plot, in pixels from the lower left corner of the picture. Placing it removes the labels of
  // earlier plots.
  struct Box {
    double left_px = 0.0, bottom_px = 0.0, width_px = 0.0, height_px = 0.0;
  };
  void place(const Box& box);
  // Set the axis titles: under the box, and upright to its left.
  void x_title(std::string_view text);
  void y_title(std::string_view text);
  // Adds a line of text across the whole picture, centred `y_px` below its upper edge.
  void headline(std::string_view text, double y_px, int size_pt, std::size_t longest);
  // Adds text in the middle of the box, for a plot without data.
  void notice(std::string_view text);
  // Adds upright text centred at this point.
  void upright(std::string_view text, double x_px, double y_px);
  // Gives the following plots a legend with this many columns; x and y are its upper left corner, in pixels from that of the
  // picture.
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
