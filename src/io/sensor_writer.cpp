#include "io/sensor_writer.h"

#include "base/check.h"
#include "io/table_text.h"

#include <fmt/format.h>

namespace sunfleck {

std::string sensors_csv(const RunRecord& record, const RadiationModel& model, const RadiationResult& result) {
  EXPECT(result.sensors.size(), ==, model.sensors.size());
  std::string text =
      table_head(record, "Sensors, point by point",
                 "x, y, z: m (X south, Y up, Z west); direct, sky, scattered: W m-2, on a plane (cosine response) or on a "
                 "sphere's cross-section (spherical); _error: half-width of the confidence interval");
  text += "sensor,point,x,y,z";
  for (const Waveband& band : model.bands) {
    for (const char* column : {"direct", "sky", "scattered"}) text += fmt::format(",{0}_{1},{0}_{1}_error", band.name, column);
  }
  text += '\n';
  for (std::size_t s = 0; s < model.sensors.size(); ++s) {
    const Sensor& sensor = model.sensors[s];
    EXPECT(result.sensors[s].size(), ==, sensor.points_m.size());
    for (std::size_t p = 0; p < sensor.points_m.size(); ++p) {
      std::string row = fmt::format("{},{}", csv_field(sensor.name), p);
      for (int axis = 0; axis < 3; ++axis) append_number(row, sensor.points_m[p][axis]);
      const SensorResult& reading = result.sensors[s][p];
      for (std::size_t b = 0; b < model.bands.size(); ++b) {
        for (const auto* column : {&reading.direct, &reading.sky, &reading.scattered}) append_estimate(row, (*column)[b]);
      }
      text += row + '\n';
    }
  }
  return text;
}

}  // namespace sunfleck
