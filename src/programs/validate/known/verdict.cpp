#include "programs/validate/known/verdict.h"

#include "physics/transport/model/statistics.h"

#include <cmath>

namespace sunfleck {

std::optional<double> KnownAnswer::z() const {
  if (!(standard_error > 0.0)) return std::nullopt;
  return (got - expected) / standard_error;
}

double table_quantile(std::size_t comparisons, std::size_t replicates) {
  return t_quantile(std::pow(1.0 - 0.001, 1.0 / static_cast<double>(comparisons)), replicates);
}

bool passes(const KnownAnswer& answer, std::size_t comparisons) {
  if (!answer.trouble.empty()) return false;
  double by_chance = 0.0;
  if (answer.is_estimate()) {
    if (!(answer.standard_error <= answer.largest_error)) return false;
    by_chance = table_quantile(comparisons, answer.replicates) * answer.standard_error;
  }
  return std::abs(answer.got - answer.expected) <= by_chance + answer.tolerance;
}

}  // namespace sunfleck
