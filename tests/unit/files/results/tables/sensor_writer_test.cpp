// Tests sensors.csv and sensor_means.csv.

#include "files/results/tables/result_tables.h"
#include "files/results/tables/table_text.h"

#include <gtest/gtest.h>

namespace sunfleck {
namespace {

TEST(SensorWriter, WritesARowForEachPoint) {
  RadiationModel model;
  model.bands = {{"PAR", 1.0, 1.0, 4.0}, {"NIR", 1.0, 1.0}};
  model.sensors = {{"pole, left", {{0.1, 0.25, 1e-9}, {0.1, 1.0 / 3.0, 2.0}}, SensorResponse::cosine, {0, 1, 0}},
                   {"ball", {{1, 2, 3}}, SensorResponse::spherical, {0, 1, 0}}};
  RadiationResult result;
  const SensorResult reading{{{1, 0}, {2, 0}}, {{3, 0.5}, {4, 0.25}}, {{5, 0.125}, {6, 0.0625}}, {{9, 0.75}, {12, 0.5}}};
  result.sensors = {{reading, reading}, {reading}};
  result.sensor_means = {reading, reading};
  RunRecord record;
  record.title = "two\nlines";
  record.seed = 7;
  const std::string text = csv_text(record, sensors_table(model, result));
  const std::string values = "1,0,3,0.5,5,0.125,9,0.75,36,3,2,0,4,0.25,6,0.0625,12,0.5\n";
  const std::string columns =
      "PAR_direct,PAR_direct_error,PAR_sky,PAR_sky_error,PAR_scattered,PAR_scattered_error,PAR_total,PAR_total_error,"
      "PAR_total_umol_m2_s,PAR_total_umol_m2_s_error,NIR_direct,NIR_direct_error,NIR_sky,NIR_sky_error,NIR_scattered,"
      "NIR_scattered_error,NIR_total,NIR_total_error\n";
  EXPECT_TRUE(text.starts_with("# two lines\n# Sensors, point by point\n# seed 7, confidence 0.95\n# x, y, z: m")) << text;
  EXPECT_EQ(text.substr(text.find("\nsensor") + 1), "sensor,point,x,y,z," + columns + "\"pole, left\",0,0.1,0.25,1e-09," +
                                                        values + "\"pole, left\",1,0.1,0.333333333,2," + values +
                                                        "ball,0,1,2,3," + values);
  const std::string means = csv_text(record, sensor_means_table(model, result));
  EXPECT_EQ(means.substr(means.find("\nsensor") + 1),
            "sensor,points," + columns + "\"pole, left\",2," + values + "ball,1," + values);
}

TEST(SensorWriter, WithoutSensorsThereIsTheHead) {
  RadiationModel model;
  model.bands = {{"PAR", 1.0, 1.0}};
  const std::string text = csv_text({}, sensors_table(model, {}));
  EXPECT_TRUE(text.ends_with("PAR_total,PAR_total_error\n"));
}

}  // namespace
}  // namespace sunfleck
