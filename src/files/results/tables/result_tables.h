#pragma once
// The contents of the result tables: one function per table, one line per column. Tables of days and planes have files of their
// own.

#include "files/results/tables/sensor_reading.h"
#include "files/results/tables/table.h"
#include "physics/transport/model/model.h"
#include "physics/transport/model/result.h"

#include <array>
#include <cstddef>
#include <functional>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

namespace sunfleck {

// Adds plant, name and rank of each organ, which vary along one axis of the table.
void add_organ_names(Table& table, const std::vector<Organ>& organs, std::size_t axis);

// Adds the column `role` of organs, which lie along that axis of the table.
void add_organ_roles(Table& table, std::span<const Role> roles, std::size_t axis);

// Adds the columns x, y and z of positions, given in the scene's coordinates, along these axes of the table.
void add_positions(Table& table, const Plot& plot, const std::optional<std::vector<std::size_t>>& axes,
                   const std::function<glm::dvec3(std::size_t)>& position_of);

// Adds the columns of the readings of sensors; reading_of(row, band) returns that of a row.
void add_readings(Table& table, const std::vector<Waveband>& bands, unsigned outputs,
                  const std::function<SensorReading(std::size_t, std::size_t)>& reading_of);
inline constexpr const char* reading_units =
    "direct, sky, scattered: W m-2, on a plane (cosine response) or on a sphere's cross-section (spherical); total: their sum; "
    "total_umol_m2_s: the same in photons, umol m-2 s-1; _error: half-width of the confidence interval";

// Adds the areas of the sunlit and the shaded class and what each absorbs per area of its own, in all bands. `of` says in the
// meanings whose area it is. Areas are in m2 or, with a ground area, leaf area indices. Rows for which `classes_of` returns
// null, or classes without bands, have no values.
void add_classes(Table& table, const RadiationModel& model, const char* of, std::optional<double> ground_m2, unsigned outputs,
                 const std::function<const ShadeClassResult*(std::size_t)>& classes_of);

// organs.csv: one row per organ of the canopy, in its order, including soil elements of a mesh (organ soil; plant 0 in a .can).
// The ground of [soil] is not an organ and has no row; absorbed_soil in the summary covers both.
[[nodiscard]] Table organs_table(const RadiationModel& model, const RadiationResult& result);

// plants.csv: one row per plant with leaves, stems or fruits, ascending by number.
[[nodiscard]] Table plants_table(const RadiationModel& model, const RadiationResult& result);

// profile.csv: one row per layer and one for the top plane. The columns of results.nc are those of the planes.
[[nodiscard]] Table layers_table(const RadiationModel& model, const RadiationResult& result);

// The energy balance in results.nc and xarray: one row per band.
[[nodiscard]] Table balance_table(const RadiationResult& result);

// sensors.csv: one row per point, in the order of the scene, of all sensors or of one. The result must have readings of all
// sensors of the model.
[[nodiscard]] Table sensors_table(const RadiationModel& model, const RadiationResult& result);
[[nodiscard]] Table sensor_table(const RadiationModel& model, const RadiationResult& result, std::size_t sensor);

// sensor_means.csv: one row per sensor, the mean over its points.
[[nodiscard]] Table sensor_means_table(const RadiationModel& model, const RadiationResult& result);

// A table of a run and the name of its file.
struct ResultTable {
  const char* file;
  Table (*make)(const RadiationModel& model, const RadiationResult& result);
  bool of_sensors = false;

  [[nodiscard]] bool is_of(const RadiationResult& result) const { return !of_sensors || !result.sensors.empty(); }
};
// All of them but those of triangles and planes.
inline constexpr std::array<ResultTable, 5> result_tables = {{{"profile.csv", layers_table},
                                                              {"organs.csv", organs_table},
                                                              {"plants.csv", plants_table},
                                                              {"sensors.csv", sensors_table, true},
                                                              {"sensor_means.csv", sensor_means_table, true}}};

}  // namespace sunfleck
