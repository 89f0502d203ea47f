#pragma once
// The indirect pass of one replicate: progressive Monte Carlo radiosity. Reflected, transmitted and emitted flux is shot
// round by round, from the points where it landed, until too little is left to matter.

#include "physics/transport/indirect/candidates.h"
#include "physics/transport/indirect/pass_arrays.h"
#include "physics/transport/indirect/replicate.h"
#include "physics/transport/indirect/sky_rays.h"
#include "physics/transport/model/band_quanta.h"
#include "physics/transport/model/beam_block.h"
#include "physics/transport/model/counters.h"
#include "physics/transport/model/model.h"
#include "physics/transport/model/stand_aim.h"
#include "physics/transport/model/surfaces.h"
#include "physics/transport/model/tracer.h"
#include "physics/transport/receivers/planes.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace sunfleck {

// The results of one replicate's direct pass that the indirect pass starts from.
struct FirstLandings {
  std::span<const BeamPart> beam;  // empty without direct light
  const StandAim* aim = nullptr;   // null if light is not aimed
  const SkyRays* sky = nullptr;    // null without a sky
  std::uint64_t met = 0;           // number of beam rays that met anything, by weight
  // Quanta waiting where they landed, [(level + 1) * bands + band]; `level` as in EmissionPoint, so index 0 is the soil
  // and index 1 the lowest layer.
  std::vector<std::int64_t> scattered;
  // The same by zones of the receivers, [zone * bands + band]; empty without receivers.
  std::vector<std::int64_t> scattered_by_zone;
  std::vector<double> least_of_vegetation;  // quanta, as Conversion::least_of_vegetation
};

// What the indirect passes of all replicates share.
struct IndirectScene {
  // All arguments must outlive the scene; `receivers` may be null.
  IndirectScene(const RadiationModel& model, const CounterLayout& layout, const Surfaces& surfaces, Tracer& tracer,
                const PlaneReceivers* receivers);

  const RadiationModel& model;
  const CounterLayout& layout;
  const Surfaces& surfaces;
  Tracer& tracer;
  const PlaneReceivers* receivers;
  shared::PacketBlock block;
  EmissionFrame frame;
};

// Shoots until every band is retired, that is, until its unshot flux is below a tenth of the order's bound times the smaller
// of the fluxes absorbed by vegetation and by soil, taken as at least first.least_of_vegetation and 1 % of the incident flux. Returns
// nothing if stopped. Several threads may call this for the same scene, each with its own arrays, if the tracer allows it.
[[nodiscard]] std::optional<IndirectSums> run_indirect_pass(const IndirectScene& scene, const ReplicateOrder& order,
                                                            const FirstLandings& first, const std::vector<BandQuanta>& quanta,
                                                            PassArrays& arrays, const StopQuestion& stop);

// Returns the k-th ray of a systematic sample that takes one ray in `stride`. The offset is uniform over [0, 1). The last
// sum may round up to `rays`.
[[nodiscard]] std::uint32_t sampled_ray(std::size_t k, double offset, double stride, std::uint64_t rays);

}  // namespace sunfleck
