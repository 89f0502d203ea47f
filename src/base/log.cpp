#include "base/log.h"

#include <fmt/format.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <memory>

namespace sunfleck {
namespace {

using namespace std::chrono_literals;
using std::chrono::steady_clock;

constexpr std::array bar_widths = {16, 8, 0};
constexpr const char* clear_line = "\r\x1b[K";  // to the first column, erase to the end (ECMA-48)

bool on_terminal() {
  return isatty(STDERR_FILENO) == 1;
}

bool quiet() {
  return !spdlog::should_log(spdlog::level::info);
}

// Clears the line on a terminal: if it holds a progress bar the text replaces it, and the bar is drawn again below.
std::string on_own_line(std::string_view line) {
  return fmt::format("{}{}", on_terminal() ? clear_line : "", line);
}

std::size_t terminal_columns() {
  winsize size{};
  return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

std::string count_text(std::uint64_t rays) {
  if (rays >= 1'000'000'000) return fmt::format("{:.2f} G rays", static_cast<double>(rays) * 1e-9);
  return fmt::format("{:.1f} M rays", static_cast<double>(rays) * 1e-6);
}

// Returns ", direct error 0.0012 of 0.001"; empty if the error is unknown.
std::string error_text(const ProgressLine::State& state) {
  if (!state.relative_error || !std::isfinite(*state.relative_error)) return "";
  std::string text =
      fmt::format(", {}{}error {:.2g}", state.error_of, state.error_of.empty() ? "" : " ", *state.relative_error);
  if (state.bound) text += fmt::format(" of {:.2g}", *state.bound);
  return text;
}

std::string duration_text(double seconds) {
  if (seconds >= 1e9) return "years";
  const auto whole = static_cast<long>(std::ceil(seconds));
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
  return fmt::format("{} h {:02} min", whole / 3600, whole / 60 % 60);
}

}  // namespace

void start_log(Verbosity verbosity) {
  auto logger = std::make_shared<spdlog::logger>("sunfleck", std::make_shared<spdlog::sinks::stderr_sink_mt>());
  logger->set_pattern("%v");
  logger->set_level(verbosity == Verbosity::normal  ? spdlog::level::info
                    : verbosity == Verbosity::quiet ? spdlog::level::warn
                                                    : spdlog::level::off);
  spdlog::set_default_logger(std::move(logger));
}

void say(std::string_view line) {
  if (!quiet()) spdlog::info("{}", on_own_line(line));
}

void warn(std::string_view line) {
  spdlog::warn("{}", on_own_line(fmt::format("warning: {}", line)));
}

ProgressLine::ProgressLine(std::string task) : task_(std::move(task)), start_(steady_clock::now()), last_draw_(start_) {}

ProgressLine::~ProgressLine() {
  if (!drawn_) return;
  draw_bar(steady_clock::now());
  std::fputc('\n', stderr);
}

void ProgressLine::update(const State& state) {
  const double furthest = state_.fraction;
  state_ = state;
  if (state_.fraction < furthest) state_.fraction = furthest;
  if (quiet()) return;
  const bool terminal = on_terminal();
  const auto now = steady_clock::now();
  if (now - last_draw_ < (terminal ? 100ms : 5000ms)) return;
  last_draw_ = now;
  if (terminal) {
    draw_bar(now);
    drawn_ = true;
  } else {
    say(progress_text(task_, state_, std::chrono::duration<double>(now - start_).count(), 0));
  }
}

void ProgressLine::draw_bar(steady_clock::time_point now) {
  const double elapsed_s = std::chrono::duration<double>(now - start_).count();
  const std::string text =
      fitted_progress_text(task_, state_, elapsed_s, terminal_columns() - 1);  // a wrapped line could not be redrawn
  std::fprintf(stderr, "%s%s", clear_line, text.c_str());
  std::fflush(stderr);
}

std::string progress_text(std::string_view task, const ProgressLine::State& state, double elapsed_s, int bar_width) {
  const double fraction = std::isfinite(state.fraction) ? std::clamp(state.fraction, 0.0, 1.0) : 0.0;
  std::string text(task);
  if (!state.stage.empty()) return fmt::format("{}, {}, {}{}", task, state.stage, count_text(state.rays), error_text(state));
  if (bar_width > 0) {
    const int full = static_cast<int>(fraction * bar_width);
    text += fmt::format(" [{}{}]", std::string(full, '#'), std::string(bar_width - full, '.'));
  }
  text += fmt::format(" {} %, {}{}", static_cast<int>(100.0 * fraction), count_text(state.rays), error_text(state));
  if (fraction >= 0.01 && fraction < 1.0) {
    const double left_s = state.seconds_left.value_or(elapsed_s * (1.0 - fraction) / fraction);
    text += fmt::format(", {} left", duration_text(left_s));
  }
  return text;
}

std::string fitted_progress_text(std::string_view task, ProgressLine::State state, double elapsed_s, std::size_t columns) {
  std::string text;
  for (const int bar_width : bar_widths) {
    text = progress_text(task, state, elapsed_s, bar_width);
    if (text.size() <= columns) return text;
  }
  state.relative_error.reset();
  text = progress_text(task, state, elapsed_s, 0);
  if (text.size() > columns) text.resize(columns);
  return text;
}

}  // namespace sunfleck
