#include "files/results/tables/element_fields.h"

#include "base/error.h"
#include "base/file.h"
#include "files/formats/mesh/caribu_label.h"
#include "files/results/exports/caribu_writer.h"
#include "files/results/exports/record_entries.h"
#include "physics/canopy/axes.h"
#include "support/error_text.h"
#include "support/export_models.h"
#include "support/table.h"
#include "support/triangles_csv.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace sunfleck {
namespace {

using test::awkward_record;
using test::two_triangles;
using test::two_triangles_result;

const std::vector<double>& values(const ElementFields& fields, std::size_t band, LightColumn column) {
  for (const LightValues& light : fields.light.at(band)) {
    if (light.column == column) return light.values;
  }
  throw std::out_of_range("no such column");
}

std::string refusal(const Organ& organ) {
  return refusal_of([&] { static_cast<void>(caribu_label(organ, 0)); }, ErrorKind::failure);
}

TEST(ElementFields, ValuesByHand) {
  const ElementFields fields = make_element_fields(two_triangles(), two_triangles_result());
  ASSERT_EQ(fields.size(), 2U);
  EXPECT_EQ(fields.area_m2, (std::vector{0.5, 4.5}));
  EXPECT_NEAR(fields.centroid_m[0][1], 11.0, 1e-12);
  EXPECT_NEAR(fields.centroid_m[1][1], 2003.1, 1e-9);
  EXPECT_NEAR(fields.centroid_m[2][1], 31.0, 1e-12);
  // 20 and 4 landings, each of 0.01 m2 of level ground, hit 0.5 m2 from a beam of 200 W m-2.
  EXPECT_NEAR(values(fields, 1, LightColumn::direct_upper)[0], 80.0, 1e-9);
  EXPECT_NEAR(values(fields, 1, LightColumn::direct_lower)[0], 16.0, 1e-9);
  // 100 and 300 quanta of 0.01 W land on 0.5 m2, 50 of them from the sky.
  EXPECT_NEAR(values(fields, 1, LightColumn::indirect_upper)[0], 2.0, 1e-9);
  EXPECT_NEAR(values(fields, 1, LightColumn::indirect_lower)[0], 6.0, 1e-9);
  EXPECT_NEAR(values(fields, 1, LightColumn::sky_upper)[0], 1.0, 1e-9);
  EXPECT_EQ(values(fields, 1, LightColumn::sky_lower)[0], 0.0);
  EXPECT_NEAR(values(fields, 1, LightColumn::total)[0], 104.0, 1e-9);
  EXPECT_NEAR(values(fields, 1, LightColumn::absorbed)[0], 0.25 * 82.0 + 0.75 * 22.0, 1e-9);
  EXPECT_EQ(values(fields, 1, LightColumn::absorbed_error)[0], 0.75);
  EXPECT_TRUE(std::isnan(values(fields, 1, LightColumn::absorbed_error)[1]));
  EXPECT_EQ(fields.light[1][0].name, "B-2_direct_upper");
}

TEST(ElementFields, OrgansOfOneNameAreOneKind) {
  RadiationModel model = two_triangles();
  model.canopy.organs[1].name = "leaf";
  const ElementFields fields = make_element_fields(model, two_triangles_result());
  EXPECT_EQ(fields.organ_names, std::vector<std::string>{"leaf"});
  EXPECT_EQ(fields.organ, (std::vector<std::int32_t>{0, 0}));
  EXPECT_EQ(fields.optics, (std::vector<std::int32_t>{0, 1}));
}

TEST(ElementFields, SkyColumnsOnlyWithASky) {
  RadiationModel model = two_triangles();
  model.canopy.organs[1].name = "a \"tip\", dry";
  model.canopy.optics_names[1] = "bark";
  RadiationResult result = two_triangles_result();
  const regression::Table with(triangles_csv(awkward_record(), model, result));
  EXPECT_NEAR(with.number(0, "B-2_sky_upper"), 1.0, 1e-9);
  EXPECT_EQ(with.cell(0, "B-2_sky_lower"), "0");
  EXPECT_EQ(with.cell(0, "A_total"), "no such column");
  result.side_sky.clear();
  EXPECT_EQ(with.cell(1, "organ"), "a \"tip\", dry");
  EXPECT_EQ(with.cell(0, "optics"), "leaf");
  EXPECT_EQ(with.cell(1, "optics"), "bark");
  EXPECT_EQ(with.cell(0, "rank"), "7");
  const regression::Table without(triangles_csv(awkward_record(), model, result));
  EXPECT_EQ(without.cell(0, "B-2_sky_upper"), "no such column");
  EXPECT_EQ(without.columns().size() + 4, with.columns().size());
  EXPECT_EQ(without.cell(0, "B-2_absorbed"), with.cell(0, "B-2_absorbed"));
}

TEST(ElementFields, CornersStandInTheScenesFrame) {
  RadiationModel model = two_triangles();
  EXPECT_FALSE(corners_fit_float(model));
  EXPECT_EQ(corner_m(model, 1, 2), glm::dvec3(13.0, 2003.1, 30.0));
  model.canopy.origin_m = {};
  EXPECT_TRUE(corners_fit_float(model));
  model.plot = {20.0, 40.0, false, Axes::east_north_up};
  EXPECT_EQ(corner_m(model, 1, 2), user_position_m(model.plot, glm::dvec3(model.canopy.corners[1][2])));
  EXPECT_FALSE(corners_fit_float(model)) << "differences from the plot's size need double precision";
}

TEST(Exports, EveryKindHasItsNameAndFile) {
  EXPECT_STREQ(export_name(ExportKind::csv), "csv");
  EXPECT_STREQ(export_name(ExportKind::caribu), "caribu");
  EXPECT_STREQ(export_file(ExportKind::nc), "results.nc");
}

TEST(Exports, CleanTextIsOneLineOfUtf8) {
  EXPECT_EQ(printable("plain"), "plain");
  EXPECT_EQ(printable("a\nb\x01"), "a?b?");
  EXPECT_EQ(printable("\xc3\xa9"), "\xc3\xa9");
  EXPECT_EQ(printable("\xff\xc3\xa9"), "???");  // not UTF-8, so the meaning of the bytes is unknown
}

TEST(Exports, TheRecordNamesNoDeviceAndNoTime) {
  RunRecord record = awkward_record();
  record.device = {"vulkan", "SECRET", "SECRET"};
  record.threads = 7;
  record.seconds.total = 12.0;
  const auto entries = record_entries(record, two_triangles());
  record = awkward_record();
  const auto others = record_entries(record, two_triangles());
  ASSERT_EQ(entries.size(), others.size());
  for (std::size_t i = 0; i < entries.size(); ++i) EXPECT_EQ(entries[i].value, others[i].value) << entries[i].key;
}

TEST(Exports, WritesNothingIntoAFolderThatIsNotThere) {
  for (const ExportKind kind : export_kinds) {
    RadiationModel model = two_triangles();
    SCOPED_TRACE(export_name(kind));
    refusal_of([&] { write_export(kind, "/nowhere/at/all", awkward_record(), model, two_triangles_result()); },
               ErrorKind::failure);
  }
}

TEST(Caribu, Labels) {
  EXPECT_EQ(caribu_label({12, "leaf", 7}, 3), "100012007003");
  EXPECT_EQ(caribu_label({12, "leaf2", 7}, 1003), "200012007003");
  EXPECT_EQ(caribu_label({1, "leaf", 0}, 0), "100001001000") << "leaf 0 would be an opaque stem";
  EXPECT_EQ(caribu_label({1, "stem", 0}, 0), "100001000000");
  EXPECT_EQ(caribu_label({1, "ear", 5}, 0), "100001000000");
  EXPECT_EQ(caribu_label({1, "leaf.113", 5}, 0), "100001005000") << "a label has twelve digits";
  EXPECT_EQ(caribu_label({0, "soil", 0}, 5), "000000000005");
  EXPECT_EQ(caribu_label({1, "feuille_0", 0}, 0), "100001000000") << "only soil has the species 0";
  EXPECT_EQ(caribu_label({1, "feuille_3", 3, Role::leaf}, 0), "100001003000") << "the number counts organs";
  EXPECT_EQ(caribu_label({1, "ground", 0, Role::leaf}, 0), "100001001000") << "a given role comes before the name";
  EXPECT_NE(refusal({100'000, "leaf", 1}).find("plant 100000 has no label (CARIBU labels have numbers 0..99999); "),
            std::string::npos);
  EXPECT_NE(refusal({1, "leaf", 1000}), "");
  EXPECT_NE(refusal({1, "leaf", -1}), "");
}

TEST(Caribu, LabelsOfTheFile) {
  EXPECT_EQ(caribu_label_as_read({7, "leaf2", 12}, 200007012345), "200007012345");
  EXPECT_EQ(caribu_label_as_read({107, "leaf2", 12}, 200007012345), "200107012345") << "a copy has plants of its own";
  EXPECT_EQ(caribu_label_as_read({0, "soil", 0}, 799), "000000000799");
  RadiationModel model = two_triangles();
  model.canopy.labels = {no_label, 100001007042};
  const RadiationResult result = two_triangles_result();
  const ElementFields fields = make_element_fields(model, result);
  const regression::Table table(caribu_csv({awkward_record(), model, result, fields, {}}));
  EXPECT_EQ(table.cell(0, "label"), "100001007000");
  EXPECT_EQ(table.cell(1, "label"), "100002007042") << "the plant is the element's, which may be a copy's";
}

TEST(Caribu, Table) {
  const RadiationModel model = two_triangles();
  const RadiationResult result = two_triangles_result();
  const ElementFields fields = make_element_fields(model, result);
  const RunRecord record = awkward_record();
  const regression::Table table(caribu_csv({record, model, result, fields, {}}));
  EXPECT_EQ(table.header(), "band,index,label,area,Eabs,Ei,Ei_sup,Ei_inf");
  ASSERT_EQ(table.size(), 4U) << "a row for each band and triangle";
  EXPECT_EQ(table.cell(2, "band"), "B-2");
  EXPECT_EQ(table.cell(2, "index"), "0");
  EXPECT_EQ(table.cell(2, "label"), "100001007000");
  EXPECT_EQ(table.number(2, "area"), 0.5);
  EXPECT_NEAR(table.number(2, "Eabs"), 37.0, 1e-7);
  EXPECT_NEAR(table.number(2, "Ei"), 104.0, 1e-7);
  EXPECT_NEAR(table.number(2, "Ei_sup"), 82.0, 1e-7);
  EXPECT_NEAR(table.number(2, "Ei_inf"), 22.0, 1e-7);
}

}  // namespace
}  // namespace sunfleck
