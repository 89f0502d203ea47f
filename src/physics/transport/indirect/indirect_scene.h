#pragma once
// What an indirect pass is given: the scene, and the light that enters it in one replicate.

#include "physics/transport/indirect/emission.h"
#include "physics/transport/indirect/sky_rays.h"
#include "physics/transport/model/band_quanta.h"
#include "physics/transport/model/beam_block.h"
#include "physics/transport/model/counters.h"
#include "physics/transport/model/lights.h"
#include "physics/transport/model/model.h"
#include "physics/transport/model/stand_aim.h"
#include "physics/transport/model/surfaces.h"
#include "physics/transport/model/tracer.h"
#include "physics/transport/receivers/planes.h"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace sunfleck {

// The results of one replicate's direct pass in one light that the indirect pass starts from.
struct FirstLandings {
  std::vector<BeamPart> beam;  // empty without direct light
  // [ray], where each ray of the beam's only part landed; empty if that was not recorded.
  std::span<const shared::Landing> recorded;
  std::shared_ptr<const KeptLandings> kept;  // the same where the tracer works; null if they are not kept there
  double ground_per_ray_m2 = 0.0;            // level ground that a beam ray of weight 1 represents
  std::uint64_t met = 0;                     // number of beam rays that met anything, by weight
  // Quanta waiting where they landed, [(level + 1) * bands + band]; `level` as in EmissionPoint, so index 0 is the soil
  // and index 1 the lowest layer.
  std::vector<std::int64_t> scattered;
  // The same by zones of the receivers, [zone * bands + band]; empty without receivers.
  std::vector<std::int64_t> scattered_by_zone;
  std::vector<double> least_of_vegetation;  // quanta, as Conversion::least_of_vegetation
};

// The light that enters in one replicate.
struct LightFromAbove {
  const StandAim* aim = nullptr;                       // null if light is not aimed
  const SkyRays* sky = nullptr;                        // null without a sky
  std::vector<FirstLandings> first;                    // [light]
  std::vector<const std::vector<BandQuanta>*> quanta;  // [light], quanta of its bands
};

// What the indirect passes of all replicates share.
struct IndirectScene {
  // All arguments must outlive the scene; `receivers` may be null.
  IndirectScene(Lights lights, const CounterLayout& layout, const Surfaces& surfaces, Tracer& tracer,
                const PlaneReceivers* receivers);

  Lights lights;
  const RadiationModel& model;  // the first light; canopy, optics and soil are those of all
  const CounterLayout& layout;
  const Surfaces& surfaces;
  Tracer& tracer;
  const PlaneReceivers* receivers;
  shared::PacketBlock block;
  EmissionFrame frame;
  std::uint64_t number;  // no other scene of this process has the same, and none has 0
};

}  // namespace sunfleck
