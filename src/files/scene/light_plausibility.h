#pragma once
// Warns about impossible sunlight: too strong for a beam, in another unit, from an angle in another convention, at another
// place than the clock's, or in shares that are more than all of it.

#include "files/scene/scene_reader.h"
#include "files/scene/toml_view.h"
#include "physics/light/spectrum.h"

#include <string>
#include <vector>

namespace sunfleck {

// Total solar irradiance at the mean distance of the sun, W m-2 (Kopp and Lean 2011).
inline constexpr double solar_constant_w_m2 = 1361.0;

// Photons in the energy of sunlight of 400..700 nm, umol J-1 (McCree 1972).
inline constexpr double par_umol_per_joule = 4.57;

// Returns an upper bound of the share of the sun's radiation outside the atmosphere that lies in a range of wavelengths, 0..1:
// that of a black body of 5772 K (IAU 2015 resolution B3; Prsa et al. 2016) and a quarter more, since in parts of its spectrum,
// such as at 450 and 1,600 nm, the sun is up to a fifth brighter (Thekaekara 1973).
[[nodiscard]] double most_solar_share(const WavelengthRange& range);

// Returns warnings about [sun] and the fixed light of each [[band]] of a scene whose light has been read. Each names its place
// and the number that would be right. A beam is compared with the light outside the atmosphere, at the sun's distance of the
// scene's date, or at its mean distance if the scene has no date; where the band has wavelengths, with the share of it that
// most_solar_share gives. The sun should be highest within four hours of noon by the clock of the scene's time, unless that is
// UTC, and the shares of bands should add up to at most 1.
[[nodiscard]] std::vector<std::string> light_warnings(const TomlTable& root, const Scene& scene);

// Returns warnings about surfaces that emit light though their role or name says that they are leaves. `root` locates them.
[[nodiscard]] std::vector<std::string> emission_warnings(const TomlTable& root, const RadiationModel& model);

}  // namespace sunfleck
