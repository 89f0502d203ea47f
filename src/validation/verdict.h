#pragma once
// A row of the table of known answers, and when it passes.

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace sunfleck {

struct KnownAnswer {
  std::string name;  // "group: what is compared"
  double expected = 0.0;
  double got = 0.0;
  double standard_error = 0.0;  // of the difference; 0: nothing is left to chance
  std::size_t replicates = 0;   // behind the standard error; 0: the value is no estimate
  double largest_error = 0.0;   // of an estimate: a larger standard error would hide mistakes
  double tolerance = 1e-6;      // what rounding, or the reference's last digit, leaves open; beside the standard error
  std::string trouble;          // what kept the case from its answer; empty if it has one

  [[nodiscard]] std::optional<double> z() const;  // none without a standard error
  [[nodiscard]] bool is_estimate() const { return replicates > 0; }
};

// How far chance may take `comparisons` estimates: Student's t, in standard errors, that all of them together exceed by chance
// once in a thousand tables (Sidak 1967, J. Am. Stat. Assoc. 62:626).
[[nodiscard]] double table_quantile(std::size_t comparisons, std::size_t replicates);

// True if the answer is right as far as a table with so many estimates can tell.
[[nodiscard]] bool passes(const KnownAnswer& answer, std::size_t comparisons);

}  // namespace sunfleck
