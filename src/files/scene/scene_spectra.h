#pragma once
// Reads spectra that a scene names, and their means over its bands.

#include "files/scene/scene_reader.h"
#include "files/scene/toml_view.h"
#include "physics/canopy/optics.h"
#include "physics/light/spectrum.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace sunfleck {

// The light by which spectra are averaged.
struct SpectralLight {
  std::optional<Spectrum> spectrum;  // empty: equal energy at all wavelengths
  std::string name = "equal energy";

  [[nodiscard]] const Spectrum* pointer() const { return spectrum ? &*spectrum : nullptr; }
};

// What `spectrum = "leaf.csv"` in a table of the scene refers to.
struct SpectraAccess {
  const std::filesystem::path& scene_file;
  const SceneAccess& access;
  const SpectralLight& light;
};

// Reads `light_spectrum` of the scene.
[[nodiscard]] SpectralLight read_spectral_light(const TomlTable& root, const std::filesystem::path& scene_file,
                                                const SceneAccess& access);

// Refuses the table unless the light is known in the whole range.
void check_light_covers(const TomlTable& table, const WavelengthRange& range, const Spectrum* light);

// Returns the means over each band of the spectra in the file that `spectrum` names: reflectance, and transmittance if the file
// has it, otherwise 0. Notes in the bands how they were weighted. Refuses bands without wavelengths, and a band that reaches
// beyond the file.
[[nodiscard]] std::vector<FaceOptics> read_spectral_face(const TomlTable& table, std::vector<Waveband>& bands,
                                                         const SpectraAccess& spectra);

}  // namespace sunfleck
