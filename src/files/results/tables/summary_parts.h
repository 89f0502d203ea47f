#pragma once
// Parts of the summaries in JSON.

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

// Returns the one-sided area of each role, m2, without roles that no surface has.
[[nodiscard]] inline nlohmann::ordered_json area_by_role_json(const RadiationModel& model) {
  const auto areas_m2 = area_of_roles_m2(model);
  nlohmann::ordered_json by_role = nlohmann::ordered_json::object();
  for (std::size_t role = 0; role < areas_m2.size(); ++role) {
    if (areas_m2[role] > 0.0) by_role[std::string(role_names[role])] = areas_m2[role];
  }
  return by_role;
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
