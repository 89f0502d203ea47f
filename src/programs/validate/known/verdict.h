#pragma once
// One row of the table of known answers, and the rule by which it passes.

#include <cstddef>
#include <optional>
#include <string>

namespace sunfleck {

struct KnownAnswer {
  std::string name;  // "group: what is compared"
  double expected = 0.0;
  double got = 0.0;
  double standard_error = 0.0;  // of the difference; 0: no chance involved
  std::size_t replicates = 0;   // behind the standard error; 0: the value is not an estimate
  double largest_error = 0.0;   // for an estimate: a larger standard error would hide mistakes
  double tolerance = 1e-6;      // allowed for rounding or the reference's last digit, in addition to the standard error
  std::string trouble;          // reason why the case has no answer; empty if it has one

  [[nodiscard]] std::optional<double> z() const;  // none without a standard error
  [[nodiscard]] bool is_estimate() const { return replicates > 0; }
};

// Returns the limit for `comparisons` estimates: Student's t, in standard errors, that any of them exceeds by chance in only
// one of a thousand tables (Sidak 1967, J. Am. Stat. Assoc. 62:626).
[[nodiscard]] double table_quantile(std::size_t comparisons, std::size_t replicates);

// Returns true if the answer is right as far as a table with that many estimates can tell.
[[nodiscard]] bool passes(const KnownAnswer& answer, std::size_t comparisons);

}  // namespace sunfleck
