// Tests that programs written by others read the exports: VTK, meshio, netCDF4 and xarray, assimp. The scripts in read_back/
// print their findings as JSON.

#include "base/file.h"
#include "files/formats/mesh/mesh_reader.h"
#include "files/results/exports/netcdf_file.h"
#include "files/results/exports/netcdf_rows.h"
#include "files/results/tables/result_writer.h"
#include "regression/read_back.h"
#include "support/export_models.h"
#include "support/temp_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <string>
#include <thread>

namespace sunfleck {
namespace {

using nlohmann::json;
using test::awkward_name;
using test::awkward_record;

// A result whose error bars were requested.
struct Simulated {
  RadiationModel model = test::maize_on_soil();
  RadiationResult result;
  RunRecord record = awkward_record();

  Simulated() {
    SolveSettings settings = test::fixed_work(model, 400'000, 8);
    settings.element_errors = ElementErrors::keep;
    result = test::simulate(model, settings);
  }
};

const Simulated& simulated() {
  static const Simulated all;
  return all;
}

class ExportReadBack : public ::testing::Test {
 protected:
  void write(ExportKind kind, const RadiationModel& model, const RadiationResult& result) const {
    write_export(kind, folder_.path(), awkward_record(), model, result, test::grey_colours(model.canopy.size()));
  }
  [[nodiscard]] json read(ExportKind kind) const {
    return regression::read_back(export_name(kind), folder_ / export_file(kind));
  }
  [[nodiscard]] json write_and_read(ExportKind kind) const {
    write(kind, simulated().model, simulated().result);
    return read(kind);
  }

  TempFolder folder_;
};

std::vector<std::string> column_names(bool sky, const std::vector<std::string>& bands) {
  std::vector<std::string> names;
  for (const std::string& band : bands) {
    for (const char* column :
         {"direct_upper", "direct_lower", "indirect_upper", "indirect_lower", "total", "absorbed", "absorbed_error"}) {
      names.push_back(band + "_" + column);
    }
    if (!sky) continue;
    names.push_back(band + "_sky_upper");
    names.push_back(band + "_sky_lower");
  }
  std::sort(names.begin(), names.end());
  return names;
}

// Checks what every format must contain of the simulated plant. `relative`: tolerance of the sums.
void expect_simulated(const json& found) {
  constexpr double relative = 1e-6;
  const Simulated& all = simulated();
  EXPECT_EQ(found["triangles"], all.model.canopy.size());
  EXPECT_EQ(found["in_order"], true);
  EXPECT_EQ(found["columns"], json(column_names(false, {"PAR", "NIR"})));
  const json summary = json::parse(summary_json(all.record, all.model, all.result));
  const double plot_m2 = summary["plot_area_m2"];
  for (const json& band : summary["bands"]) {
    const std::string absorbed = band["name"].get<std::string>() + "_absorbed";
    const double vegetation = band["absorbed_vegetation"];
    const double soil = band["absorbed_soil"];
    ASSERT_GT(std::min(vegetation, soil), 10.0);
    EXPECT_NEAR(found["all"][absorbed].get<double>() / plot_m2, vegetation + soil, relative * (vegetation + soil)) << absorbed;
    if (found.contains("vegetation")) {
      EXPECT_NEAR(found["vegetation"][absorbed].get<double>() / plot_m2, vegetation, relative * vegetation) << absorbed;
    }
  }
  for (std::size_t b = 0; b < all.model.bands.size(); ++b) {
    const auto first = all.result.element_error.begin() + static_cast<std::ptrdiff_t>(b * all.model.canopy.size());
    const auto last = first + static_cast<std::ptrdiff_t>(all.model.canopy.size());
    const auto none = std::count_if(first, last, [](double error) { return std::isnan(error); });
    ASSERT_GT(none, 0);
    EXPECT_EQ(found["no_interval"][all.model.bands[b].name + "_absorbed_error"], none);
  }
  double area = 0.0;
  for (const Triangle& corners : all.model.canopy.corners) area += area_m2(corners);
  EXPECT_NEAR(found["area_m2"].get<double>(), area, relative * area);
  EXPECT_NEAR(found["area_of_shapes_m2"].get<double>(), area, relative * area);
}

void expect_record(const json& found) {
  EXPECT_EQ(found["sunfleck"], "9.8.7");
  EXPECT_EQ(found["commit"], "0123abc");
  EXPECT_EQ(found["scene_digest"], "f00d");
  EXPECT_EQ(found["seed"], "18446744073709551615");
  EXPECT_EQ(found["grid_m"], "0.002");
  EXPECT_EQ(found["title"], printable(awkward_name));
}

// Checks two triangles about 2 km up, whose organ and optics have names that are difficult for every format.
void expect_two_triangles(const json& found) {
  EXPECT_EQ(found["triangles"], 2);
  EXPECT_EQ(found["columns"], json(column_names(true, {"A", "B-2"})));
  EXPECT_NEAR(found["all"]["B-2_absorbed"].get<double>(), 0.5 * 37.0, 1e-6 * 18.5);
  EXPECT_NEAR(found["all"]["B-2_sky_upper"].get<double>(), 0.5, 1e-6);
  const std::array bounds = {10.0, 13.0, 2000.1, 2003.1, 30.0, 33.0};
  // VTK keeps a glTF's points in single precision, whose steps are 1.2e-4 at 2 km.
  for (std::size_t i = 0; i < bounds.size(); ++i) EXPECT_NEAR(found["bounds"][i].get<double>(), bounds[i], 1.3e-4) << i;
}

TEST_F(ExportReadBack, Vtk) {
  const json found = write_and_read(ExportKind::vtp);
  expect_simulated(found);
  expect_record(found["record"]);
  for (const std::string& column : column_names(false, {"PAR", "NIR"})) EXPECT_EQ(found["units"][column], "W m-2") << column;
  EXPECT_EQ(found["units"]["area_m2"], "m2");
  EXPECT_EQ(found["plants"], json({0, 1}));
  EXPECT_GT(found["ranks"].size(), 5U);

  write(ExportKind::vtp, test::two_triangles(), test::two_triangles_result());
  const json two = read(ExportKind::vtp);
  expect_two_triangles(two);
  EXPECT_EQ(two["organ_names"], json({"leaf", printable(awkward_name)}));
  EXPECT_EQ(two["bounds"][2], 2000.1) << "in double precision";
}

TEST_F(ExportReadBack, Meshio) {
  const json found = write_and_read(ExportKind::ply);
  expect_simulated(found);
  expect_record(found["record"]);
  EXPECT_EQ(found["same_at_all_corners"], true);
  EXPECT_EQ(found["greys"], json({0, 1, 2}));
  for (const std::string& column : column_names(false, {"PAR", "NIR"})) EXPECT_EQ(found["units"][column], "W m-2") << column;

  write(ExportKind::ply, test::two_triangles(), test::two_triangles_result());
  const json two = read(ExportKind::ply);
  expect_two_triangles(two);
  EXPECT_EQ(two["record"]["organ 1"], printable(awkward_name));
  EXPECT_EQ(two["bounds"][2], 2000.1) << "in double precision";
}

TEST_F(ExportReadBack, Netcdf) {
  const json found = write_and_read(ExportKind::nc);
  expect_simulated(found);
  expect_record(found["record"]);
  EXPECT_EQ(found["data_model"], "NETCDF4");
  EXPECT_EQ(found["record"]["Conventions"], "CF-1.8");
  EXPECT_EQ(found["all_have_long_names"], true);
  EXPECT_EQ(found["organs_read_alike"], true);
  EXPECT_EQ(found["plants"], json({0, 1}));
  EXPECT_LT(found["centroids_off_m"].get<double>(), 1e-12);
  for (const std::string& column : column_names(false, {"PAR", "NIR"})) EXPECT_EQ(found["units"][column], "W m-2") << column;
  EXPECT_EQ(found["bands"], json({"PAR", "NIR"}));
  EXPECT_EQ(found["flags"].size(), found["organ_names"].size());
  for (std::size_t b = 0; b < 2; ++b) {
    EXPECT_EQ(found["absorbed_vegetation"][b], simulated().result.bands[b].absorbed_vegetation.value);
    EXPECT_EQ(found["incident"][b], simulated().result.bands[b].incident.value);
  }
  EXPECT_EQ(found["planes"], simulated().result.layers.size());

  write(ExportKind::nc, test::two_triangles(), test::two_triangles_result());
  const json two = read(ExportKind::nc);
  expect_two_triangles(two);
  EXPECT_EQ(two["organ_names"], json({"leaf", printable(awkward_name)}));
  EXPECT_EQ(two["organs_read_alike"], true);
  EXPECT_EQ(two["flag_meanings"].size(), 2U);
  EXPECT_EQ(two["bounds"][2], 2000.1) << "in double precision";
}

TEST_F(ExportReadBack, NetcdfWithLettersOfOtherLanguages) {
  RadiationModel model = test::two_triangles();
  model.canopy.organs[0].name = "feuille_\xc3\xa9";
  model.canopy.organs[1].name = "tige";
  write(ExportKind::nc, model, test::two_triangles_result());
  const json found = read(ExportKind::nc);
  EXPECT_EQ(found["organ_names"], json({"feuille_\xc3\xa9", "tige"}));
  EXPECT_EQ(found["organs_read_alike"], true);
}

TEST_F(ExportReadBack, GltfInVtk) {
  const json found = write_and_read(ExportKind::glb);
  expect_simulated(found);
  EXPECT_EQ(found["same_at_all_corners"], true);
  EXPECT_NEAR(found["greys"][1].get<double>(), 0.5, 1.0 / 65535.0) << "linear";

  write(ExportKind::glb, test::two_triangles(), test::two_triangles_result());
  expect_two_triangles(read(ExportKind::glb));
}

TEST_F(ExportReadBack, CoordinatesAreInTheAxesOfTheUser) {
  RadiationModel model = test::two_triangles();  // 10 to 13 m south, 30 to 33 m west
  model.plot = {20.0, 45.0, false, Axes::east_north_up};
  constexpr std::array z_up = {12.0, 15.0, 7.0, 10.0, 2000.1, 2003.1};
  constexpr std::array y_up = {12.0, 15.0, 2000.1, 2003.1, -10.0, -7.0};
  for (const ExportKind kind : {ExportKind::vtp, ExportKind::ply, ExportKind::nc, ExportKind::glb}) {
    SCOPED_TRACE(export_name(kind));
    write(kind, model, test::two_triangles_result());
    const json found = read(kind);
    const bool gltf = kind == ExportKind::glb;
    for (std::size_t i = 0; i < z_up.size(); ++i) {
      EXPECT_NEAR(found["bounds"][i].get<double>(), gltf ? y_up[i] : z_up[i], gltf ? 1.3e-4 : 1e-12) << i;
    }
    if (found.contains("record")) {
      EXPECT_EQ(found["record"]["plot_size_m"], "45 20");
      EXPECT_EQ(found["record"]["axes"], gltf ? "x east, y up, z south; m" : "x east, y north, z up; m");
    }
  }
}

// assimp drops attributes with names other than its own; this test checks the rest.
TEST_F(ExportReadBack, GltfInAssimp) {
  write(ExportKind::glb, simulated().model, simulated().result);
  const std::string file = (folder_ / "canopy.glb").string();
  const std::string info = regression::output_of("assimp info '" + file + "' -r 2>&1");
  const Box box = bounds(simulated().model.canopy);
  const auto number_after = [&](const std::string& label) {
    const std::size_t at = info.find(label);
    return at == std::string::npos ? -1.0 : std::stod(info.substr(at + label.size()));
  };
  EXPECT_EQ(number_after("Faces:"), static_cast<double>(simulated().model.canopy.size())) << info;
  EXPECT_EQ(number_after("Vertices:"), 3.0 * static_cast<double>(simulated().model.canopy.size())) << info;
  EXPECT_NEAR(number_after("Minimum point      ("), box.lo.x, 1e-6) << info;
  EXPECT_NEAR(number_after("Maximum point      ("), box.hi.x, 1e-6) << info;
  for (const char* name : {"canopy\n", "plant1_leaf", "plant1_stem", "plant0_soil"}) {
    EXPECT_NE(info.find(name), std::string::npos) << name << " in\n" << info;
  }
}

TEST_F(ExportReadBack, GltfIsAMeshWithExtras) {
  write(ExportKind::glb, simulated().model, simulated().result);
  const Mesh mesh = read_mesh(folder_ / "canopy.glb", {});
  EXPECT_EQ(mesh.triangles.size(), simulated().model.canopy.size());
  EXPECT_EQ(mesh.organs, simulated().model.canopy.organs);
  const std::string bytes = read_file(folder_ / "canopy.glb");
  constexpr std::size_t header = 20;  // length of the headers of the file and of its first chunk
  const json document = json::parse(bytes.substr(header, bytes.find("BIN") - 4 - header), nullptr, false);
  ASSERT_FALSE(document.is_discarded());
  const json& extras = document["nodes"][0]["extras"];
  expect_record(extras);
  EXPECT_EQ(extras["units"]["_PAR_TOTAL"], "W m-2");
  for (const json& mesh_json : document["meshes"]) {
    for (const json& primitive : mesh_json["primitives"]) {
      const json& positions = document["accessors"][primitive["attributes"]["POSITION"].get<std::size_t>()];
      EXPECT_EQ(positions["min"].size(), 3U);
      EXPECT_EQ(positions["max"].size(), 3U);
    }
  }

  write(ExportKind::glb, test::two_triangles(), test::two_triangles_result());
  EXPECT_EQ(read_mesh(folder_ / "canopy.glb", {}).organs.at(1).name, printable(awkward_name));
}

// Writes each file again more than a second later: no format may contain the time.
TEST_F(ExportReadBack, TheSameBytesTwice) {
  std::vector<std::string> first;
  for (const ExportKind kind : export_kinds) {
    write(kind, simulated().model, simulated().result);
    first.push_back(read_file(folder_ / export_file(kind)));
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(1100));
  for (const ExportKind kind : export_kinds) {
    write(kind, simulated().model, simulated().result);
    EXPECT_TRUE(read_file(folder_ / export_file(kind)) == first[static_cast<std::size_t>(kind)]) << export_name(kind);
  }
}

// A scene without triangles is not an error.
TEST_F(ExportReadBack, AnEmptyCanopy) {
  RadiationModel model = test::two_triangles();
  model.canopy = {};
  RadiationResult result = test::two_triangles_result();
  result.elements.clear();
  result.element_error.clear();
  for (const ExportKind kind : export_kinds) {
    write(kind, model, result);
    EXPECT_FALSE(read_file(folder_ / export_file(kind)).empty());
  }
  EXPECT_EQ(read(ExportKind::nc)["triangles"], 0);
}

// Rows that are longer than a chunk, whose last chunk is cut by the end of the row.
TEST_F(ExportReadBack, RowsStoredChunkByChunk) {
  constexpr std::size_t columns = NetcdfFile::longest_chunk + 1000, rows = 3;
  const std::filesystem::path place = folder_ / "rows.nc";
  const std::vector<std::string> names{"first", "second"};
  {
    NetcdfFile file("rows.nc", place);
    const int row = file.dimension("row", rows), column = file.dimension("column", columns);
    for (const std::string& name : names) file.store_by_rows(file.variable<float>(name, {row, column}));
    file.add("kept", {row}, "1", "what was there before", std::vector<std::int32_t>{5, 6, 7});
    file.finish();
  }
  NetcdfRows writer("rows.nc", place, names, columns);
  for (std::size_t r = 0; r < rows; ++r) {
    std::vector<float> values;
    for (std::size_t k = 0; k < names.size() * columns; ++k) {
      const std::size_t v = k / columns, c = k % columns;
      values.push_back(static_cast<float>(1000 * v + 100 * r) + static_cast<float>(c % 97) / 8.0F);
    }
    writer.put(r, values);
  }
  writer.finish();
  const json found = regression::read_back("rows", place);
  EXPECT_EQ(found["wrong"], 0);
  EXPECT_EQ(found["filters"], true);
  EXPECT_EQ(found["chunks"], (json{1, NetcdfFile::longest_chunk}));
  EXPECT_EQ(found["kept"], 6);
}

}  // namespace
}  // namespace sunfleck
