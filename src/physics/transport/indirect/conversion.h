#pragma once
// Conversion of landings and quanta into flux. It is the same for all replicates of one incidence, and never changes.

#include "physics/transport/indirect/replicate.h"
#include "physics/transport/model/band_quanta.h"
#include "physics/transport/model/canopy_areas.h"
#include "physics/transport/model/columns.h"
#include "physics/transport/model/counters.h"
#include "physics/transport/model/events.h"
#include "physics/transport/model/exposure.h"
#include "physics/transport/model/model.h"
#include "physics/transport/model/surfaces.h"
#include "physics/transport/receivers/planes.h"

#include <cstdint>
#include <span>
#include <vector>

namespace sunfleck {

struct Conversion {
  // All arguments but the incidence must outlive the conversion; `receivers` may be null.
  Conversion(const RadiationModel& model, const CounterLayout& layout, const Surfaces& surfaces, const CanopyAreas& areas,
             const PlaneReceivers* receivers, const Incidence& incidence);

  // Returns the sums of one replicate's counters. Throws Error (failure) unless every ray sent is accounted for.
  [[nodiscard]] DirectSums sum(std::span<const std::uint32_t> counters) const;
  [[nodiscard]] BeamLandings element_landings(std::span<const std::uint32_t> counters, std::size_t element) const;

  // Returns the flux that the first landings leave to be shot, as FirstLandings::scattered.
  [[nodiscard]] std::vector<std::int64_t> scattered(const DirectSums& sums) const;

  // Returns the same by zones of the receivers, as FirstLandings::scattered_by_zone; empty without receivers.
  [[nodiscard]] std::vector<std::int64_t> scattered_by_zone(const DirectSums& sums, const PlaneSums& passed) const;

  // Returns the least flux to which the error of vegetation's light is relative, W m-2 of ground: a thousandth of what
  // vegetation would absorb of all light with nothing around it, taken as at least a thousandth of the plot's area.
  // Infinite in a band that vegetation cannot absorb. Without it, the error of a stand that stays dark could reach no bound.
  [[nodiscard]] double least_of_vegetation_w_m2(std::size_t band) const;
  // Returns that floor for the beam, as a share: a thousandth of vegetation's area per area of the plot, which is taken as
  // 0.001 to 1.
  [[nodiscard]] double least_share_of_vegetation() const;

  // Returns the least flux, in quanta of each band, with which unshot flux is compared: 1 % of what vegetation
  // absorbed of the first landings, or least_of_vegetation_w_m2 if that is more.
  [[nodiscard]] std::vector<double> least_of_vegetation(const DirectSums& sums) const;

  // Returns how a beam ray's quanta split on a face (side 0 is the upper one), or on the soil plane.
  [[nodiscard]] const QuantaSplit& split(std::size_t optics, std::size_t side, std::size_t band) const {
    return splits_[(optics * 2 + side) * quanta.size() + band];
  }
  [[nodiscard]] const QuantaSplit& soil_split(std::size_t band) const {
    return splits_[model.optics.size() * 2 * quanta.size() + band];
  }

  [[nodiscard]] double absorptance(std::size_t optics, std::size_t side, std::size_t band) const {
    return absorptances_[(optics * 2 + side) * quanta.size() + band];
  }

  // Returns the absorptances of a face in all bands.
  [[nodiscard]] std::span<const double> absorptances(std::size_t optics, std::size_t side) const {
    return std::span(absorptances_).subspan((optics * 2 + side) * quanta.size(), quanta.size());
  }

  // Returns the horizontal irradiance of the beam.
  [[nodiscard]] double beam_w_m2(std::size_t band) const { return model.has_beam() ? model.bands[band].direct_w_m2 : 0.0; }

  const RadiationModel& model;
  const CounterLayout& layout;
  const Surfaces& surfaces;
  const PlaneReceivers* const receivers;
  const std::uint64_t rays;  // of the beam
  const double ground_per_ray_m2;
  const std::vector<BandQuanta> quanta;  // [band]
  const LightEvents events;
  const BeamExposure exposure;
  const CanopyAreas& areas;

 private:
  void sum_elements(std::span<const std::uint32_t> counters, DirectSums& sums) const;
  void check(const DirectSums& sums) const;
  [[nodiscard]] std::int64_t scattered_of(const BeamLandings& landings, std::size_t optics, std::size_t band) const;
  [[nodiscard]] std::vector<std::int64_t> scattered_by_place(std::span<const BeamLandings> landings, std::size_t first,
                                                             std::size_t places, std::uint64_t soil_plane) const;

  std::vector<double> absorptances_;  // [(optics * 2 + side) * bands + band]
  std::vector<QuantaSplit> splits_;   // of a ray: [(optics * 2 + side) * bands + band], then [band] of the soil plane
};

}  // namespace sunfleck
