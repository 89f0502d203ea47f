#pragma once
// The settings that `tradeoff` measures on a scene.

#include "transport/model.h"
#include "transport/solve.h"

#include <optional>
#include <vector>

namespace sunfleck {

// Replicates of every run with fixed work, and parts of the reference, each a run with such replicates.
inline constexpr int tradeoff_replicates = 8;
inline constexpr int reference_parts = 4;

struct TradeoffPlan {
  std::vector<double> grids_m;    // spacings, the widest first; empty without a beam
  std::vector<double> packets;    // of the first round of a replicate, the fewest first; empty where no light is scattered
  double reference_grid_m = 0.0;  // of each part
  double reference_packets = 0.0;
};

// Six grids, each with four times the rays of the one before: the finest has about `finest_rays` and a round spacing.
// `own_grid_m` is one more, where it is none of them. Five packet numbers, each four times the one before: the last an
// eighth of the rays, none below what any round has. The reference has 4 times the rays of the finest grid and 16 times the
// most packets.
[[nodiscard]] TradeoffPlan plan_tradeoff(const RadiationModel& model, double finest_rays, std::optional<double> own_grid_m);

// How many times the seeds asked for a rung of grids or packets has that is so many before the last: what is cheap is
// repeated more often, four times at most, as slopes hang on all rungs alike.
[[nodiscard]] int seeds_factor(std::size_t before_last);

// The work of a ladder's rung and of a part of the reference.
[[nodiscard]] SolveSettings grid_settings(SolveSettings settings, double grid_m);
[[nodiscard]] SolveSettings packet_settings(SolveSettings settings, const RadiationModel& model, double packets);
[[nodiscard]] SolveSettings reference_settings(SolveSettings settings, const TradeoffPlan& plan);

}  // namespace sunfleck
