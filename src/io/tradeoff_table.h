#pragma once
// What `tradeoff` found out: its table and its figures as text.

#include "io/result_writer.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace sunfleck {

// What an error is asked of, from coarse to fine.
enum class Quantity { canopy, layer, organ, triangle };
inline constexpr std::array quantities{Quantity::canopy, Quantity::layer, Quantity::organ, Quantity::triangle};
[[nodiscard]] const char* quantity_name(Quantity quantity);

// What is varied: the grid of the direct pass, the packets of the indirect one, the bound of whole runs, the mesh.
enum class Ladder { grids, packets, bounds, meshes };
inline constexpr std::array ladders{Ladder::grids, Ladder::packets, Ladder::bounds, Ladder::meshes};

// A quantity's error in one run: the root mean square over its values (organs, layers, ...) of their errors, each relative to
// its value. NaN where there is none.
struct QuantityError {
  double true_error = 0.0;  // against the reference, whose own error it holds
  double largest = 0.0;     // of the values; NaN for triangles
  double reported = 0.0;    // the same norm of the half-widths that the run reports
  double covered = 0.0;     // share of the values that the reported half-widths reach
};

struct TradeoffRun {
  std::uint64_t seed = 0;
  double seconds = 0.0;
  std::uint64_t rays = 0;               // and packets
  std::array<QuantityError, 4> errors;  // [quantity]
};

// One setting, and the same with several seeds.
struct TradeoffRung {
  Ladder ladder = Ladder::grids;
  double value = 0.0;  // grid: m; packets: of the first round of a replicate; bound; share of the triangles
  std::vector<TradeoffRun> runs;
  std::array<double, 4> error{};  // [quantity], root mean square over the runs, the reference's error taken out; NaN if none
};
[[nodiscard]] std::string setting_name(const TradeoffRung& rung);  // grid 0.0015, ...
[[nodiscard]] double median_seconds(const TradeoffRung& rung);
[[nodiscard]] double mean_rays(const TradeoffRung& rung);

// error = factor * work^exponent, fitted to a ladder by least squares of the logarithms.
struct PowerLaw {
  double exponent = 0.0, factor = 1.0;
  double standard_error = 0.0;  // of the exponent; NaN for two points
};

struct TradeoffFit {
  Ladder ladder = Ladder::grids;
  Quantity quantity = Quantity::canopy;
  PowerLaw of_rays, of_seconds;
};

// What was asked for, and the bound that gives it.
struct Recommendation {
  double asked_error = 0.01;
  Quantity quantity = Quantity::organ;
  double bound = 0.0;     // for --error
  double seconds = 0.0;   // foreseen, on this device
  double expected = 0.0;  // error of a typical run, root mean square over seeds
  double margin = 1.0;    // asked error / the most that `expected` may be
  bool extrapolated = false;
};

struct TradeoffReport {
  RunRecord record;
  int seeds = 0;                                           // asked for
  std::array<std::array<double, 4>, 3> reference_error{};  // [grids, packets, bounds][quantity]
  std::array<std::uint64_t, 3> reference_rays{};           // [grids, packets, bounds], and packets; 0: not simulated
  std::vector<TradeoffRung> rungs;
  std::vector<TradeoffFit> fits;
  std::optional<Recommendation> recommendation;
  std::optional<double> marked_grid_m;
  double total_seconds = 0.0;
};

[[nodiscard]] std::string tradeoff_csv(const TradeoffReport& report);
[[nodiscard]] std::string tradeoff_json(const TradeoffReport& report);

// "for 1 % per organ: --error 0.004, about 9 s on this device"
[[nodiscard]] std::string recommendation_line(const Recommendation& recommendation);

}  // namespace sunfleck
