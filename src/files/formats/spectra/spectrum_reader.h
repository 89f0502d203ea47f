#pragma once
// Reads spectra of leaves, soils and light from text tables, as instruments, models and spectral libraries write them.
//
// The numbers stand in columns separated by semicolons, tabs, commas or blanks; with semicolons, tabs and blanks the decimal mark
// may be a comma. `#` lines and blank lines may occur anywhere. All lines before the first one that begins with a number are
// preamble; the last of them names the columns if it has as many cells as the numbers have columns. Without names the columns are
// wavelength, reflectance and, if there is a third one, transmittance; or wavelength and light. Columns are recognised by the
// beginning of their names, whatever their case: wavelength, wl, wvl, lambda, nm; reflectance, r, rho; transmittance, t, tau.
// Wavelengths are nm, or micrometres if the names or the preamble say um, µm or micrometer, or if all are below 100. Reflectances
// and transmittances are shares, or percent if the name of the column or the preamble says % or percent. Rows may ascend or
// descend by wavelength.

#include "base/source_files.h"
#include "physics/light/spectrum.h"

#include <filesystem>
#include <optional>

namespace sunfleck {

struct SurfaceSpectra {
  Spectrum reflectance;
  std::optional<Spectrum> transmittance;
};

// Read a spectrum. Throw Error (input), one line `FILE:LINE: ...`, for a file without two rows of numbers, unknown or missing
// columns, values that are not finite or out of range (shares beyond 0..1, light below 0, wavelengths beyond 100 nm..1 mm), a
// repeated wavelength, and reflectance + transmittance above 1. The file is added to `files` if that is given.
[[nodiscard]] SurfaceSpectra read_surface_spectra(const std::filesystem::path& file, SourceFiles* files = nullptr);
[[nodiscard]] Spectrum read_light_spectrum(const std::filesystem::path& file, SourceFiles* files = nullptr);

}  // namespace sunfleck
