#pragma once
// The light of a scene as the user of a window can change it: plain numbers in degrees, hours and W m-2.

#include "files/scene/scene_reader.h"
#include "physics/transport/model/model.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace sunfleck {

struct SunRequest {
  bool shines = false;
  // The sun's position follows from date, time and place if true, else from the angles below.
  bool by_clock = false;
  int year = 2000, month = 6, day = 21;
  double hour = 12.0;      // local time, 0..24
  int offset_minutes = 0;  // local time minus UTC
  double latitude_deg = 45.0, longitude_deg = 0.0, altitude_m = 0.0;
  double elevation_deg = 45.0, azimuth_deg = 180.0;

  friend bool operator==(const SunRequest&, const SunRequest&) = default;
};

enum class SkyRequestKind { none, uniform, overcast, clear, general, all_weather, of_scene };

struct SkyRequest {
  SkyRequestKind kind = SkyRequestKind::none;
  int cie_type = 12;                          // for `general`
  double dni_w_m2 = 500.0, dhi_w_m2 = 150.0;  // for `all_weather`

  friend bool operator==(const SkyRequest&, const SkyRequest&) = default;
};

// Irradiance of a band on a horizontal plane above the canopy.
struct BandRequest {
  double total_w_m2 = 0.0;
  double diffuse_share = 0.0;  // 0..1

  friend bool operator==(const BandRequest&, const BandRequest&) = default;
};

// Coefficients of one face of a surface in one band.
struct FaceRequest {
  double reflectance = 0.0, transmittance = 0.0;

  friend bool operator==(const FaceRequest&, const FaceRequest&) = default;
};
struct SurfaceRequest {
  std::vector<FaceRequest> upper, lower;  // [band]

  friend bool operator==(const SurfaceRequest&, const SurfaceRequest&) = default;
};

struct LightRequest {
  SunRequest sun;
  SkyRequest sky;
  bool own_irradiance = false;           // use `bands` instead of the scene's irradiance
  std::vector<BandRequest> bands;        // [band]
  std::vector<SurfaceRequest> optics;    // [optics number]
  std::vector<double> soil_reflectance;  // [band]; empty without a soil plane

  friend bool operator==(const LightRequest&, const LightRequest&) = default;
};

// Returns the band's light as the scene has it.
[[nodiscard]] BandRequest band_request(const Waveband& band);

// Returns the scene's own light.
[[nodiscard]] LightRequest request_of(const Scene& scene);

// Return whether two requests mean the same, whatever the values of the fields that they do not use.
[[nodiscard]] bool same_sun(const SunRequest& one, const SunRequest& other);
[[nodiscard]] bool same_sky(const SkyRequest& one, const SkyRequest& other);

// Returns the first difference for the log: "sun", "sky", "irradiance" or "optics"; empty if there is none.
[[nodiscard]] std::string first_difference(const LightRequest& one, const LightRequest& other);

// Returns a digest of the requested light in the form of Digest::text. Equal whenever first_difference finds no difference.
[[nodiscard]] std::string digest_of(const LightRequest& request);

// Returns the local date and time of a sun that follows the clock, in UTC, to the second, as a scene file can hold it. Throws
// Error (input) for a date that does not exist.
[[nodiscard]] UtcTime time_of(const SunRequest& sun);

// Returns the hour that follows when a day is played in such steps: from sunrise to sunset, over and over. Throws like time_of.
[[nodiscard]] double next_played_hour(const SunRequest& sun, double step_min);

// Returns the moments that follow when a day is played from this one; none if the sun does not follow the clock.
[[nodiscard]] std::vector<LightRequest> moments_after(LightRequest moment, double step_min, std::size_t count);

// Applies the requested light to `model`, which began as a copy of scene.model. If that is impossible, throws Error (input)
// with one line and leaves the model unchanged.
//
// A sky chosen here for a scene without any diffuse light gets assumed_diffuse_share of each band's irradiance. Returns that
// share; nothing if the light is the scene's or the user's own.
std::optional<double> grant(const LightRequest& request, const Scene& scene, RadiationModel& model);

// Returns the part of the irradiance that a sky gets where nothing says how much: all of it under an overcast sky or without a
// sun, else 0.2, a common share on a clear day.
[[nodiscard]] double assumed_diffuse_share(const LightRequest& request);

// Returns whether the scene's direct irradiance on level ground stays the same while the sun moves, for at least one band.
[[nodiscard]] bool has_fixed_beam(const Scene& scene);

}  // namespace sunfleck
