#pragma once
// What a window lets its user change of a scene's light, as plain numbers in the units of users: degrees, hours, W m-2.

#include "io/scene_reader.h"
#include "transport/model.h"

#include <optional>
#include <string>
#include <vector>

namespace sunfleck {

struct SunWish {
  bool shines = false;
  bool by_clock = false;  // where date, time and place say, or at the angles below
  int year = 2000, month = 6, day = 21;
  double hour = 12.0;      // local, 0..24
  int offset_minutes = 0;  // local time minus UTC
  double latitude_deg = 45.0, longitude_deg = 0.0, altitude_m = 0.0;
  double elevation_deg = 45.0, azimuth_deg = 180.0;

  friend bool operator==(const SunWish&, const SunWish&) = default;
};

enum class SkyWishKind { none, uniform, overcast, clear, general, all_weather, of_scene };

struct SkyWish {
  SkyWishKind kind = SkyWishKind::none;
  int cie_type = 12;                          // general
  double dni_w_m2 = 500.0, dhi_w_m2 = 150.0;  // all_weather

  friend bool operator==(const SkyWish&, const SkyWish&) = default;
};

// Irradiance of a band on a horizontal plane above the canopy.
struct BandWish {
  double total_w_m2 = 0.0;
  double diffuse_share = 0.0;  // 0..1

  friend bool operator==(const BandWish&, const BandWish&) = default;
};

// Coefficients of one surface in one band, by face.
struct FaceWish {
  double reflectance = 0.0, transmittance = 0.0;

  friend bool operator==(const FaceWish&, const FaceWish&) = default;
};
struct SurfaceWish {
  std::vector<FaceWish> upper, lower;  // [band]

  friend bool operator==(const SurfaceWish&, const SurfaceWish&) = default;
};

struct LightWish {
  SunWish sun;
  SkyWish sky;
  bool own_irradiance = false;           // `bands` below, or what the scene says of the moment
  std::vector<BandWish> bands;           // [band]
  std::vector<SurfaceWish> optics;       // [optics number]
  std::vector<double> soil_reflectance;  // [band]; empty without a soil plane

  friend bool operator==(const LightWish&, const LightWish&) = default;
};

// As the band is lit.
[[nodiscard]] BandWish band_wish(const Waveband& band);

// As the scene is.
[[nodiscard]] LightWish wish_of(const Scene& scene);

// What differs, for the log: "sun", "sky", "irradiance", "optics"; the first that does. Empty where nothing does.
[[nodiscard]] std::string first_difference(const LightWish& one, const LightWish& other);

// A mark of the light that a wish makes: as Digest::text, the same for wishes between which first_difference finds none.
[[nodiscard]] std::string digest_of(const LightWish& wish);

// Local date and time of a wish by the clock, in UTC. Throws Error (input) for a date that does not exist.
[[nodiscard]] UtcTime time_of(const SunWish& sun);

// Makes the wish true in `model`, which began as a copy of scene.model. Throws Error (input), one line, where that is
// impossible; the model is then as it was.
void grant(const LightWish& wish, const Scene& scene, RadiationModel& model);

}  // namespace sunfleck
