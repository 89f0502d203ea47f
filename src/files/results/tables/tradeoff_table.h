#pragma once
// The results of `tradeoff` as a table and as text.

#include "files/results/tables/result_writer.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace sunfleck {

// The quantities whose errors are measured, from coarse to fine.
enum class Quantity { canopy, layer, organ, triangle };
inline constexpr std::array quantities{Quantity::canopy, Quantity::layer, Quantity::organ, Quantity::triangle};
[[nodiscard]] const char* quantity_name(Quantity quantity);

// The setting that is varied: grid of the direct pass, packets of the indirect pass, error bound of whole runs, or mesh.
enum class TradeoffSeries { grids, packets, bounds, meshes };
inline constexpr std::array all_series{TradeoffSeries::grids, TradeoffSeries::packets, TradeoffSeries::bounds,
                                       TradeoffSeries::meshes};

// Error of a quantity in one run: the root mean square of the relative errors of its values (organs, layers, ...). NaN if there
// is none.
struct QuantityError {
  double true_error = 0.0;  // against the reference; includes the reference's own error
  double largest = 0.0;     // largest relative error of a value; NaN for triangles
  double reported = 0.0;    // the same norm of the half-widths reported by the run
  double covered = 0.0;     // share of the values whose error lies within the reported half-width
};

struct TradeoffRun {
  std::uint64_t seed = 0;
  double seconds = 0.0;
  std::uint64_t rays = 0;               // rays and packets
  std::array<QuantityError, 4> errors;  // [quantity]
};

// The runs of one setting, with several seeds.
struct TradeoffLevel {
  TradeoffSeries series = TradeoffSeries::grids;
  // Grid in m, packets in the first round of a replicate, error bound, or share of the triangles.
  double value = 0.0;
  std::vector<TradeoffRun> runs;
  // [quantity], root mean square over the runs, corrected for the error of the reference; NaN if there is none.
  std::array<double, 4> error{};
};
[[nodiscard]] std::string setting_name(const TradeoffLevel& level);  // e.g. grid 0.0015
[[nodiscard]] double median_seconds(const TradeoffLevel& level);
[[nodiscard]] double mean_rays(const TradeoffLevel& level);

// The law error = factor * work^exponent, fitted to a series by least squares of the logarithms.
struct PowerLaw {
  double exponent = 0.0, factor = 1.0;
  double standard_error = 0.0;  // of the exponent; NaN for two points
  std::size_t points = 0;

  // Returns the half-width of the exponent's confidence interval; NaN for two points. Two parameters are fitted, so Student's t
  // has points - 2 degrees of freedom.
  [[nodiscard]] double half_width(double confidence) const;
};

struct TradeoffFit {
  TradeoffSeries series = TradeoffSeries::grids;
  Quantity quantity = Quantity::canopy;
  PowerLaw of_rays, of_seconds;
};

// The requested error, and the bound that achieves it.
struct Recommendation {
  double requested_error = 0.01;
  Quantity quantity = Quantity::organ;
  double bound = 0.0;     // for --error
  double seconds = 0.0;   // predicted run time on this device
  double expected = 0.0;  // expected error, root mean square over seeds
  double margin = 1.0;    // requested error / largest admissible `expected`
  bool extrapolated = false;
};

struct TradeoffReport {
  RunRecord record;
  int seeds = 0;                                           // number of seeds requested
  std::array<std::array<double, 4>, 3> reference_error{};  // [grids, packets, bounds][quantity]
  std::array<std::uint64_t, 3> reference_rays{};           // [grids, packets, bounds], rays and packets; 0: not simulated
  std::vector<TradeoffLevel> levels;
  std::vector<TradeoffFit> fits;
  std::optional<Recommendation> recommendation;
  std::optional<double> marked_grid_m;
  double total_seconds = 0.0;
};

[[nodiscard]] std::string tradeoff_csv(const TradeoffReport& report);
[[nodiscard]] std::string tradeoff_json(const TradeoffReport& report);

// Returns e.g. "for 1 % per organ: --error 0.004, about 9 s on this device".
[[nodiscard]] std::string recommendation_line(const Recommendation& recommendation);

}  // namespace sunfleck
