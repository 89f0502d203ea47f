#pragma once
// Parts of the summaries in JSON.

#include "physics/transport/model/statistics.h"
#include "physics/transport/model/surfaces.h"

#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>

namespace sunfleck {

[[nodiscard]] inline nlohmann::ordered_json number_or_null(double value) {
  return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
}

template <class T>
[[nodiscard]] nlohmann::ordered_json value_or_null(const std::optional<T>& value) {
  return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json(nullptr);
}

[[nodiscard]] inline nlohmann::ordered_json estimate_json(const Estimate& estimate) {
  return {{"value", number_or_null(estimate.value)}, {"error", number_or_null(estimate.half_width)}};
}

// Returns the one-sided area of each role, m2, without roles that no surface has.
[[nodiscard]] inline nlohmann::ordered_json area_by_role_json(const RadiationModel& model) {
  const auto areas_m2 = area_of_roles_m2(model);
  nlohmann::ordered_json by_role = nlohmann::ordered_json::object();
  for (std::size_t role = 0; role < areas_m2.size(); ++role) {
    if (areas_m2[role] > 0.0) by_role[std::string(role_names[role])] = areas_m2[role];
  }
  return by_role;
}

// Returns how many plants have a number, with or without vegetation; 0 is that of soil.
[[nodiscard]] inline std::size_t numbered_plants(const Canopy& canopy) {
  std::set<std::uint32_t> plants;
  for (const Organ& organ : canopy.organs) {
    if (organ.plant > 0) plants.insert(organ.plant);
  }
  return plants.size();
}

}  // namespace sunfleck
