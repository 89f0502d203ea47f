#include "files/scene/scene_spectra.h"

#include "base/file.h"
#include "files/formats/spectra/spectrum_reader.h"
#include "files/scene/scene_files.h"

#include <fmt/format.h>

#include <algorithm>

namespace sunfleck {
namespace {

std::string range_text(const WavelengthRange& range) {
  return fmt::format("{:g} to {:g} nm", range.from_nm, range.to_nm);
}

WavelengthRange range_of(const Spectrum& spectrum) {
  return {spectrum.wavelength_nm.front(), spectrum.wavelength_nm.back()};
}

}  // namespace

SpectralLight read_spectral_light(const TomlTable& root, const std::filesystem::path& scene_file, const SceneAccess& access) {
  if (!root.has("light_spectrum")) return {};
  const std::filesystem::path file =
      find_scene_file(root, scene_file, access, "name a table of light by wavelength", "light_spectrum");
  return {read_light_spectrum(file, access.files), printable(file.filename().string())};
}

void check_light_covers(const TomlTable& table, const WavelengthRange& range, const Spectrum* light) {
  if (light == nullptr || covers(*light, range)) return;
  table.refuse_table(fmt::format("its wavelengths, {}, reach beyond light_spectrum, which has {}", range_text(range),
                                 range_text(range_of(*light))),
                     "use a spectrum of that range, or other wavelengths");
}

std::vector<FaceOptics> read_spectral_face(const TomlTable& table, std::vector<Waveband>& bands, const SpectraAccess& spectra) {
  for (const char* key : {"reflectance", "transmittance"}) {
    if (table.has(key)) table.refuse(key, "spectrum is also given, which holds it", "remove one of the two");
  }
  const std::filesystem::path file =
      find_scene_file(table, spectra.scene_file, spectra.access,
                      "name a table of reflectance by wavelength, or give numbers as reflectance", "spectrum");
  const SurfaceSpectra surface = read_surface_spectra(file, spectra.access.files);
  std::vector<FaceOptics> face;
  for (Waveband& band : bands) {
    const WavelengthRange range{band.from_nm, band.to_nm};
    if (!(band.to_nm > 0.0)) {
      table.refuse("spectrum", fmt::format("band {} has no wavelengths", band.name),
                   "add range_nm = [400, 700], or what is right, to its [[band]]");
    }
    if (!covers(surface.reflectance, range)) {
      table.refuse("spectrum",
                   fmt::format("band {} is {}, but the file has {}", band.name, range_text(range),
                               range_text(range_of(surface.reflectance))),
                   "use a file of that range, or another range_nm");
    }
    check_light_covers(table, range, spectra.light.pointer());
    band.weighted_by = spectra.light.name;
    const auto mean = [&](const Spectrum& spectrum) { return mean_in(spectrum, range, spectra.light.pointer()); };
    // The file's decimal fractions may add up to a little more than 1.
    const double reflectance = std::min(1.0, mean(surface.reflectance));
    const double transmittance = surface.transmittance ? mean(*surface.transmittance) : 0.0;
    face.push_back({reflectance, std::min(1.0 - reflectance, transmittance)});
  }
  return face;
}

}  // namespace sunfleck
