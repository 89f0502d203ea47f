#pragma once
// Compares figures with their errors, one by one and as a whole.

#include "long/differential_figures.h"

#include <cstddef>
#include <string>
#include <vector>

namespace sunfleck::test::differential {

class Comparison {
 public:
  // `replicates` is the least number behind any standard error, `quantile` that of the program's half-widths.
  Comparison(std::size_t replicates, double quantile) : replicates_(replicates), quantile_(quantile) {}

  // Adds one figure, as the program states it and as it was traced.
  void add(const std::string& name, const Stated& program, const Stated& traced);

  // Expects the root mean square of z to lie between 0.9 and 1.1, and no deviation to exceed the Sidak limit for all of them.
  void expect_agreement(const std::string& kind) const;

 private:
  struct Deviation {
    std::string name;
    double z = 0.0;
    double program = 0.0, traced = 0.0;
    bool is_rare = false;
  };
  struct Exact {
    std::string name;
    Stated program;
    double traced = 0.0;
  };
  void expect_none_beyond(double limit) const;
  void expect_exact_ones(std::size_t count) const;

  std::size_t replicates_;
  double quantile_;
  std::vector<Deviation> deviations_;
  std::vector<Exact> exact_;  // traced without any spread
  std::size_t empty_ = 0, untold_ = 0;
};

}  // namespace sunfleck::test::differential
