#pragma once
// The reading of a sensor, or of one of its points, in one band.

#include "physics/transport/model/result.h"

#include <cstddef>

namespace sunfleck {

// As in SensorResult, W m-2; summed over a date J m-2.
struct SensorReading {
  Estimate direct, sky, scattered, total;

  SensorReading() = default;
  SensorReading(const SensorResult& result, std::size_t band)
      : direct(result.direct[band]), sky(result.sky[band]), scattered(result.scattered[band]), total(result.total[band]) {}

  template <class Self, class Archive>
  static void visit(Self& self, Archive& archive) {
    archive(self.direct, self.sky, self.scattered, self.total);
  }
};

}  // namespace sunfleck
