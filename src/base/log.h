#pragma once
// What the program says while it works: lines on standard error, and a progress line.

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace sunfleck {

enum class Verbosity { silent, quiet, normal };

// Sets up the log on standard error. Quiet says nothing but warnings and errors, silent nothing at all.
void start_log(Verbosity verbosity);

void say(std::string_view line);   // plain line
void warn(std::string_view line);  // "warning: " before it

// Long work: a bar that is redrawn in place on a terminal, plain lines every few seconds elsewhere, nothing when quiet.
class ProgressLine {
 public:
  explicit ProgressLine(std::string task);
  ~ProgressLine();  // ends the line, where there is one, with the last state given
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  struct State {
    std::uint64_t rays = 0;
    double fraction = 0.0;                 // done, 0..1, as far as it can be foreseen; one that falls is not shown
    std::optional<double> seconds_left;    // none: as long as what is done took, in proportion
    std::optional<double> relative_error;  // reached so far
    std::optional<double> bound;
    std::string_view error_of;  // what the error belongs to, a literal; may be empty
    std::string_view stage;     // of work that has no measure yet, a literal: shown in place of the part that is done
  };
  // Cheap; draws at most ten times a second (every five seconds without a terminal).
  void update(const State& state);

 private:
  void draw_bar(std::chrono::steady_clock::time_point now);

  std::string task_;
  std::chrono::steady_clock::time_point start_, last_draw_;
  State state_;
  bool drawn_ = false;
};

// The text of a progress line: "simulating [####....] 45 %, 12.3 M rays, direct error 0.0012 of 0.0010, 8 s left", or with a
// stage "simulating, pilot, 0.3 M rays". Without a bar where bar_width is 0; without time left before a hundredth is done and
// at the end; without an error where none is known.
[[nodiscard]] std::string progress_text(std::string_view task, const ProgressLine::State& state, double elapsed_s,
                                        int bar_width);

}  // namespace sunfleck
