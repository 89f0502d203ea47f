#include "base/log.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>

namespace sunfleck {
namespace {

TEST(progress_text, says_what_is_done_and_what_is_left) {
  const ProgressLine::State state{.rays = 12'345'678, .fraction = 0.25, .relative_error = 0.00234, .bound = 0.001};
  EXPECT_EQ(progress_text("direct", state, 10.0, 0), "direct 25 %, 12.3 M rays, error 0.0023 of 0.001, 30 s left");
  EXPECT_EQ(progress_text("direct", state, 10.0, 8), "direct [##......] 25 %, 12.3 M rays, error 0.0023 of 0.001, 30 s left");
}

TEST(progress_text, names_a_stage_and_its_error) {
  ProgressLine::State state{.rays = 12'300'000};
  state.stage = "sensors";
  EXPECT_EQ(progress_text("simulating", state, 10.0, 8), "simulating, sensors, 12.3 M rays");
  state.relative_error = 0.0234;
  state.bound = 0.01;
  state.error_of = "sensors";
  EXPECT_EQ(progress_text("simulating", state, 10.0, 8), "simulating, sensors, 12.3 M rays, sensors error 0.023 of 0.01");
}

TEST(progress_text, leaves_out_what_is_not_known) {
  EXPECT_EQ(progress_text("direct", {}, 3.0, 0), "direct 0 %, 0.0 M rays");
  EXPECT_EQ(progress_text("direct", {.rays = 2'500'000'000, .fraction = 1.0}, 3.0, 4), "direct [####] 100 %, 2.50 G rays");
  EXPECT_EQ(progress_text("direct", {.fraction = 0.5, .relative_error = 0.5}, 3.0, 0),
            "direct 50 %, 0.0 M rays, error 0.5, 3 s left");
}

TEST(progress_text, writes_long_times_in_larger_units) {
  EXPECT_NE(progress_text("d", {.fraction = 0.5}, 125.0, 0).find("2 min 05 s left"), std::string::npos);
  EXPECT_NE(progress_text("d", {.fraction = 0.5}, 7500.0, 0).find("2 h 05 min left"), std::string::npos);
  EXPECT_NE(progress_text("d", {.fraction = 0.5}, 1e30, 0).find("years left"), std::string::npos);
}

TEST(progress_text, stands_odd_fractions) {
  EXPECT_EQ(progress_text("d", {.fraction = 1.7}, 1.0, 2), "d [##] 100 %, 0.0 M rays");
  EXPECT_EQ(progress_text("d", {.fraction = -1.0}, 1.0, 2), "d [..] 0 %, 0.0 M rays");
  EXPECT_EQ(progress_text("d", {.fraction = std::numeric_limits<double>::quiet_NaN()}, 1.0, 2), "d [..] 0 %, 0.0 M rays");
}

TEST(progress_text, fits_into_the_columns_of_a_terminal_without_cutting_a_number) {
  const ProgressLine::State state{.rays = 4'600'000,
                                  .fraction = 0.5,
                                  .seconds_left = 123.0,
                                  .relative_error = 0.0016,
                                  .bound = 0.0015,
                                  .error_of = "indirect"};
  const auto fitted = [&](std::size_t columns) { return fitted_progress_text("simulating", state, 3.0, columns); };
  EXPECT_EQ(fitted(119), "simulating [########........] 50 %, 4.6 M rays, indirect error 0.0016 of 0.0015, 2 min 03 s left");
  EXPECT_EQ(fitted(90), "simulating [####....] 50 %, 4.6 M rays, indirect error 0.0016 of 0.0015, 2 min 03 s left");
  EXPECT_EQ(fitted(79), "simulating 50 %, 4.6 M rays, indirect error 0.0016 of 0.0015, 2 min 03 s left");
  EXPECT_EQ(fitted(59), "simulating 50 %, 4.6 M rays, 2 min 03 s left");
  EXPECT_EQ(fitted(15), "simulating 50 %");
}

TEST(log, goes_to_standard_error_only) {
  testing::internal::CaptureStderr();
  testing::internal::CaptureStdout();
  start_log(Verbosity::normal);
  say("two {} braces");
  warn("careful");
  const std::string output = testing::internal::GetCapturedStdout();
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "two {} braces\nwarning: careful\n");
  EXPECT_EQ(output, "");
}

TEST(log, says_only_warnings_when_quiet) {
  testing::internal::CaptureStderr();
  start_log(Verbosity::quiet);
  say("not heard");
  warn("heard");
  {
    ProgressLine progress("direct");
    progress.update({.rays = 1, .fraction = 0.5});
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "warning: heard\n");
}

}  // namespace
}  // namespace sunfleck
