#include "physics/light/sky_model.h"

#include "base/check.h"
#include "base/units.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace sunfleck {

namespace {

// ISO 15469:2004 (CIE S 011/E:2003), table 1: standard parameters of types 1 to 15, without the offset, which follows from d.
constexpr std::array<SkyShape, 15> standard_types{{
    {4.0, -0.70, 0.0, -1.0, 0.0},     // 1 overcast, steep gradation, azimuthal uniformity
    {4.0, -0.70, 2.0, -1.5, 0.15},    // 2
    {1.1, -0.80, 0.0, -1.0, 0.0},     // 3
    {1.1, -0.80, 2.0, -1.5, 0.15},    // 4
    {0.0, -1.0, 0.0, -1.0, 0.0},      // 5 uniform
    {0.0, -1.0, 2.0, -1.5, 0.15},     // 6
    {0.0, -1.0, 5.0, -2.5, 0.30},     // 7
    {0.0, -1.0, 10.0, -3.0, 0.45},    // 8
    {-1.0, -0.55, 2.0, -1.5, 0.15},   // 9
    {-1.0, -0.55, 5.0, -2.5, 0.30},   // 10
    {-1.0, -0.55, 10.0, -3.0, 0.45},  // 11
    {-1.0, -0.32, 10.0, -3.0, 0.45},  // 12 clear, low turbidity
    {-1.0, -0.32, 16.0, -3.0, 0.30},  // 13 clear, polluted
    {-1.0, -0.15, 16.0, -3.0, 0.30},  // 14
    {-1.0, -0.15, 24.0, -2.8, 0.15},  // 15
}};

// Perez, Seals and Michalsky 1993, table 1: x1 x2 x3 x4 of each of the parameters a, b, c, d, e, by bin of clearness.
using BinTable = std::array<std::array<double, 4>, 5>;
constexpr std::array<BinTable, 8> all_weather_bins{{
    {{{1.3525, -0.2576, -0.2690, -1.4366},
      {-0.7670, 0.0007, 1.2734, -0.1233},
      {2.8000, 0.6004, 1.2375, 1.0000},
      {1.8734, 0.6297, 0.9738, 0.2809},
      {0.0356, -0.1246, -0.5718, 0.9938}}},
    {{{-1.2219, -0.7730, 1.4148, 1.1016},
      {-0.2054, 0.0367, -3.9128, 0.9156},
      {6.9750, 0.1774, 6.4477, -0.1239},
      {-1.5798, -0.5081, -1.7812, 0.1080},
      {0.2624, 0.0672, -0.2190, -0.4285}}},
    {{{-1.1000, -0.2515, 0.8952, 0.0156},
      {0.2782, -0.1812, -4.5000, 1.1766},
      {24.7219, -13.0812, -37.7000, 34.8438},
      {-5.0000, 1.5218, 3.9229, -2.6204},
      {-0.0156, 0.1597, 0.4199, -0.5562}}},
    {{{-0.5484, -0.6654, -0.2672, 0.7117},
      {0.7234, -0.6219, -5.6812, 2.6297},
      {33.3389, -18.3000, -62.2500, 52.0781},
      {-3.5000, 0.0016, 1.1477, 0.1062},
      {0.4659, -0.3296, -0.0876, -0.0329}}},
    {{{-0.6000, -0.3566, -2.5000, 2.3250},
      {0.2937, 0.0496, -5.6812, 1.8415},
      {21.0000, -4.7656, -21.5906, 7.2492},
      {-3.5000, -0.1554, 1.4062, 0.3988},
      {0.0032, 0.0766, -0.0656, -0.1294}}},
    {{{-1.0156, -0.3670, 1.0078, 1.4051},
      {0.2875, -0.5328, -3.8500, 3.3750},
      {14.0000, -0.9999, -7.1406, 7.5469},
      {-3.4000, -0.1078, -1.0750, 1.5702},
      {-0.0672, 0.4016, 0.3017, -0.4844}}},
    {{{-1.0000, 0.0211, 0.5025, -0.5119},
      {-0.3000, 0.1922, 0.7023, -1.6317},
      {19.0000, -5.0000, 1.2438, -1.9094},
      {-4.0000, 0.0250, 0.3844, 0.2656},
      {1.0468, -0.3788, -2.4517, 1.4656}}},
    {{{-1.0500, 0.0289, 0.4260, 0.3590},
      {-0.3250, 0.1156, 0.7781, 0.0025},
      {31.0625, -14.5000, -46.1148, 55.3750},
      {-7.2312, 0.4050, 13.3500, 0.6234},
      {1.5000, -0.6426, 1.8564, 0.5636}}},
}};
constexpr std::array<double, 7> bin_edges{1.065, 1.230, 1.500, 1.950, 2.800, 4.500, 6.200};

// The range to which the table was fitted; Radiance's gendaylit keeps to the same limits.
constexpr double most_clearness = 12.01;
constexpr double least_brightness = 0.01, most_brightness = 0.6;
constexpr double least_brightness_bins_2_to_5 = 0.2;  // below it their gradation turns over (gendaylit uses the same limit)
constexpr double extraterrestrial_w_m2 = 1367.0;
constexpr double largest_b = -0.01;  // a positive b would make the horizon infinite

// Kasten and Young 1989, eq. 3.
double air_mass_at_zenith(double zenith_rad) {
  const double zenith_deg = in_degrees(zenith_rad);
  return 1.0 / (std::cos(zenith_rad) + 0.50572 * std::pow(96.07995 - zenith_deg, -1.6364));
}

double zenith_angle_rad(const SunPosition& sun) {
  return std::clamp(std::numbers::pi / 2.0 - sun.elevation_rad, 0.0, std::numbers::pi / 2.0);
}

double linear(const std::array<double, 4>& x, double zenith_rad, double brightness) {
  return x[0] + x[1] * zenith_rad + brightness * (x[2] + x[3] * zenith_rad);
}

SkyShape standard_shape(int type) {
  EXPECT(type, >=, 1);
  EXPECT(type, <=, 15);
  SkyShape shape = standard_types[static_cast<std::size_t>(type - 1)];
  shape.offset = std::exp(shape.d * std::numbers::pi / 2.0);
  return shape;
}

}  // namespace

double SkyShape::gradation(double cos_zenith) const {
  if (overcast > 0.0) return 1.0 + overcast * cos_zenith;
  return std::max(0.0, 1.0 + a * std::exp(b / std::max(cos_zenith, 1e-300)));
}

double SkyShape::indicatrix(double cos_to_sun) const {
  if (c == 0.0 && e == 0.0) return 1.0;
  const double angle_rad = std::acos(std::clamp(cos_to_sun, -1.0, 1.0));
  return std::max(0.0, 1.0 + c * (std::exp(d * angle_rad) - offset) + e * cos_to_sun * cos_to_sun);
}

bool SkyModel::follows_sun() const {
  if (kind == SkyKind::all_weather) return true;
  return kind == SkyKind::general && cie_type != 1 && cie_type != 3 && cie_type != 5;
}

SkyShape sky_shape(const SkyModel& model, const SunPosition& sun) {
  switch (model.kind) {
    case SkyKind::uniform:
      return {};
    case SkyKind::overcast: {
      SkyShape shape;
      shape.overcast = 2.0;
      return shape;
    }
    case SkyKind::general:
      return standard_shape(model.cie_type);
    case SkyKind::all_weather:
      return all_weather(model.dni_w_m2, model.dhi_w_m2, sun).shape;
    case SkyKind::lights:
      break;
  }
  EXPECT(static_cast<int>(model.kind), <, static_cast<int>(SkyKind::lights));
  return {};
}

AllWeather all_weather(double dni_w_m2, double dhi_w_m2, const SunPosition& sun) {
  EXPECT(dni_w_m2, >=, 0.0);
  EXPECT(dhi_w_m2, >, 0.0);
  const double zenith = zenith_angle_rad(sun);
  const double cubed = 1.041 * zenith * zenith * zenith;
  AllWeather w;
  w.clearness = std::min(((dhi_w_m2 + dni_w_m2) / dhi_w_m2 + cubed) / (1.0 + cubed), most_clearness);
  w.bin = 1 + static_cast<int>(std::upper_bound(bin_edges.begin(), bin_edges.end(), w.clearness) - bin_edges.begin());
  w.brightness = air_mass_at_zenith(zenith) * dhi_w_m2 / extraterrestrial_w_m2;
  const double least = w.bin >= 2 && w.bin <= 5 ? least_brightness_bins_2_to_5 : least_brightness;
  w.brightness = std::clamp(w.brightness, least, most_brightness);

  const BinTable& x = all_weather_bins[static_cast<std::size_t>(w.bin - 1)];
  SkyShape& shape = w.shape;
  shape.a = linear(x[0], zenith, w.brightness);
  shape.b = std::min(linear(x[1], zenith, w.brightness), largest_b);
  shape.a = std::max(shape.a, -std::exp(-shape.b));  // otherwise the zenith's radiance would be negative
  shape.c = linear(x[2], zenith, w.brightness);
  shape.d = linear(x[3], zenith, w.brightness);
  shape.e = linear(x[4], zenith, w.brightness);
  if (w.bin == 1) {  // the paper's equations 8 and 9
    shape.c = std::exp(std::pow(w.brightness * (x[2][0] + x[2][1] * zenith), x[2][2])) - x[2][3];
    shape.d = -std::exp(w.brightness * (x[3][0] + x[3][1] * zenith)) + x[3][2] + w.brightness * x[3][3];
  }
  return w;
}

}  // namespace sunfleck
