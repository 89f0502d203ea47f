#pragma once
// Quantities by wavelength, and their means over wavebands.

#include <vector>

namespace sunfleck {

// Values at wavelengths, linear between them.
struct Spectrum {
  std::vector<double> wavelength_nm;  // ascending, at least two
  std::vector<double> values;         // [wavelength]
};

struct WavelengthRange {
  double from_nm = 0.0, to_nm = 0.0;  // from_nm < to_nm
};

// Returns whether the spectrum has values in the whole range.
[[nodiscard]] bool covers(const Spectrum& spectrum, const WavelengthRange& range);

// Returns the value at a wavelength that the spectrum covers.
[[nodiscard]] double value_at(const Spectrum& spectrum, double wavelength_nm);

// Returns the integral of the light's energy over a range that it covers, in its unit times nm; the width of the range for
// light of equal energy at all wavelengths (null).
[[nodiscard]] double energy_in(const Spectrum* light, const WavelengthRange& range);

// Returns the mean of the values over the range, weighted by the energy of the light, or unweighted if the light is null or
// dark in the whole range. It is exact for values that are linear between the given ones. Both must cover the range.
[[nodiscard]] double mean_in(const Spectrum& values, const WavelengthRange& range, const Spectrum* light);

// Returns the photons in the range per energy of the light, umol J-1: the mean of wavelength / (N_A h c).
[[nodiscard]] double umol_per_joule_in(const WavelengthRange& range, const Spectrum* light);

// Returns the share of a black body's radiation that lies in the range, 0..1 (Chang and Rhee 1984, eq. 6).
[[nodiscard]] double black_body_share(const WavelengthRange& range, double temperature_k);

}  // namespace sunfleck
