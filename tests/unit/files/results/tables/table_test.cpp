#include "files/results/tables/table.h"

#include "base/units.h"
#include "files/results/tables/day_tables.h"
#include "files/results/tables/element_fields.h"
#include "files/results/tables/plane_writer.h"
#include "files/results/tables/result_tables.h"
#include "files/results/tables/table_text.h"

#include <gtest/gtest.h>

namespace sunfleck {
namespace {

std::string below_head(const std::string& text) {
  return text.substr(text.find("# the units\n") + std::string("# the units\n").size());
}

Table empty_table(std::vector<std::size_t> shape) {
  return {"the content", "the units", std::move(shape)};
}

TEST(Table, WritesEveryKindOfValue) {
  Table table = empty_table({3});
  const std::vector<std::int32_t> numbers{1, 0, -1};
  const std::vector<std::int32_t> kinds{1, 0, 1};
  const std::vector<std::string> kind_names{"leaf", "a, b"};
  table.columns.push_back({.name = "row", .values = RowNumbers{3}});
  table.add_view({"number", "1", ""}, numbers);
  table.add_view({"kind", "1", "", in_csv, {}, kind_names}, kinds);
  table.add({"share", "1", ""}, [](std::size_t i) { return i == 1 ? no_value : 1.0 / 3.0; });
  table.add({"plant", "1", ""}, [](std::size_t i) { return static_cast<std::uint32_t>(i) + 4000000000U; });
  table.add({"text", "", ""}, [](std::size_t i) { return std::string(i, '"'); });
  EXPECT_EQ(below_head(csv_text({}, table)),
            "row,number,kind,share,plant,text\n0,1,\"a, b\",0.333333333,4000000000,\n1,0,leaf,,4000000001,\"\"\"\"\n2,-1,\"a, "
            "b\",0.333333333,4000000002,\"\"\"\"\"\"\n");
}

// A reader that skips comments would end the row there.
TEST(Table, QuotesWhatLooksLikeAComment) {
  Table table = empty_table({1});
  table.add({"organ", "", ""}, [](std::size_t) { return std::string("leaf#1"); });
  table.add({"rank", "1", ""}, [](std::size_t) { return 2.0; });
  EXPECT_EQ(below_head(csv_text({}, table)), "organ,rank\n\"leaf#1\",2\n");
}

TEST(Table, HeadAndNotesComeFirst) {
  Table table = empty_table({0});
  table.notes = {"a note", "another"};
  table.add({"a", "1", ""}, std::vector<double>{});
  RunRecord record;
  record.title = "Title";
  EXPECT_EQ(csv_text(record, table),
            "# Title\n# the content\n# seed 1, confidence 0.95\n# the units\n# a note\n# another\na\n");
}

TEST(Table, AColumnIsInTheOutputsItNames) {
  Table table = empty_table({1});
  table.add({"nowhere", "1", "", 0}, std::vector{1.0});
  table.add({"csv", "1", "", in_csv}, std::vector{2.0});
  table.add({"arrays", "1", "", in_arrays | in_netcdf}, std::vector{3.0});
  table.add({"both", "1", ""}, std::vector{4.0});
  EXPECT_EQ(below_head(csv_text({}, table)), "csv,both\n2,4\n");
  EXPECT_TRUE(table.columns[2].is_in(in_netcdf));
  EXPECT_FALSE(table.columns[3].is_in(in_netcdf));
}

TEST(Table, RowsRunThroughTheAxesTheLastFastest) {
  Table table = empty_table({2, 3});
  const std::vector<std::size_t> once, slow{0}, fast{1};
  table.add({"all", "1", ""}, [](std::size_t i) { return static_cast<std::int32_t>(i); });
  table.add({"once", "1", "", in_csv, once}, std::vector{7.0});
  table.add({"slow", "1", "", in_csv, slow}, [](std::size_t i) { return std::string(1, "AB"[i]); });
  table.add({"fast", "1", "", in_csv, fast}, [](std::size_t i) { return std::string(1, "xyz"[i]); });
  EXPECT_EQ(table.rows(), 6U);
  EXPECT_EQ(table.values_along(table.columns[2].axes), 2U);
  EXPECT_EQ(below_head(csv_text({}, table)), "all,once,slow,fast\n0,7,A,x\n1,7,A,y\n2,7,A,z\n3,7,B,x\n4,7,B,y\n5,7,B,z\n");
}

TEST(Table, AnEstimateIsTwoColumns) {
  Table table = empty_table({2});
  table.add({"flux", "W m-2", "flux"}, [](std::size_t i) { return i == 0 ? Estimate{2.0, 0.5} : Estimate{3.0}; });
  ASSERT_EQ(table.columns.size(), 2U);
  EXPECT_EQ(table.columns[0].error_column, "flux_error");
  EXPECT_EQ(table.columns[1].name, "flux_error");
  EXPECT_EQ(table.columns[1].unit, "W m-2");
  EXPECT_EQ(table.columns[1].meaning, "half-width of the confidence interval of flux");
  EXPECT_EQ(table.columns[1].error_column, "");
  EXPECT_EQ(below_head(csv_text({}, table)), "flux,flux_error\n2,0.5\n3,\n");
}

TEST(Table, AViewCopiesNothingAndACopyOfTheTableKeepsItsValues) {
  const std::vector<double> fields{1.0, 2.0};
  Table copy;
  {
    Table table = empty_table({2});
    table.add_view({"view", "1", ""}, fields);
    table.add({"own", "1", ""}, std::vector{5.0, 6.0});
    copy = table;
  }
  EXPECT_EQ(std::get<std::span<const double>>(copy.columns[0].values).data(), fields.data());
  EXPECT_EQ(copy.columns[0].owner, nullptr);
  EXPECT_EQ(std::get<std::span<const double>>(copy.columns[1].values)[1], 6.0);
}

TEST(Table, SharesAreAtMostOne) {
  EXPECT_EQ(as_share({1.5, 0.7}).value, 1.0);
  EXPECT_EQ(as_share({1.5, 0.7}).half_width, 0.7);
  EXPECT_EQ(as_share({0.5, 0.7}).value, 0.5);
}

// X_error means one thing in every table: the half-width of X, in the unit of X, in the next column. So photons have errors of
// their own.
TEST(Table, AnErrorIsTheHalfWidthOfTheColumnBeforeIt) {
  RadiationModel model;
  model.bands = {{"PAR", 100.0, 0.0, 4.57}};
  model.sun = SunPosition{0.5, 1.0};
  RadiationResult result;
  result.planes.resize(1);
  result.planes[0].cells_x = result.planes[0].cells_z = 1;
  model.planes = {{0.5, 1, 1}};
  model.sensors = {{"point", {{0.5, 0.0, 0.5}}}};
  result.sensors = {{SensorResult{{{1, 0}}, {{1, 0}}, {{1, 0}}, {{1, 0}}}}};
  result.sensor_means = result.sensors[0];
  const DayCourse course;
  const DayStand stand(model);
  const DayPart day(course, {});
  const ElementFields fields = make_element_fields(model, result);
  std::size_t errors = 0;
  std::vector<Table> tables = {organs_table(model, result),   plants_table(model, result),  layers_table(model, result),
                               balance_table(result),         sensors_table(model, result), sensor_means_table(model, result),
                               plane_table(model, result, 0), triangles_table(fields),      organ_steps_table(stand, day)};
  for (const DayTable& table : day_tables(model)) tables.push_back(table.make(stand, day));
  EXPECT_EQ(tables.size(), 19U);
  for (const Table& table : tables) {
    for (std::size_t i = 0; i < table.columns.size(); ++i) {
      const Column& error = table.columns[i];
      if (!error.name.ends_with("_error")) continue;
      ++errors;
      ASSERT_GT(i, 0U);
      const Column& column = table.columns[i - 1];
      EXPECT_EQ(error.name, column.name + "_error") << table.content;
      EXPECT_EQ(error.name, column.error_column) << table.content;
      EXPECT_EQ(error.unit, column.unit) << error.name;
      EXPECT_EQ(error.outputs, column.outputs) << error.name;
    }
    for (const Column& column : table.columns) {
      const bool is_estimate = column.name.ends_with("_absorbed") || column.name.find("mol") != std::string::npos;
      if (!is_estimate || column.name.ends_with("_error")) continue;
      EXPECT_EQ(column.error_column, column.name + "_error") << table.content;
    }
  }
  EXPECT_GT(errors, 30U);
}

// Readers of a column must be able to find out what it is, so every column of numbers has a unit and every column a meaning.
TEST(Table, TheColumnsOfAResultAreDescribed) {
  RadiationModel model;
  model.bands = {{"PAR", 100.0, 0.0, 4.57}};
  for (const Table& table : {organs_table(model, {}), layers_table(model, {}), sensors_table(model, {}),
                             sensor_means_table(model, {}), balance_table({})}) {
    EXPECT_GT(table.columns.size(), 5U);
    for (const Column& column : table.columns) {
      EXPECT_NE(column.meaning, "") << column.name;
      EXPECT_EQ(column.unit.empty(), std::holds_alternative<std::span<const std::string>>(column.values)) << column.name;
    }
  }
}

}  // namespace
}  // namespace sunfleck
