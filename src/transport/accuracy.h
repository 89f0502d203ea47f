#pragma once
// The error bounds a run promises.

namespace sunfleck {

enum class ErrorTarget { canopy, organ, triangle };

// Relative half-widths of the confidence intervals, and what they are promised for.
struct Accuracy {
  double direct = 0.001;  // > 0
  double indirect = 0.003;
  double confidence = 0.95;  // 0.5..0.9999
  ErrorTarget of = ErrorTarget::canopy;
};

}  // namespace sunfleck
