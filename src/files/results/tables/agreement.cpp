#include "files/results/tables/agreement.h"

#include "base/check.h"
#include "base/file.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

namespace sunfleck {
namespace {

std::string figure(double value) {
  return std::isnan(value) ? std::string("undefined") : fmt::format("{:.3f}", value);
}

double mean(std::span<const double> values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

}  // namespace

Agreement agreement(std::span<const double> simulated, std::span<const double> measured) {
  EXPECT(simulated.size(), ==, measured.size());
  EXPECT(simulated.size(), >, std::size_t{0});
  constexpr double undefined = std::numeric_limits<double>::quiet_NaN();
  const double mean_simulated = mean(simulated);
  const double mean_measured = mean(measured);
  double ss = 0.0, sm = 0.0, mm = 0.0, squared_differences = 0.0;
  for (std::size_t i = 0; i < simulated.size(); ++i) {
    const double s = simulated[i] - mean_simulated;
    const double m = measured[i] - mean_measured;
    ss += s * s;
    sm += s * m;
    mm += m * m;
    squared_differences += (simulated[i] - measured[i]) * (simulated[i] - measured[i]);
  }
  Agreement figures;
  figures.n = simulated.size();
  figures.rmse = std::sqrt(squared_differences / static_cast<double>(figures.n));
  figures.slope = mm > 0.0 ? sm / mm : undefined;
  figures.intercept = mean_simulated - figures.slope * mean_measured;
  figures.r2 = mm > 0.0 && ss > 0.0 ? sm / mm * (sm / ss) : undefined;
  return figures;
}

std::string agreement_figures(const Agreement& figures) {
  return fmt::format("n {}, R2 {}, RMSE {:.3f}, slope {}", figures.n, figure(figures.r2), figures.rmse, figure(figures.slope));
}

std::string agreement_line(std::string_view file, const Agreement& figures) {
  return fmt::format("agreement with {}: {}", printable(file), agreement_figures(figures));
}

}  // namespace sunfleck
