#pragma once
// Reads the optical properties of surfaces: [soil] and [optics.NAME].

#include "files/scene/scene_spectra.h"
#include "files/scene/toml_view.h"
#include "physics/canopy/optics.h"
#include "physics/canopy/plot.h"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace sunfleck {

// Returns the role of surfaces that the table gives, if any.
[[nodiscard]] std::optional<Role> read_role(const TomlTable& table);

// Returns nothing for a scene without [soil]. The default of `patch` is 0.05 m, or more, with a warning, if the plot would have
// too many such cells.
[[nodiscard]] std::optional<Soil> read_soil(const TomlTable& root, std::vector<Waveband>& bands, const Plot& plot,
                                            const SpectraAccess& spectra, std::vector<std::string>& warnings);

struct OpticsInput {
  SurfaceOptics optics;
  std::string place;  // location of its table, for messages
};
using OpticsByName = std::map<std::string, OpticsInput>;

// Returns the entries of [optics] by name, with values for each band. `emission` is divided by per_w_m2 [waveband], the unit of its
// band in the file.
[[nodiscard]] OpticsByName read_optics(const TomlTable& root, std::vector<Waveband>& bands, const std::vector<double>& per_w_m2,
                                       const SpectraAccess& spectra);

}  // namespace sunfleck
