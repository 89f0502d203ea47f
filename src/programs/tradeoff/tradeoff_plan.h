#pragma once
// Plans the settings that `tradeoff` measures on a scene.

#include "physics/transport/model/model.h"
#include "physics/transport/solve/solve.h"

#include <optional>
#include <vector>

namespace sunfleck {

// Number of replicates of every run with fixed work, and number of parts of the reference, each a run with that many
// replicates.
inline constexpr int tradeoff_replicates = 8;
inline constexpr int reference_parts = 4;

struct TradeoffPlan {
  std::vector<double> grids_m;  // spacings, the widest first; empty without a beam
  // Packets in the first round of a replicate, the fewest first; empty where no light is scattered.
  std::vector<double> packets;
  double reference_grid_m = 0.0;  // of each part
  double reference_packets = 0.0;
};

// Plans six grids, each with four times the rays of the one before: the finest has about `finest_rays` rays and a round
// spacing. `own_grid_m` is added unless it is among them. The packet numbers are five, each four times the one before: the last
// is an eighth of the rays, and none is below the minimum of a round. The reference has 4 times the rays of the finest grid and
// 16 times the largest number of packets.
[[nodiscard]] TradeoffPlan plan_tradeoff(const RadiationModel& model, double finest_rays, std::optional<double> own_grid_m);

// Returns the factor on the number of seeds (1, 2, then 4) for the grid or packet setting `before_last` places before the
// finest: cheap settings are repeated more often, because all settings weigh equally in the fitted slope.
[[nodiscard]] int seeds_factor(std::size_t before_last);

// Return the settings of a run in a series, and of one part of the reference.
[[nodiscard]] SolveSettings grid_settings(SolveSettings settings, double grid_m);
[[nodiscard]] SolveSettings packet_settings(SolveSettings settings, const RadiationModel& model, double packets);
[[nodiscard]] SolveSettings reference_settings(SolveSettings settings, const TradeoffPlan& plan);

}  // namespace sunfleck
