#include "files/results/plots/plots.h"

#include "base/units.h"
#include "files/results/tables/day_tables.h"
#include "files/results/tables/plane_writer.h"
#include "files/results/tables/result_tables.h"
#include "files/results/tables/table_text.h"
#include "support/gnuplot.h"
#include "support/small_plane.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <random>
#include <string>

namespace sunfleck {
namespace {

namespace fs = std::filesystem;

constexpr test::Picture::Pixel blue{0x00, 0x72, 0xB2}, vermilion{0xD5, 0x5E, 0x00}, green{0x00, 0x9E, 0x73}, black{0, 0, 0},
    white{255, 255, 255};
const std::string hostile = "it's `touch x` \"@x\" {a}_b^2 \\ \xff";

RunRecord titled(const std::string& title) {
  RunRecord record;
  record.title = title;
  record.accuracy.confidence = 0.95;
  return record;
}

std::vector<LayerResult> layers(double ground_ratio) {
  std::vector<LayerResult> all;
  for (int i = 0; i <= 20; ++i) {
    const double height_m = 0.1 * i;
    const double ratio = ground_ratio + (1.0 - ground_ratio) * height_m / 2.0;
    all.push_back({height_m, 0.1, {ratio, 0.03}, {0.5, 0.01}, {{1.0, 0.0}}, {{1.0, 0.0}}, {{10.0 + i, 2.0}}, {{0.0, 0.0}}});
  }
  all.back().absorbed.clear();
  all.back().absorbed_structure.clear();
  return all;
}

using Points = std::vector<std::vector<double>>;  // sunfleck ratio, height

class Plots : public test::GnuplotTest {
 protected:
  // Writes the profile.csv of a result with these layers, in the band PAR.
  [[nodiscard]] fs::path profile(const std::string& title, const std::vector<LayerResult>& layers, int number = 0) const {
    RadiationModel model;
    model.bands = {{"PAR", 100.0, 0.0}};
    RadiationResult result;
    result.layers = layers;
    return folder_.write("profile" + std::to_string(number) + ".csv", csv_text(titled(title), layers_table(model, result)));
  }

  // Returns the variables that `run` sets for profile.gp.
  static PlotVariables profiles(const std::vector<fs::path>& tables, const std::string& band = "PAR",
                                const std::string& measured = {}, const Points& points = {}) {
    PlotVariables variables;
    variables.set_files("tables", tables);
    variables.set_text("band", band);
    if (measured.empty()) return variables;
    variables.set_text("measured", measured);
    variables.set_table("measured", "sunfleck_ratio,height_m", points);
    variables.set_text("agreement", "n 3, R2 0.970");
    return variables;
  }

  // Draws a plane as `run` does.
  [[nodiscard]] test::Picture plane(const std::string& title, const RadiationModel& model, const RadiationResult& result,
                                    std::size_t band) const {
    PlotVariables variables;
    variables.set_file("table", folder_.write("plane.csv", plane_csv(titled(title), model, result, 0)));
    if (!result.planes[0].reached.empty())
      variables.set_file("flecks", folder_.write("flecks.csv", plane_flecks_csv(titled(title), model, result, 0)));
    variables.set_text("title", title);
    variables.set_text("band", model.bands[band].name);
    variables.set("beam", model.bands[band].direct_w_m2);
    return draw("plane.gp", variables);
  }

  // Draws a day with these steps as `day` does.
  [[nodiscard]] test::Picture day(const std::string& title, const std::vector<DayStep>& steps,
                                  const std::vector<StepLight>& lights, double umol_per_joule = 0.0) const {
    RadiationModel model;
    model.bands = {{"PAR", 0.0, 0.0}};
    model.bands[0].umol_per_joule = umol_per_joule;
    DayCourse course;
    course.steps = steps;
    for (DayStep& step : course.steps) {
      const std::string its = local_time_text(step.start, 0).substr(0, 10);
      if (course.dates.empty() || course.dates.back() != its) course.dates.push_back(its);
      step.date = course.dates.size() - 1;
    }
    const DayStand stand(model);
    const DayPart part(course, lights);
    PlotVariables variables;
    variables.set_file("table", folder_.write("day.csv", day_text({"", steps_table}, titled(title), stand, part)));
    variables.set_file("sums", folder_.write("day_sums.csv", day_text({"", day_sums_table}, titled(title), stand, part)));
    variables.set_text("title", title);
    variables.set_text("band", "PAR");
    return draw("day.gp", variables);
  }
};

TEST_F(Plots, AProfileAlone) {
  const test::Picture picture = draw("profile.gp", profiles({profile("A stand", layers(0.2))}));
  EXPECT_EQ(picture.width, 1600);
  EXPECT_EQ(picture.height, 1000);
  EXPECT_GT(picture.count(blue), 1000U);
  EXPECT_EQ(picture.count(vermilion), 0U);
  EXPECT_GT(picture.count(white), 1'000'000U);
}

TEST_F(Plots, TwoProfilesAndFieldData) {
  const std::vector<fs::path> tables{profile("sparse", layers(0.2), 1), profile("dense", layers(0.02), 2)};
  const test::Picture picture = draw("profile.gp", profiles(tables, "PAR", "field.csv", {{0.2, 0.0}, {0.7, 1.0}, {1.0, 3.0}}));
  EXPECT_GT(picture.count(blue), 1000U);
  EXPECT_GT(picture.count(vermilion), 1000U);
  EXPECT_GT(picture.count(black), draw("profile.gp", profiles(tables)).count(black) + 100) << "rings of the field data";
}

// Counts the blue pixels of a picture from column `left` to before `right`.
std::size_t blue_between(const test::Picture& picture, int left, int right) {
  return picture.count_between(blue, left, right);
}

// Returns whether the picture has a border of a panel, a dark line of most of its height, near this column. gnuplot places it
// up to three pixels further left.
bool has_border_at(const test::Picture& picture, int column) {
  int longest = 0;
  for (int x = column - 3; x <= column + 1; ++x) {
    int dark = 0;
    for (int y = 0; y < picture.height; ++y) dark += picture.at(x, y)[0] < 0x60 ? 1 : 0;
    longest = std::max(longest, dark);
  }
  return longest > picture.height / 2;
}

TEST_F(Plots, AProfileHasThreePanels) {
  const test::Picture picture = draw("profile.gp", profiles({profile("A stand", layers(0.2))}));
  for (const int left : {140, 627, 1113}) {
    EXPECT_TRUE(has_border_at(picture, left)) << left;
    EXPECT_GT(blue_between(picture, left, left + 430), 400U) << left;
  }
}

TEST_F(Plots, AProfileDrawsTheSunlitShareOfEachLayer) {
  std::vector<LayerResult> shady = layers(0.2);
  for (LayerResult& layer : shady) layer.sunlit_leaf_fraction = {0.1, 0.01};
  const test::Picture half = draw("profile.gp", profiles({profile("A stand", layers(0.2))}));
  const test::Picture tenth = draw("profile.gp", profiles({profile("A stand", shady)}));
  // The panel from 0 to 1.02 spans columns 627 to 1063.
  EXPECT_GT(blue_between(half, 830, 852), 1000U);
  EXPECT_EQ(blue_between(half, 640, 700), 0U);
  EXPECT_GT(blue_between(tenth, 659, 681), 1000U);
  EXPECT_EQ(blue_between(tenth, 800, 900), 0U);
}

TEST_F(Plots, AProfileHasNoEmptyPanel) {
  const test::Picture other_band = draw("profile.gp", profiles({profile("A stand", layers(0.2))}, "UV"));
  EXPECT_TRUE(has_border_at(other_band, 820) && has_border_at(other_band, 870)) << "two panels share the room";
  EXPECT_FALSE(has_border_at(other_band, 627));
  EXPECT_GT(blue_between(other_band, 140, 820), 500U);
  EXPECT_GT(blue_between(other_band, 870, 1550), 500U);

  std::vector<LayerResult> bare = layers(0.2), dark = layers(0.2);
  for (LayerResult& layer : bare) layer.sunlit_leaf_fraction = {no_value, no_value};
  EXPECT_TRUE(has_border_at(draw("profile.gp", profiles({profile("No leaves", bare)})), 870));

  for (LayerResult& layer : dark) layer.sunfleck_ratio = layer.sunlit_leaf_fraction = {no_value, no_value};
  const test::Picture no_beam = draw("profile.gp", profiles({profile("A stand", dark)}));
  EXPECT_FALSE(has_border_at(no_beam, 627) || has_border_at(no_beam, 820) || has_border_at(no_beam, 870));
  EXPECT_TRUE(has_border_at(no_beam, 140) && has_border_at(no_beam, 1550)) << "the absorbed light has all the room";
  EXPECT_GT(blue_between(no_beam, 140, 1550), 1000U);
}

TEST_F(Plots, ProfilesOfAnythingASimulationGives) {
  std::vector<LayerResult> dark = layers(0.2), unsure = layers(0.2);
  for (LayerResult& layer : dark) layer.sunfleck_ratio = {no_value, no_value};
  for (LayerResult& layer : unsure) {
    layer.sunfleck_ratio.half_width = no_value;
    for (Estimate& absorbed : layer.absorbed) absorbed = {0.0, no_value};
  }
  std::vector<LayerResult> flat{layers(1.0).front(), layers(1.0).back()};
  flat[1].height_m = 0.0;
  std::vector<fs::path> many;
  for (int i = 1; i <= 9; ++i) many.push_back(profile("curve", layers(0.1 * i), i));
  const fs::path a = profile("a", dark, 10), b = profile("b", unsure, 11), c = profile("c", flat, 12);
  for (const std::vector<fs::path>& tables : {std::vector<fs::path>{a}, {b}, {c}, {a, b}, many}) {
    EXPECT_EQ(draw("profile.gp", profiles(tables, "PAR", "field.csv", {{0.7, 1.0}})).width, 1600);
    EXPECT_EQ(draw("profile.gp", profiles(tables, "UV")).width, 1600);
  }
}

// Draws with users' texts in every place where one may stand: titles, file names, and the names of the band and of the field
// data.
class HostileTexts : public Plots {
 protected:
  [[nodiscard]] int width_with(const std::string& text) const { return width_with(text, text, text, text); }

  // The first text is the title of a table, and the name of its folder; the second one is a title that the user gives instead.
  [[nodiscard]] int width_with(const std::string& title, const std::string& given, const std::string& band,
                               const std::string& measured) const {
    std::string name = title.substr(0, 100);
    for (char& c : name) c = c == '/' || c == '\0' ? '|' : c;
    const fs::path folder = folder_ / ("folder " + name);
    fs::create_directories(folder);
    const fs::path table = folder / "profile.csv";
    fs::copy_file(profile(title, layers(0.2)), table, fs::copy_options::overwrite_existing);
    const fs::path file = folder / "profile.png";
    PlotVariables variables = profiles({table, table}, band, measured, {{0.2, 0.0}});
    EXPECT_EQ(draw_table("profile.gp", variables, file).value_or(""), "") << title;
    variables.set_texts("titles", std::vector<std::string>{title, given});
    EXPECT_EQ(draw_table("profile.gp", variables, file).value_or(""), "") << title;
    return test::read_picture(file).width;
  }
};

TEST_F(HostileTexts, AreOnlyText) {
  const fs::path mark = fs::current_path() / "mark_of_a_hostile_text";
  fs::remove(mark);
  const std::string touch = "touch mark_of_a_hostile_text";
  const std::string texts[] = {"'; system '" + touch + "'; set title '",
                               "\"; system \"" + touch + "\"; \"",
                               "`" + touch + "`",
                               "a `" + touch + "` \" `" + touch + "` ' `" + touch + "`",
                               "$(" + touch + ")",
                               "< " + touch,
                               "|" + touch,
                               "x'\n!" + touch + "\n'",
                               "x\r\nsystem('" + touch + "')\r\n",
                               "' . system('" + touch + "') . '",
                               "@macro @ARG0 {/Bold x} _a ^2 \\n \\' \\",
                               "{{{ }}} ((( [[[ ### %s %d %n",
                               "'",
                               "''",
                               "'''",
                               "\"",
                               "\\",
                               "~",
                               "-",
                               "$data << EOD",
                               "EOD",
                               "# seed 1, confidence 7",
                               "",
                               std::string("nul\0nul", 7),
                               "\x01 \x1b[31m",
                               "\xff\xfe broken \xc3",
                               "W m\u207b\u00b2 \u00b1",
                               std::string(100000, 'M')};
  for (const std::string& text : texts) {
    EXPECT_EQ(width_with(text), 1600) << text;
    EXPECT_FALSE(fs::exists(mark)) << text;
  }
}

TEST_F(HostileTexts, MadeOfDangerousCharactersAreOnlyText) {
  const std::string alphabet = "'\"`\\{}()[]@$#!|;,&<>%^_~*?\n\r\t ax0\xc3\xa9\xff";
  std::mt19937 random(1);
  for (int i = 0; i < 10; ++i) {
    std::array<std::string, 4> texts;
    for (std::string& text : texts) {
      for (int length = 1 + static_cast<int>(random() % 30); length > 0; --length) text += alphabet[random() % alphabet.size()];
    }
    EXPECT_EQ(width_with(texts[0], texts[1], texts[2], texts[3]), 1600) << ::testing::PrintToString(texts);
  }
}

TEST_F(Plots, ALongTitleIsCut) {
  const auto with = [&](const std::string& title) {
    return draw("profile.gp", profiles({profile(title, layers(0.2))})).pixels;
  };
  EXPECT_EQ(with(std::string(85, 'i')), with(std::string(200, 'i')));
  EXPECT_NE(with(std::string(83, 'i')), with(std::string(84, 'i')));
}

TEST_F(Plots, ATitleIsDrawnAsItStands) {
  const fs::path table = profile("A stand", layers(0.2));
  const auto with = [&](const std::string& title) {
    PlotVariables variables = profiles({table});
    variables.set_texts("titles", std::vector<std::string>{title});
    return draw("profile.gp", variables).pixels;
  };
  EXPECT_EQ(with("A stand"), draw("profile.gp", profiles({table})).pixels) << "the title of the table";
  EXPECT_NE(with("a \\n b"), with("a  b")) << "a backslash is a character like others";
  EXPECT_NE(with("a \"q\" b"), with("a ")) << "a quote ends nothing";
  EXPECT_NE(with("x_1"), with("x1"));
}

TEST(GnuplotText, IsAConstantWithoutSpecialCharacters) {
  EXPECT_EQ(gnuplot_text("Maize, 60 x 60 cm: a/b_c-1.5"), "\"Maize, 60 x 60 cm: a/b_c-1.5\"");
  EXPECT_EQ(gnuplot_text("it's `x` \"@y\" \\"), R"("it\047s \140x\140 \042\100y\042 \134")");
  EXPECT_EQ(gnuplot_text("a\nb\xc3\xa9"), R"("a\012b\303\251")");
  EXPECT_EQ(gnuplot_text(std::string_view("a\0b", 3)), "\"ab\"");
  EXPECT_EQ(gnuplot_text("'12a3"), R"("\047\061\062a3")") << "digits after an octal number would belong to it";
  EXPECT_EQ(gnuplot_text(""), "\"\"");
}

// Sets SUNFLECK_PLOTS as long as it lives.
class PlotsFrom {
 public:
  explicit PlotsFrom(const fs::path& folder) { ::setenv("SUNFLECK_PLOTS", folder.c_str(), 1); }
  ~PlotsFrom() { ::unsetenv("SUNFLECK_PLOTS"); }
  PlotsFrom(const PlotsFrom&) = delete;
  PlotsFrom& operator=(const PlotsFrom&) = delete;
};

TEST_F(Plots, AUsersOwnScriptsAreTaken) {
  const fs::path table = profile("A stand", layers(0.2));
  const fs::path own = folder_ / "own";
  fs::copy(plot_folder(), own);
  std::string script = test::content(own / "profile.gp");
  const std::string width = "width = 1600.0";
  script.replace(script.find(width), width.size(), "width = 800.0");
  std::ofstream(own / "profile.gp") << script;
  const PlotsFrom from(own);
  EXPECT_EQ(draw("profile.gp", profiles({table})).width, 800);
}

TEST_F(Plots, AMissingScriptIsNamed) {
  const PlotsFrom from(folder_.path());
  EXPECT_EQ(draw_table("profile.gp", {}, folder_ / "profile.png").value_or(""),
            "profile.png is left out: " + (folder_ / "profile.gp").string() +
                " is missing; install sunfleck again, or correct SUNFLECK_PLOTS");
  EXPECT_FALSE(fs::exists(folder_ / "profile.png"));
}

TEST_F(Plots, AMissingOrEmptyTableIsAWarning) {
  for (const char* script : {"plane.gp", "day.gp", "tradeoff.gp"}) {
    PlotVariables variables;
    variables.set_file("table", folder_ / "none.csv");
    const std::string warning = draw_table(script, variables, folder_ / "a.png").value_or("");
    EXPECT_EQ(warning.find("gnuplot failed: a.png is left out (exit status 1"), 0U) << script << ": " << warning;
  }
  const std::string warning = draw_table("profile.gp", profiles({folder_ / "none.csv"}), folder_ / "a.png").value_or("");
  EXPECT_EQ(warning.find("gnuplot failed: a.png is left out (exit status 1"), 0U) << warning;
}

// Finds where a plane's first map is drawn: the bounds of its shaded cells.
struct Map {
  int left = 0, top = 0, right = 0, bottom = 0;
};

Map first_map(const test::Picture& picture) {
  constexpr test::Picture::Pixel dark{0x44, 0x01, 0x54};  // the lower end of viridis, which a cell in the shade has
  Map map{picture.width, picture.height, 0, 0};
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < 760; ++x) {
      if (picture.at(x, y) != dark) continue;
      map.left = std::min(map.left, x);
      map.top = std::min(map.top, y);
      map.right = std::max(map.right, x);
      map.bottom = std::max(map.bottom, y);
    }
  }
  return map;
}

TEST_F(Plots, AMapHasNorthUpAndWestLeft) {
  const auto [model, result] = test::small_plane();
  const test::Picture picture = plane(hostile, model, result, 0);
  EXPECT_EQ(picture.width, 1600);
  const Map map = first_map(picture);
  const double width = map.right - map.left + 1.0, height = map.bottom - map.top + 1.0;
  EXPECT_NEAR(width / height, 3.0, 0.05) << "3 m from east to west, 1 m from north to south";
  const auto at = [&](double from_west, double from_north) {
    return picture.at(map.left + static_cast<int>(from_west * width), map.top + static_cast<int>(from_north * height));
  };
  const test::Picture::Pixel shade = at(1.0 / 6.0, 0.25), sun = at(5.0 / 6.0, 0.25), half = at(0.5, 0.25);
  EXPECT_EQ(shade, (test::Picture::Pixel{0x44, 0x01, 0x54}));
  EXPECT_GT(sun[1], 0xC0) << "bright: yellow or close to it";
  EXPECT_GT(sun[1], half[1]);
  EXPECT_GT(half[1], shade[1]);
  EXPECT_EQ(at(0.5, 0.75), shade) << "south of it";
  EXPECT_EQ(at(5.0 / 6.0, 0.75), shade) << "south-east";
}

TEST_F(Plots, AMapWithoutABeamStandsAlone) {
  auto [model, result] = test::small_plane();
  const test::Picture both = plane("Sun", model, result, 0);
  result.planes[0].reached.clear();
  result.planes[0].crossing.clear();
  result.planes[0].sunfleck_ratio = {no_value, no_value};
  model.bands[0].direct_w_m2 = 0.0;
  const test::Picture alone = plane("Overcast", model, result, 0);
  EXPECT_LT(alone.height, 700) << "neither a map of the beam nor sizes of flecks";
  // The widest stretch without white in a row that crosses the maps: one is 1180 wide, two are 590 each.
  const auto widest = [](const test::Picture& picture) {
    int columns = 0, longest = 0;
    for (int x = 0; x < picture.width; ++x) {
      columns = picture.at(x, 250) == white ? 0 : columns + 1;
      longest = std::max(longest, columns);
    }
    return longest;
  };
  EXPECT_NEAR(widest(both), 590, 20);
  EXPECT_NEAR(widest(alone), 1180, 20);
}

TEST_F(Plots, MapsOfAnythingASimulationGives) {
  auto [model, result] = test::small_plane();
  result.planes[0].down.clear();
  EXPECT_EQ(plane("No other light", model, result, 1).width, 1600);
  result.planes[0].reached.assign(6, 0);
  EXPECT_EQ(plane("All shade", model, result, 0).width, 1600);
  result.planes[0].reached.clear();
  result.planes[0].crossing.clear();
  result.planes[0].sunfleck_ratio = {no_value, no_value};
  EXPECT_EQ(plane("No beam", model, result, 0).width, 1600);
  for (const auto& [x, z] : {std::pair{1U, 1U}, {1U, 5U}, {1700U, 3U}}) {
    PlaneResult& map = result.planes[0];
    map.cells_x = x;
    map.cells_z = z;
    map.reached.assign(std::size_t{x} * z, 3);
    map.crossing.assign(std::size_t{x} * z, 3);
    EXPECT_EQ(plane("Few or many cells", model, result, 0).width, 1600);
  }
  model.plot = {100.0, 1.0, false};
  EXPECT_EQ(plane("A long plot", model, result, 0).width, 1600);
}

DayStep step_at(int day, double hour) {
  const UtcTime first{2002, 8, 8, static_cast<int>(hour), static_cast<int>(std::lround(60.0 * (hour - std::floor(hour)))), 0.0};
  const UtcTime start = plus_seconds(first, 86400.0 * day);
  return {start, start, 600.0, 0, {std::sin((hour - 6.0) / 12.0 * 3.14), 1.0}};
}

StepLight light(double w_m2) {
  const BandFluxes band{
      {w_m2, 0.0}, {0.7 * w_m2, 0.05 * w_m2}, {0.0, 0.0}, {0.2 * w_m2, 0.02 * w_m2}, {0.1 * w_m2, 0.01 * w_m2}, {}, 0.0};
  return {{band}, {}, {w_m2 > 0.0 ? 0.4 : 0.0, w_m2 > 0.0 ? 0.05 : 0.0}};
}

struct Days {
  std::vector<DayStep> steps;
  std::vector<StepLight> lights;
};

Days days(int count, int from_hour, int to_hour) {
  Days all;
  for (int day = 0; day < count; ++day) {
    for (int i = 6 * from_hour; i < 6 * to_hour; ++i) {
      all.steps.push_back(step_at(day, i / 6.0));
      all.lights.push_back(light(std::max(0.0, 400.0 * all.steps.back().sun.elevation_rad)));
    }
  }
  return all;
}

TEST_F(Plots, TheCourseOfADay) {
  const auto [steps, lights] = days(1, 5, 20);
  const test::Picture picture = day(hostile, steps, lights);
  EXPECT_EQ(picture.width, 1600);
  EXPECT_EQ(picture.height, 1100);
  EXPECT_GT(picture.count(black), 1000U) << "incident";
  EXPECT_GT(picture.count(green), 500U) << "absorbed by vegetation";
  EXPECT_GT(picture.count(vermilion), 500U) << "soil, and sunlit leaves";
  EXPECT_GT(picture.count(blue), 200U) << "reflected";
  EXPECT_GT(picture.count({0xB2, 0xE2, 0xD5}, 2), 1000U) << "the band of absorbed by vegetation: 0.3 of green on white";
}

TEST_F(Plots, CurvesHaveAGapWhereStepsAreMissing) {
  const auto black_at_the_first_midnight = [&](Days all) {
    all.lights.assign(all.lights.size(), light(300.0));
    const test::Picture picture = day("Three days", all.steps, all.lights);
    std::size_t count = 0;
    for (int y = 180; y < 650; ++y) {
      for (int x = 598; x < 608; ++x) count += picture.at(x, y) == black ? 1 : 0;
    }
    return count;
  };
  EXPECT_EQ(black_at_the_first_midnight(days(3, 10, 14)), 0U);
  EXPECT_GT(black_at_the_first_midnight(days(3, 0, 24)), 0U);
}

// Returns the rows of the upper panel that hold a point of this colour near a column, from the top.
std::vector<int> rows_near(const test::Picture& picture, int column, const test::Picture::Pixel& colour) {
  std::vector<int> rows;
  for (int y = 185; y < 650; ++y) {
    int found = 0;
    for (int x = column - 6; x <= column + 6; ++x) found += picture.at(x, y) == colour ? 1 : 0;
    if (found >= 5) rows.push_back(y);
  }
  return rows;
}

// The column of the middle of a date, from 0, in a picture of that many days. Without photons the panel spans columns 150 to
// 1510.
int middle_of(int date, int dates) {
  return 150 + static_cast<int>(1360.0 * (date + 0.5) / dates);
}

TEST_F(Plots, MoreThanSevenDaysAreDailySums) {
  // Ten hours of 400 W m-2 are 14.4 MJ m-2; twice as long is twice as much.
  Days all = days(10, 4, 14);
  for (StepLight& step : all.lights) step = light(400.0);
  const Days longer = days(1, 0, 20);
  std::vector<DayStep> steps(all.steps.begin(), all.steps.end() - 60);
  std::vector<StepLight> lights(all.lights.begin(), all.lights.end() - 60);
  for (DayStep step : longer.steps) {
    step.start.day += 9;
    steps.push_back(step);
    lights.push_back(light(400.0));
  }
  const test::Picture picture = day("Ten days", steps, lights);
  const auto height_of = [&](int date) {
    const std::vector<int> rows = rows_near(picture, middle_of(date, 10), black);
    return rows.empty() ? 0.0 : 660.0 - 0.5 * (rows.front() + rows.back());
  };
  // The axis ends 8 % above 28.8 MJ m-2; it is 485 pixels high.
  EXPECT_NEAR(height_of(9), 485.0 / 1.08, 4.0);
  EXPECT_NEAR(height_of(4), 0.5 * 485.0 / 1.08, 4.0);
  EXPECT_NEAR(height_of(0), height_of(8), 1.0);
}

TEST_F(Plots, SevenDaysAreStillDrawnAsTheyGo) {
  const auto at_noon = [&](int count) {
    Days all = days(count, 0, 24);
    for (StepLight& step : all.lights) step = light(300.0);
    return day("Days", all.steps, all.lights);
  };
  // Half-widths are 7 % of a step's value, but a twelfth of that for the sum over the 144 steps of a date.
  constexpr test::Picture::Pixel pale_green{0xB2, 0xE2, 0xD5};
  EXPECT_GT(at_noon(7).count(pale_green, 2), 4 * at_noon(8).count(pale_green, 2));
}

TEST_F(Plots, DaysWithoutStepsAreAGapInASeason) {
  Days all = days(12, 10, 14);
  const auto is_gap = [](const DayStep& step) { return step.start.day == 8 + 5 || step.start.day == 8 + 6; };
  Days kept;
  for (std::size_t i = 0; i < all.steps.size(); ++i) {
    if (is_gap(all.steps[i])) continue;
    kept.steps.push_back(all.steps[i]);
    kept.lights.push_back(light(300.0));
  }
  const test::Picture picture = day("Twelve days", kept.steps, kept.lights);
  const auto black_at = [&](int column) {
    std::size_t count = 0;
    for (int y = 190; y < 640; ++y) count += picture.at(column, y) == black ? 1 : 0;
    return count;
  };
  EXPECT_EQ(black_at(middle_of(5, 12)), 0U);
  EXPECT_EQ(black_at(middle_of(6, 12)), 0U);
  EXPECT_GT(black_at(middle_of(2, 12) + 50), 0U) << "between two days";
}

TEST_F(Plots, ASeasonWithPhotonsHasAnAxisOfMoles) {
  const auto [steps, lights] = days(10, 10, 12);
  const test::Picture without = day("Ten days", steps, lights);
  const test::Picture with = day("Ten days", steps, lights, 4.57);
  EXPECT_TRUE(has_border_at(without, 1510) && !has_border_at(without, 1440));
  EXPECT_TRUE(has_border_at(with, 1440) && !has_border_at(with, 1510));
}

TEST_F(Plots, DaysWithoutSunHaveOnePanel) {
  for (const int count : {1, 12}) {
    Days all = days(count, 8, 16);
    const test::Picture sunny = day("Sun", all.steps, all.lights);
    for (StepLight& step : all.lights) step.sunlit_leaf_fraction = {no_value, no_value};
    const test::Picture overcast = day("Overcast", all.steps, all.lights);
    EXPECT_EQ(overcast.height, 1100);
    const auto border_row = [](const test::Picture& picture, int row) {
      int dark = 0;
      for (int x = 150; x < 1510; ++x) {
        int darkest = 255;
        for (int y = row - 1; y <= row + 1; ++y) darkest = std::min<int>(darkest, picture.at(x, y)[0]);
        dark += darkest < 0xA0 ? 1 : 0;
      }
      return dark > 1200;
    };
    EXPECT_TRUE(border_row(sunny, 660) && border_row(sunny, 710)) << count;
    EXPECT_FALSE(border_row(overcast, 660) || border_row(overcast, 710)) << count;
    EXPECT_TRUE(border_row(overcast, 975)) << count;
  }
}

TEST_F(Plots, AWholeYearIsDrawn) {
  const auto [steps, lights] = days(365, 10, 11);
  EXPECT_EQ(day("A year", steps, lights).width, 1600);
}

TEST_F(Plots, ABandThatTheTableLacksIsAWarning) {
  const auto [steps, lights] = days(1, 10, 12);
  EXPECT_EQ(day("A day", steps, lights).width, 1600);
  PlotVariables variables;
  variables.set_file("table", folder_ / "day.csv");
  variables.set_text("band", "UV");
  EXPECT_NE(draw_table("day.gp", variables, folder_ / "uv.png").value_or(""), "");
}

TEST_F(Plots, DaysOfAnythingASimulationGives) {
  EXPECT_EQ(day("Night", {step_at(0, 0.0), step_at(0, 0.5)}, {light(0.0), light(0.0)}).width, 1600);
  StepLight one = light(100.0);
  one.bands[0].incident.half_width = one.sunlit_leaf_fraction.half_width = no_value;
  EXPECT_EQ(day("One step, no errors", {step_at(0, 12.0)}, {one}).width, 1600);
}

TEST_F(Plots, ManyCellsAreDrawn) {
  auto [model, result] = test::small_plane();
  PlaneResult& map = result.planes[0];
  map.cells_x = map.cells_z = 300;
  map.crossing.assign(90'000, 12);
  map.reached.assign(90'000, 0);
  for (std::size_t cell = 0; cell < map.reached.size(); cell += 3) map.reached[cell] = 12;
  map.down.clear();
  EXPECT_EQ(plane("Large", model, result, 0).width, 1600);
}

}  // namespace
}  // namespace sunfleck
