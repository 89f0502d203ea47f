// Tests sensors.csv.

#include "files/results/tables/result_writer.h"

#include <gtest/gtest.h>

namespace sunfleck {
namespace {

TEST(SensorWriter, WritesARowForEachPoint) {
  RadiationModel model;
  model.bands = {{"PAR", 1.0, 1.0}, {"NIR", 1.0, 1.0}};
  model.sensors = {{"pole, left", {{0.1, 0.25, 1e-9}, {0.1, 1.0 / 3.0, 2.0}}, SensorResponse::cosine, {0, 1, 0}},
                   {"ball", {{1, 2, 3}}, SensorResponse::spherical, {0, 1, 0}}};
  RadiationResult result;
  const SensorResult reading{{{1, 0}, {2, 0}}, {{3, 0.5}, {4, 0.25}}, {{5, 0.125}, {6, 0.0625}}};
  result.sensors = {{reading, reading}, {reading}};
  RunRecord record;
  record.title = "two\nlines";
  record.seed = 7;
  const std::string text = sensors_csv(record, model, result);
  const std::string values = "1,0,3,0.5,5,0.125,2,0,4,0.25,6,0.0625\n";
  EXPECT_TRUE(text.starts_with("# two lines\n# Sensors, point by point\n# seed 7, confidence 0.95\n# x, y, z: m")) << text;
  EXPECT_EQ(text.substr(text.find("\nsensor") + 1),
            "sensor,point,x,y,z,PAR_direct,PAR_direct_error,PAR_sky,PAR_sky_error,PAR_scattered,PAR_scattered_error,"
            "NIR_direct,NIR_direct_error,NIR_sky,NIR_sky_error,NIR_scattered,NIR_scattered_error\n"
            "\"pole, left\",0,0.1,0.25,1e-09," +
                values + "\"pole, left\",1,0.1,0.333333333,2," + values + "ball,0,1,2,3," + values);
}

TEST(SensorWriter, WithoutSensorsThereIsTheHead) {
  RadiationModel model;
  model.bands = {{"PAR", 1.0, 1.0}};
  const std::string text = sensors_csv({}, model, {});
  EXPECT_TRUE(text.ends_with("PAR_scattered,PAR_scattered_error\n"));
}

}  // namespace
}  // namespace sunfleck
