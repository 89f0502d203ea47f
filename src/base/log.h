#pragma once
// Messages of the running program: lines on standard error, and a progress line.

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace sunfleck {

enum class Verbosity { silent, quiet, normal };

// Sets up the log on standard error. `quiet` prints only warnings and errors, `silent` nothing at all.
void start_log(Verbosity verbosity);

void say(std::string_view line);   // prints a plain line
void warn(std::string_view line);  // prints the line after "warning: "

// The progress of a long task: a bar redrawn in place on a terminal, plain lines every few seconds elsewhere, nothing when
// quiet.
class ProgressLine {
 public:
  explicit ProgressLine(std::string task);
  ~ProgressLine();  // ends the line, if there is one, with the latest state
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  struct State {
    std::uint64_t rays = 0;
    double fraction = 0.0;                 // completed part, 0..1, as forecast; a falling value is not shown
    std::optional<double> seconds_left;    // empty: the remaining time is extrapolated from the elapsed time
    std::optional<double> relative_error;  // reached so far
    std::optional<double> bound;
    std::string_view error_of;  // what the error belongs to, a literal; may be empty
    std::string_view stage;     // a literal, shown in place of the completed part while that is unknown
  };
  // Takes a new state; cheap. Draws at most ten times a second (every five seconds without a terminal).
  void update(const State& state);

 private:
  void draw_bar(std::chrono::steady_clock::time_point now);

  std::string task_;
  std::chrono::steady_clock::time_point start_, last_draw_;
  State state_;
  bool drawn_ = false;
};

// Returns the text of a progress line: "simulating [####....] 45 %, 12.3 M rays, direct error 0.0012 of 0.0010, 8 s left",
// or with a stage "simulating, pilot, 0.3 M rays" and the error. The bar is left out if bar_width is 0; the time left is left
// out below one percent and at the end; the error is left out if it is unknown.
[[nodiscard]] std::string progress_text(std::string_view task, const ProgressLine::State& state, double elapsed_s,
                                        int bar_width);

// Returns that text in at most as many columns: the bar gets shorter, then is left out, then the error is; only what remains is
// cut.
[[nodiscard]] std::string fitted_progress_text(std::string_view task, ProgressLine::State state, double elapsed_s,
                                               std::size_t columns);

}  // namespace sunfleck
