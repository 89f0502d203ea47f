#pragma once
// The error bounds a run promises.

namespace sunfleck {

enum class ErrorTarget { canopy, organ, triangle };

// Whose spread over the replicates is kept besides that of bands, organs and layers: it costs memory and time.
enum class ElementErrors {
  skip,
  keep,        // of what each element absorbs
  keep_sides,  // and of what falls on either of its sides
};

// Relative half-widths of the confidence intervals, and what they are promised for.
struct Accuracy {
  double direct = 0.001;  // > 0
  double indirect = 0.003;
  double confidence = 0.95;  // 0.5..0.9999
  ErrorTarget of = ErrorTarget::canopy;
};

}  // namespace sunfleck
