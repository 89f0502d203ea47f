#include "physics/light/spectrum.h"

#include "base/check.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

namespace sunfleck {
namespace {

// Avogadro's number times Planck's constant times the speed of light, J m mol-1 (exact in the SI of 2019).
constexpr double molar_photon_j_m = 6.02214076e23 * 6.62607015e-34 * 299792458.0;

// Returns the share of a black body's radiation at wavelengths up to this one: the integral of Planck's law as a series in
// exp(-x), x = h c / (wavelength k temperature).
double black_body_share_below(double wavelength_nm, double temperature_k) {
  constexpr double second_radiation_constant_nm_k = 1.438776877e7;  // h c / k, exact in the SI of 2019
  constexpr int most_terms = 200;
  constexpr double pi = std::numbers::pi;
  const double x = second_radiation_constant_nm_k / (wavelength_nm * temperature_k);
  double sum = 0.0;
  for (int n = 1; n <= most_terms; ++n) {
    const double nth = 1.0 / n;
    sum += std::exp(-n * x) * nth * (x * x * x + 3.0 * x * x * nth + 6.0 * x * nth * nth + 6.0 * nth * nth * nth);
  }
  return 15.0 / (pi * pi * pi * pi) * sum;
}

// Adds the wavelengths of the spectrum inside the range.
void add_steps(const Spectrum& spectrum, const WavelengthRange& range, std::vector<double>& steps) {
  for (const double wavelength_nm : spectrum.wavelength_nm) {
    if (wavelength_nm > range.from_nm && wavelength_nm < range.to_nm) steps.push_back(wavelength_nm);
  }
}

// Returns the integral of value(wavelength) times the light. Simpson's rule is exact in each step, because both factors are
// linear there.
template <class Value>
double integral(const Value& value, std::vector<double> steps, const WavelengthRange& range, const Spectrum* light) {
  if (light != nullptr) add_steps(*light, range, steps);
  steps.push_back(range.from_nm);
  steps.push_back(range.to_nm);
  std::sort(steps.begin(), steps.end());
  const auto product = [&](double nm) { return value(nm) * (light != nullptr ? value_at(*light, nm) : 1.0); };
  double sum = 0.0;
  for (std::size_t k = 1; k < steps.size(); ++k) {
    const double middle = 0.5 * (steps[k - 1] + steps[k]);
    sum += (steps[k] - steps[k - 1]) / 6.0 * (product(steps[k - 1]) + 4.0 * product(middle) + product(steps[k]));
  }
  return sum;
}

const Spectrum* unless_dark(const Spectrum* light, const WavelengthRange& range) {
  return light != nullptr && energy_in(light, range) > 0.0 ? light : nullptr;
}

}  // namespace

bool covers(const Spectrum& spectrum, const WavelengthRange& range) {
  return spectrum.wavelength_nm.front() <= range.from_nm && range.to_nm <= spectrum.wavelength_nm.back();
}

double value_at(const Spectrum& spectrum, double wavelength_nm) {
  const std::vector<double>& at = spectrum.wavelength_nm;
  EXPECT(wavelength_nm, >=, at.front());
  EXPECT(wavelength_nm, <=, at.back());
  const auto above = std::max(std::lower_bound(at.begin(), at.end(), wavelength_nm), at.begin() + 1);
  const auto k = static_cast<std::size_t>(above - at.begin());
  const double share = (wavelength_nm - at[k - 1]) / (at[k] - at[k - 1]);
  return spectrum.values[k - 1] + share * (spectrum.values[k] - spectrum.values[k - 1]);
}

double energy_in(const Spectrum* light, const WavelengthRange& range) {
  return integral([](double) { return 1.0; }, {}, range, light);
}

double mean_in(const Spectrum& values, const WavelengthRange& range, const Spectrum* light) {
  const Spectrum* weight = unless_dark(light, range);
  std::vector<double> steps;
  add_steps(values, range, steps);
  return integral([&](double nm) { return value_at(values, nm); }, std::move(steps), range, weight) / energy_in(weight, range);
}

double umol_per_joule_in(const WavelengthRange& range, const Spectrum* light) {
  constexpr double m_per_nm = 1e-9;
  constexpr double umol_per_mol = 1e6;
  const Spectrum* weight = unless_dark(light, range);
  const double mean_nm = integral([](double nm) { return nm; }, {}, range, weight) / energy_in(weight, range);
  return umol_per_mol * mean_nm * m_per_nm / molar_photon_j_m;
}

double black_body_share(const WavelengthRange& range, double temperature_k) {
  EXPECT(temperature_k, >, 0.0);
  return black_body_share_below(range.to_nm, temperature_k) - black_body_share_below(range.from_nm, temperature_k);
}

}  // namespace sunfleck
