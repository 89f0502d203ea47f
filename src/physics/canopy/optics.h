#pragma once
// Reflection and transmission of surfaces, by waveband.

#include "physics/canopy/role.h"

#include <algorithm>
#include <cstddef>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

namespace sunfleck {

// A spectral interval and its irradiance on a horizontal plane above the canopy.
struct Waveband {
  std::string name;
  double direct_w_m2 = 0.0;           // beam irradiance on a horizontal plane
  double diffuse_w_m2 = 0.0;          // sky irradiance on a horizontal plane
  double umol_per_joule = 0.0;        // photons of the band's light; 0: not requested in photon units
  double from_nm = 0.0, to_nm = 0.0;  // its wavelengths; both 0 if they are not given
  std::string weighted_by;            // the light by which spectra were averaged over the band, if any were
};

// Lambertian coefficients for light that arrives on one face: reflected to that face, transmitted to the other.
struct FaceOptics {
  double reflectance = 0.0;
  double transmittance = 0.0;

  // Returns the share that is absorbed: 0 where reflectance and transmittance add up to 1 but for their rounding, since quanta
  // are split to 2^-32 (shaders/shared/quanta.h).
  [[nodiscard]] double absorptance() const {
    const double rest = 1.0 - reflectance - transmittance;
    return rest > 0x1p-33 ? rest : 0.0;
  }
};

// The coefficients of both faces. For objects from a scene file, reflectance + transmittance <= 1.
struct SurfaceOptics {
  std::string name;
  std::vector<FaceOptics> upper;      // [waveband]
  std::vector<FaceOptics> lower;      // [waveband]
  glm::dvec3 rgb{0.06, 0.12, 0.05};   // reflectance in red, green and blue, for pictures only
  std::vector<double> emission_w_m2;  // [waveband], exitance of the upper face, cosine-distributed; empty if it is no lamp
  std::optional<Role> role;           // if given

  // Returns the exitance of the upper face; 0 if it is no lamp.
  [[nodiscard]] double exitance_w_m2(std::size_t band) const { return emission_w_m2.empty() ? 0.0 : emission_w_m2[band]; }
  // Returns whether it is a lamp that shines in some band.
  [[nodiscard]] bool shines() const {
    return std::any_of(emission_w_m2.begin(), emission_w_m2.end(), [](double w_m2) { return w_m2 > 0.0; });
  }
};

struct Soil {
  std::vector<double> reflectance;  // [waveband]
  double patch_m = 0.05;            // cell size of the soil's map
  glm::dvec3 rgb{0.18, 0.14, 0.10};
};

}  // namespace sunfleck
