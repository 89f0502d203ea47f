#pragma once
// Parts of the summaries in JSON.

#include "physics/canopy/canopy.h"

#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

namespace sunfleck {

[[nodiscard]] inline nlohmann::ordered_json number_or_null(double value) {
  return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
}

template <class T>
[[nodiscard]] nlohmann::ordered_json value_or_null(const std::optional<T>& value) {
  return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json(nullptr);
}

// Returns the number of plants; plant 0 is soil.
[[nodiscard]] inline std::size_t plant_count(const Canopy& canopy) {
  std::set<std::uint32_t> plants;
  for (const Organ& organ : canopy.organs) {
    if (organ.plant > 0) plants.insert(organ.plant);
  }
  return plants.size();
}

}  // namespace sunfleck
