#pragma once
// Conversion of landings into fluxes: sums over replicates, integers for the ledger, means and spreads for the rest.

#include "transport/accuracy.h"
#include "transport/counters.h"
#include "transport/events.h"
#include "transport/exposure.h"
#include "transport/indirect.h"
#include "transport/model.h"
#include "transport/planes.h"
#include "transport/result.h"
#include "transport/surfaces.h"
#include "transport/tally_sums.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace sunfleck {

// Landings of one replicate's beam rays, summed from its counters.
struct DirectSums {
  struct Landings {
    std::uint64_t upper = 0, lower = 0;
    [[nodiscard]] std::uint64_t both() const { return upper + lower; }
  };
  std::vector<Landings> surface;       // [surface]
  std::vector<Landings> layer_optics;  // [layer * optics + optics], without soil
  std::vector<double> organ_lit_m2;    // [organ]
  std::vector<double> layer_lit_m2;    // [layer], foliage
  std::uint64_t soil_plane = 0, transmitted = 0, ground = 0, met = 0, missed = 0, lost = 0;
};

// The largest of the relative errors that a bound applies to, and the figure with that error.
struct JudgedError {
  double relative = 0.0;  // NaN below two replicates
  JudgedFigure figure;

  // Replaces the error by `other` if that is larger.
  void raise(double other, const JudgedFigure& of);
};

class Tally {
 public:
  // All replicates have the same `incidence`. All other arguments must outlive the tally; `receivers` may be null.
  Tally(const RadiationModel& model, const CounterLayout& layout, const Surfaces& surfaces, const PlaneReceivers* receivers,
        const Incidence& incidence, ElementErrors element_errors);

  [[nodiscard]] const std::vector<BandQuanta>& quanta() const { return quanta_; }

  // Returns the sums of one replicate's counters without adding them to the tally. Throws Error (failure) unless every ray
  // sent is accounted for.
  [[nodiscard]] DirectSums sum(std::span<const std::uint32_t> counters) const;

  // Returns the flux that the first landings leave to be shot, as FirstLandings::scattered.
  [[nodiscard]] std::vector<std::int64_t> scattered(const DirectSums& sums) const;

  // Returns the same by zones of the receivers, as FirstLandings::scattered_by_zone; empty without receivers.
  [[nodiscard]] std::vector<std::int64_t> scattered_by_zone(const DirectSums& sums, const PlaneSums& passed) const;

  // Adds a replicate; `passed` holds the crossings of the receivers by its beam rays. Without an indirect pass the flux
  // scattered by first landings counts as unshot, as does the sky's flux in an endless canopy.
  void add(std::span<const std::uint32_t> counters, const DirectSums& sums, const PlaneSums& passed,
           const IndirectSums* indirect);

  [[nodiscard]] std::size_t replicates() const { return replicates_; }
  [[nodiscard]] std::uint64_t packets() const { return packets_; }
  [[nodiscard]] std::uint64_t sky_rays() const { return sky_rays_; }

  // Returns everything that another tally with the same incidence needs to continue. The number of values depends only on
  // the model.
  [[nodiscard]] TallySums sums() const;

  // Takes over the sums of another tally. Returns false if there are too few or too many.
  [[nodiscard]] bool restore(const TallySums& sums);

  // Returns the error that is compared with the direct bound: the largest half-width, relative to its value, of the
  // first-hit flux on vegetation and on the ground, each taken as at least 1 % of the incident flux. For organs it also
  // includes every organ with at least a tenth of the mean organ's flux; for triangles it also includes the area-weighted
  // root-mean-square half-width of the elements' irradiance, relative to its mean.
  [[nodiscard]] JudgedError direct_error(const Accuracy& accuracy) const;

  // Returns the same for all other flux that vegetation and soil absorb, the largest over the bands; half-widths include
  // the unshot flux.
  [[nodiscard]] JudgedError indirect_error(const Accuracy& accuracy) const;

  // Returns everything but `stop`, `direct` and `indirect`. Throws Error (failure) if a ledger does not close.
  [[nodiscard]] RadiationResult result(double confidence) const;

 private:
  using Landings = DirectSums::Landings;
  struct BandMeans {                                         // W m-2 of ground
    ReplicateMean vegetation, soil, reflected, transmitted;  // total flux absorbed or leaving
    ReplicateMean indirect_vegetation, indirect_soil;        // absorbed flux except from the beam's first landings
  };
  struct OrganMeans {
    ReplicateMean landed, sunlit;  // landed: ground area of the beam rays per organ area
    std::vector<ReplicateMean> direct, indirect, absorbed, indirect_absorbed;  // [band], W m-2 of organ
  };
  struct LayerMeans {
    ReplicateMean ratio, sunlit;
    std::vector<ReplicateMean> down, up, absorbed;  // [band], W m-2 of ground
  };
  struct Spread {
    double sum = 0.0, squares = 0.0;
    void add(double value) {
      sum += value;
      squares += value * value;
    }
  };

  // Passes every sum to `archive`; serves const and other tallies alike.
  template <class Self, class Archive>
  static void visit_sums(Self& self, Archive& archive);
  void measure_elements();
  [[nodiscard]] const QuantaSplit& split_of(std::size_t optics, std::size_t side, std::size_t band) const;
  void split_rays();
  void sum_elements(std::span<const std::uint32_t> counters, DirectSums& sums) const;
  void check(const DirectSums& sums) const;
  void count_landed(const IndirectSums& indirect);
  void add_to_ledgers(const DirectSums& sums, const IndirectSums* indirect);
  void add_to_band_means(const DirectSums& sums, const IndirectSums* indirect);
  void add_to_organ_means(const DirectSums& sums, const IndirectSums* indirect);
  void add_to_layer_means(const DirectSums& sums, const IndirectSums* indirect);
  void add_to_planes(const PlaneSums& passed, const IndirectSums* indirect);
  void add_elements(std::span<const std::uint32_t> counters, const IndirectSums* indirect);
  [[nodiscard]] Landings element_landings(std::span<const std::uint32_t> counters, std::size_t element) const;
  [[nodiscard]] double absorptance(std::size_t optics, std::size_t side, std::size_t band) const;
  [[nodiscard]] double beam_w_m2(std::size_t band) const;
  [[nodiscard]] double unshot_share(std::size_t band) const;
  [[nodiscard]] double half_width(const Spread& spread, double quantile) const;
  [[nodiscard]] double unseen(double event, double confidence) const;
  [[nodiscard]] double relative_error(const ReplicateMean& mean, double least, double unseen, double quantile) const;
  [[nodiscard]] JudgedError organ_error(double quantile, bool indirect) const;
  [[nodiscard]] double element_rms_error(double quantile, const std::vector<Spread>& spreads, std::size_t first) const;
  [[nodiscard]] BandResult band_result(std::size_t band, double confidence) const;
  [[nodiscard]] std::vector<OrganResult> organ_results(double confidence) const;
  [[nodiscard]] std::vector<LayerResult> layer_results(double confidence) const;
  [[nodiscard]] Estimate sunlit_estimate(const ReplicateMean& mean, double facing_m2, std::vector<FacingArea> parts,
                                         double confidence) const;
  [[nodiscard]] std::vector<std::vector<FacingArea>> agreed_organs() const;
  [[nodiscard]] std::vector<std::vector<FacingArea>> agreed_layers() const;
  [[nodiscard]] std::vector<FacingArea> agreed_foliage() const;
  [[nodiscard]] double share_of_one_ray() const;
  [[nodiscard]] std::vector<double> element_errors(double quantile) const;
  [[nodiscard]] std::vector<double> side_errors(double quantile) const;

  const RadiationModel& model_;
  const CounterLayout& layout_;
  const Surfaces& surfaces_;
  std::uint64_t rays_;
  double ground_per_ray_m2_;
  std::optional<PlaneTally> planes_;
  std::vector<BandQuanta> quanta_;  // [band]
  LightEvents events_;
  BeamExposure exposure_;
  std::vector<double> organ_absorptance_;  // [organ * bands + band], the largest of its faces; 0 if no light can reach it
  std::vector<double> vegetation_absorptance_, soil_absorptance_;  // [band], the largest of all such surfaces; 0 without any
  bool beam_meets_vegetation_ = false;                             // the beam can hit some of it
  std::vector<bool> foliage_;                                      // [element]
  std::vector<double> organ_area_m2_;                              // [organ]
  std::vector<double> organ_facing_m2_;                            // [organ], of elements that the beam can hit
  std::vector<double> layer_foliage_m2_;                           // [layer]
  std::vector<double> layer_facing_m2_;                            // [layer], of foliage that the beam can hit
  std::vector<bool> layer_holds_vegetation_;                       // [layer], holds vegetation that light can reach
  double foliage_m2_ = 0.0, facing_m2_ = 0.0;
  std::vector<QuantaSplit> splits_;  // of a ray: [(optics * 2 + side) * bands + band], then [band] of the soil plane

  std::size_t replicates_ = 0;
  std::uint64_t lost_ = 0, sky_rays_ = 0, packets_ = 0, rounds_ = 0;
  std::vector<FluxLedger> ledgers_;  // [band]
  std::vector<double> landed_;       // [band], quanta of packets and sky rays, counted once per landing
  ReplicateMean first_vegetation_, first_ground_, met_, ground_ratio_, sunlit_;
  std::vector<BandMeans> bands_;
  std::vector<OrganMeans> organs_;
  std::vector<LayerMeans> layers_;  // [layer, + 1 for the top plane]
  std::vector<ElementResult> elements_;
  std::vector<std::int64_t> side_landed_;  // as IndirectSums::side_landed, over all replicates; empty before the first
  std::vector<std::int64_t> cell_landed_, side_sky_, cell_sky_;
  std::vector<std::uint64_t> soil_cells_;
  std::vector<std::uint64_t> element_hits_;  // [element], rays and packets; empty if errors are skipped
  ElementErrors element_errors_;
  std::vector<Spread> direct_spread_;    // [element], landings; this and the next two are empty if errors are skipped
  std::vector<Spread> absorbed_spread_;  // [band * elements + element], W m-2 of element
  std::vector<Spread> indirect_spread_;  // [band * elements + element], W m-2 of element
  std::vector<Spread> side_spread_;      // [(2 * element + side) * bands + band], W m-2 of element; empty unless kept
};

}  // namespace sunfleck
