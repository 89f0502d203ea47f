#include "physics/light/sky.h"

#include "base/check.h"
#include "base/error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

namespace sunfleck {

namespace {

constexpr double full_turn = 2.0 * std::numbers::pi;
constexpr double row_height_rad = std::numbers::pi / 2.0 / Sky::rows;
constexpr double column_width_rad = full_turn / Sky::columns;

double squared_sine(int row) {
  const double sine = std::sin(row * row_height_rad);
  return row == Sky::rows ? 1.0 : sine * sine;
}

double cosine(int row) {
  return row == Sky::rows ? 0.0 : std::cos(row * row_height_rad);
}

glm::dvec3 direction(double cos_zenith, double azimuth_rad) {
  const double y = std::max(cos_zenith, least_sky_sine);
  const double level = std::sqrt(std::max(0.0, 1.0 - y * y));
  return {-level * std::cos(azimuth_rad), y, -level * std::sin(azimuth_rad)};
}

// Replaces the values by their cumulative sums divided by the total, so that the last one is 1. Returns the total.
double accumulate_shares(std::span<double> values) {
  std::inclusive_scan(values.begin(), values.end(), values.begin());
  const double total = values.back();
  if (total > 0.0)
    for (double& value : values) value /= total;
  values.back() = 1.0;
  return total;
}

struct InvertedDraw {
  std::size_t index = 0;
  double fraction = 0.0;  // position within the chosen entry, 0..1
};

// Inverts cumulative shares. An entry without any share is never drawn.
InvertedDraw invert(std::span<const double> cumulative, double u) {
  const auto found = std::upper_bound(cumulative.begin(), cumulative.end() - 1, u);
  const auto index = static_cast<std::size_t>(found - cumulative.begin());
  const double below = index == 0 ? 0.0 : cumulative[index - 1];
  const double share = cumulative[index] - below;
  return {index, share > 0.0 ? std::clamp((u - below) / share, 0.0, 1.0) : 0.5};
}

// Gauss-Legendre rules with three and with two points on 0..1.
constexpr std::array<double, 3> three_points{0.1127016653792583, 0.5, 0.8872983346207417};
constexpr std::array<double, 3> three_weights{5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};
constexpr std::array<double, 2> two_points{0.2113248654051871, 0.7886751345948129};

// Sets the radiance of one row's cells: means over each cell weighted with the cosine of the zenith angle, that is, plain
// means over squared sine and azimuth.
void fill_row(int row, const SkyShape& shape, const SunPosition& sun, std::span<double> radiance) {
  const double lower = squared_sine(row), upper = squared_sine(row + 1);
  const double sun_elevation = std::clamp(sun.elevation_rad, 0.0, std::numbers::pi / 2.0);
  for (std::size_t i = 0; i < three_points.size(); ++i) {
    const double squared = lower + (upper - lower) * three_points[i];
    const double cos_zenith = std::sqrt(1.0 - squared);
    const double weight = three_weights[i] * shape.gradation(cos_zenith) / two_points.size();
    const double upright = cos_zenith * std::sin(sun_elevation);
    const double level = std::sqrt(squared) * std::cos(sun_elevation);
    for (int column = 0; column < Sky::columns; ++column)
      for (const double point : two_points) {
        const double azimuth = (column + point) * column_width_rad - sun.azimuth_rad;
        radiance[static_cast<std::size_t>(column)] += weight * shape.indicatrix(upright + level * std::cos(azimuth));
      }
  }
}

}  // namespace

Sky::Sky(const SkyModel& model, const std::optional<SunPosition>& sun) {
  EXPECT(sun.has_value() || !model.follows_sun(), ==, true);
  if (model.kind == SkyKind::lights) {
    take_lights(model.lights);
  } else {
    const SunPosition at = sun.value_or(SunPosition{});
    take_shape(sky_shape(model, at), at);
  }
}

void Sky::take_lights(const std::vector<SkyLight>& lights) {
  double total = 0.0;
  for (const SkyLight& light : lights) {
    EXPECT(light.weight, >=, 0.0);
    EXPECT(light.to_sky.y, >=, least_sky_sine);
    total += light.weight;
  }
  if (!(total > 0.0)) throw_input("sky: no light", "the list's weights are all zero", "give one direction a weight above 0");
  for (SkyLight light : lights) {
    if (light.weight == 0.0) continue;
    light.weight /= total;
    lights_.push_back(light);
    light_cosine_.push_back(light.weight);
    light_plain_.push_back(light.weight / light.to_sky.y);
  }
  accumulate_shares(light_cosine_);
  spherical_ = accumulate_shares(light_plain_);
}

void Sky::take_shape(const SkyShape& shape, const SunPosition& sun) {
  radiance_.assign(std::size_t{rows} * columns, 0.0);
  for (int row = 0; row < rows; ++row) {
    fill_row(row, shape, sun, std::span(radiance_).subspan(static_cast<std::size_t>(row) * columns, columns));
  }
  take_radiance();
}

void Sky::take_radiance() {
  column_.resize(radiance_.size());
  row_cosine_.resize(rows);
  row_plain_.resize(rows);
  for (int row = 0; row < rows; ++row) {
    const std::size_t first = static_cast<std::size_t>(row) * columns;
    const std::span<const double> radiance(&radiance_[first], columns);
    const std::span<double> shares(&column_[first], columns);
    std::copy(radiance.begin(), radiance.end(), shares.begin());
    const double sum = accumulate_shares(shares);
    const auto index = static_cast<std::size_t>(row);
    row_cosine_[index] = sum * (squared_sine(row + 1) - squared_sine(row)) / 2.0 * column_width_rad;
    row_plain_[index] = sum * (cosine(row) - cosine(row + 1)) * column_width_rad;
  }
  const double horizontal = accumulate_shares(row_cosine_);
  ENSURE(horizontal, >, 0.0);
  spherical_ = accumulate_shares(row_plain_) / horizontal;
  for (double& value : radiance_) value /= horizontal;
}

Sky Sky::mean_of(std::span<const Sky> skies) {
  Sky mean;
  if (skies.front().is_list()) return skies.front();
  mean.radiance_.assign(std::size_t{rows} * columns, 0.0);
  for (const Sky& sky : skies) {
    EXPECT(sky.radiance_.size(), ==, mean.radiance_.size());
    for (std::size_t cell = 0; cell < sky.radiance_.size(); ++cell) mean.radiance_[cell] += sky.radiance_[cell];
  }
  mean.take_radiance();
  return mean;
}

std::size_t Sky::cell_of(const glm::dvec3& to_sky) {
  const double zenith = std::atan2(std::hypot(to_sky.x, to_sky.z), to_sky.y);
  double azimuth = std::atan2(-to_sky.z, -to_sky.x);
  if (azimuth < 0.0) azimuth += full_turn;
  const int row = std::min(static_cast<int>(zenith / row_height_rad), rows - 1);
  const int column = std::min(static_cast<int>(azimuth / column_width_rad), columns - 1);
  return static_cast<std::size_t>(row) * columns + static_cast<std::size_t>(column);
}

double Sky::radiance(const glm::dvec3& to_sky) const {
  EXPECT(radiance_.size(), >, std::size_t{0});
  return to_sky.y > 0.0 ? radiance_[cell_of(to_sky)] : 0.0;
}

glm::dvec3 Sky::draw_by_horizontal_irradiance(double u, double v) const {
  if (is_list()) return lights_[invert(light_cosine_, u).index].to_sky;
  const InvertedDraw row = invert(row_cosine_, u);
  const int upper = static_cast<int>(row.index);
  const double squared = std::lerp(squared_sine(upper), squared_sine(upper + 1), row.fraction);
  return direction(std::sqrt(std::max(0.0, 1.0 - squared)), azimuth_in_row(row.index, v));
}

glm::dvec3 Sky::draw_by_radiance(double u, double v) const {
  if (is_list()) return lights_[invert(light_plain_, u).index].to_sky;
  const InvertedDraw row = invert(row_plain_, u);
  const int upper = static_cast<int>(row.index);
  return direction(std::lerp(cosine(upper), cosine(upper + 1), row.fraction), azimuth_in_row(row.index, v));
}

double Sky::azimuth_in_row(std::size_t row, double v) const {
  const InvertedDraw column = invert(std::span(column_).subspan(row * columns, columns), v);
  return (static_cast<double>(column.index) + column.fraction) * column_width_rad;
}

}  // namespace sunfleck
