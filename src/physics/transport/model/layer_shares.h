#pragma once
// Which part of an element lies in each layer.

#include "physics/transport/model/counters.h"

#include <cstddef>
#include <vector>

namespace sunfleck {

class LayerShares {
 public:
  // The layout must outlive the object.
  explicit LayerShares(const CounterLayout& layout)
      : layout_(layout), area_m2_(static_cast<std::size_t>(layout.layers.count)) {}

  // Calls take(layer, share of the element's area) for each layer that an element reaches into.
  template <class Take>
  void visit(std::size_t e, const Triangle& corners, const Take& take) {
    const std::size_t first = first_layer(layout_, corners);
    const std::size_t end = layout_.end_layer(e, first);
    if (end - first == 1) return take(first, 1.0);
    add_area_by_layer(layout_.layers, corners, area_m2_);
    double all_m2 = 0.0;
    for (std::size_t k = first; k < end; ++k) all_m2 += area_m2_[k];
    for (std::size_t k = first; k < end; ++k) {
      if (all_m2 > 0.0) take(k, area_m2_[k] / all_m2);
      area_m2_[k] = 0.0;
    }
  }

 private:
  const CounterLayout& layout_;
  std::vector<double> area_m2_;  // [layer], 0 between two calls
};

}  // namespace sunfleck
