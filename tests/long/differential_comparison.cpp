#include "long/differential_comparison.h"

#include "support/comparison.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace sunfleck::test::differential {
namespace {

// Below this relative error a figure is traced well enough to count in the root mean square of z: it has at least 400 landings
// of equal weight, a quarter of them in the program's run. Rarer figures do not scatter as Student's t does.
constexpr double well_traced = 0.05;
// A run of the program has a quarter of the tracer's paths, so its error is at least twice the traced one, whatever its few
// landings suggest.
constexpr double rare_error = 2.0;
// Above this relative error nothing can be concluded.
constexpr double too_rare = 0.25;
// Below this relative spread the batches differ only by rounding.
constexpr double no_spread = 1e-9;
// Corners, rays and quanta are rounded to this share of a value.
constexpr double rounded = 4e-6;
constexpr double least_rms = 0.9;
constexpr double most_rms = 1.1;
constexpr double chance = 0.001;  // probability of a false alarm
constexpr std::size_t most_named = 10;

}  // namespace

void Comparison::add(const std::string& name, const Stated& program, const Stated& traced) {
  if (std::isnan(traced.value)) {
    EXPECT_TRUE(std::isnan(program.value)) << name << ": the program states " << program.value << ", there is nothing to tell";
    ++empty_;
    return;
  }
  const double size = std::abs(traced.value);
  if (std::isnan(program.value) || std::isnan(program.error)) {
    // The program states nothing where too few rays could land, or where none did.
    EXPECT_TRUE(size == 0.0 || traced.error > 0.5 * well_traced * size) << name << ": nothing is stated of " << traced.value;
    ++untold_;
    return;
  }
  if (traced.error <= no_spread * size) {
    exact_.push_back({name, program, traced.value});
    return;
  }
  if (traced.error > too_rare * size) {
    ++untold_;
    return;
  }
  const bool is_rare = traced.error > well_traced * size;
  const double program_error = is_rare ? std::max(program.error, rare_error * traced.error) : program.error;
  const double error = std::hypot(program_error, traced.error, rounded * size);
  deviations_.push_back({name, (program.value - traced.value) / error, program.value, traced.value, is_rare});
}

// Checks figures on which all rays agreed. The program's interval is then what may have escaped its rays: 3.69 of them at 95 %,
// and more at the small probability that so many comparisons leave to each.
void Comparison::expect_exact_ones(std::size_t count) const {
  const double events = -std::log(0.5 * chance / static_cast<double>(count));
  std::size_t apart = 0;
  for (const Exact& figure : exact_) {
    const double half_width = figure.program.error * quantile_ * events / unseen_events(0.95);
    const double off = std::abs(figure.program.value - figure.traced);
    if (off <= half_width + rounded * std::abs(figure.traced) || ++apart > most_named) continue;
    ADD_FAILURE() << figure.name << ": " << figure.program.value << " +- " << half_width << ", traced " << figure.traced;
  }
  EXPECT_EQ(apart, 0U);
}

// Expects no deviation beyond the limit; names the first few that exceed it.
void Comparison::expect_none_beyond(double limit) const {
  std::size_t beyond = 0;
  for (const Deviation& deviation : deviations_) {
    if (std::abs(deviation.z) <= limit || ++beyond > most_named) continue;
    ADD_FAILURE() << deviation.name << ": " << deviation.program << ", traced " << deviation.traced << ", z " << deviation.z
                  << (deviation.is_rare ? ", rare" : "");
  }
  EXPECT_EQ(beyond, 0U);
}

void Comparison::expect_agreement(const std::string& kind) const {
  double squares = 0.0;
  double count = 0.0;
  Deviation largest;
  for (const Deviation& deviation : deviations_) {
    if (!deviation.is_rare) {
      squares += deviation.z * deviation.z;
      count += 1.0;
    }
    if (std::abs(deviation.z) > std::abs(largest.z)) largest = deviation;
  }
  const std::size_t all = deviations_.size() + exact_.size();
  const double limit = t_quantile(std::pow(1.0 - chance, 1.0 / static_cast<double>(all)), replicates_);
  const double rms = std::sqrt(squares / count);
  std::printf(
      "%s: rms z %.3f of %.0f, largest |z| %.2f of %zu, limit %.2f (%s: %.6g, traced %.6g); %zu exact, %zu untold, %zu empty\n",
      kind.c_str(), rms, count, std::abs(largest.z), deviations_.size(), limit, largest.name.c_str(), largest.program,
      largest.traced, exact_.size(), untold_, empty_);
  EXPECT_GE(rms, least_rms);
  EXPECT_LE(rms, most_rms);
  expect_none_beyond(limit);
  expect_exact_ones(all);
}

}  // namespace sunfleck::test::differential
