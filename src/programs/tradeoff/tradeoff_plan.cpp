#include "programs/tradeoff/tradeoff_plan.h"

#include "physics/transport/model/surfaces.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace sunfleck {
namespace {

constexpr int grid_levels = 6;  // three decades of rays
constexpr int packet_levels = 5;
constexpr double least_packets = 256;    // no round has fewer, since below this the work hardly falls
constexpr double rays_per_packet = 8.0;  // at the finest settings: a packet costs more and contributes as much
constexpr double level_refinement = 4.0;
constexpr double reference_rays = 4.0, reference_packets = 16.0;  // relative to those of the finest setting

// Returns the nearest number that stays short when doubled.
double round_number(double value) {
  const double decade = std::pow(10.0, std::floor(std::log10(value)));
  double nearest = decade;
  for (const double digits : {1.25, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 7.5, 10.0}) {
    if (std::abs(std::log(value / (digits * decade))) < std::abs(std::log(value / nearest))) nearest = digits * decade;
  }
  return nearest;
}

double grid_of_m(const RadiationModel& model, double rays) {
  return std::sqrt(model.plot.area_m2() / rays);
}

}  // namespace

TradeoffPlan plan_tradeoff(const RadiationModel& model, double finest_rays, std::optional<double> own_grid_m) {
  TradeoffPlan plan;
  const double finest_m = round_number(grid_of_m(model, finest_rays));
  if (model.has_beam()) {
    for (int k = 0; k < grid_levels; ++k) plan.grids_m.push_back(finest_m * std::pow(level_refinement, 0.5 * k));
    if (own_grid_m) {
      const auto same = [&](double grid_m) { return std::abs(grid_m / *own_grid_m - 1.0) < 1e-6; };
      if (std::none_of(plan.grids_m.begin(), plan.grids_m.end(), same)) plan.grids_m.push_back(*own_grid_m);
    }
    std::sort(plan.grids_m.begin(), plan.grids_m.end(), std::greater<>());
  }
  const double most_packets =
      std::exp2(std::round(std::log2(std::max(1.0, finest_rays / rays_per_packet / tradeoff_replicates))));
  if (scatters(model) || model.has_sky()) {
    for (int k = packet_levels; k-- > 0;) {
      const double packets = most_packets / std::pow(level_refinement, k);
      if (packets >= least_packets || k == 0) plan.packets.push_back(packets);
    }
  }
  const double least_m = plan.grids_m.empty() ? finest_m : std::min(finest_m, plan.grids_m.back());
  plan.reference_grid_m = least_m * std::sqrt(reference_parts / reference_rays);
  plan.reference_packets = most_packets * reference_packets / reference_parts;
  return plan;
}

int seeds_factor(std::size_t before_last) {
  return before_last == 0 ? 1 : before_last == 1 ? 2 : 4;
}

SolveSettings grid_settings(SolveSettings settings, double grid_m) {
  settings.grid_m = grid_m;
  settings.passes = tradeoff_replicates;
  settings.packets.reset();
  return settings;
}

SolveSettings packet_settings(SolveSettings settings, const RadiationModel& model, double packets) {
  settings = grid_settings(settings, grid_of_m(model, packets * tradeoff_replicates));
  settings.packets = packets;
  return settings;
}

SolveSettings reference_settings(SolveSettings settings, const TradeoffPlan& plan) {
  settings = grid_settings(settings, plan.reference_grid_m);
  settings.packets = plan.reference_packets;
  return settings;
}

}  // namespace sunfleck
