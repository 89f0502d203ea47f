#include "files/scene/scene_reader.h"

#include "files/scene/toml_view.h"
#include "support/scene_text.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <ostream>
#include <vector>

namespace sunfleck {
namespace {

// A change that breaks the good scene. The message must name the line that contains `mark`.
struct Breakage {
  const char* name;
  std::string from;
  std::string to;
  std::string mark;
  std::string key;
  std::string hint;  // part of the reason or of the advice
};

void PrintTo(const Breakage& breakage, std::ostream* out) {
  *out << breakage.name;
}

const std::vector<Breakage> breakages = {
    {"PlotMissing", "[plot]\nsize     = [2.0, 3]\nperiodic = false\n", "", "title", "plot", "add [plot]"},
    {"PlotTwice", "[sun]", "[plot]\nsize = [1, 1]\n[sun]", "[plot]\nsize = [1, 1]", "plot", "keep one"},
    {"PlotAsList", "[plot]", "[[plot]]", "[[plot]]", "plot", "write [plot]"},
    {"AxesMisspelt", "title ", "axes = \"east-north-op\"\ntitle ", "east-north-op", "axes", "did you mean east-north-up?"},
    {"AxesUnknown", "title ", "axes = \"z-up\"\ntitle ", "z-up", "axes", "south-up-west, east-north-up"},
    {"PlotEmpty", "[2.0, 3]", "[0.0, 3]", "[0.0, 3]", "plot.size", "give metres"},
    {"PlotNegative", "[2.0, 3]", "[2.0, -3]", "-3]", "plot.size, item 2", "-3"},
    {"PlotHuge", "[2.0, 3]", "[2.0, 1e30]", "1e30", "plot.size", "1000000"},
    {"PlotNan", "[2.0, 3]", "[nan, 3]", "nan", "plot.size", "must lie in"},
    {"PlotThreeNumbers", "[2.0, 3]", "[2.0, 3, 4]", "3, 4]", "plot.size", "has 3"},
    {"PlotSizeText", "[2.0, 3]", "\"2 x 3\"", "\"2 x 3\"", "plot.size", "write it as [1.8, 2.4]"},
    {"PlotItemText", "[2.0, 3]", "[\"2\", 3]", "\"2\"", "plot.size", "without quotes"},
    {"PlotSizeWithUnit", "[2.0, 3]", "\"50 cm\"", "\"50 cm\"", "plot.size", "write it as [0.5, 0.5]"},
    {"PlotItemWithUnit", "[2.0, 3]", "[\"50 cm\", 3]", "\"50 cm\"", "plot.size", "write it without quotes and unit: 0.5"},
    {"PlotUnitUnquoted", "[2.0, 3]", "[50 cm, 3]", "50 cm", "", "write the number without its unit"},
    {"PlotBarePoint", "[2.0, 3]", "[.1, 3]", ".1", "", "write a digit before the point, 0.1 for .1"},
    {"PlotTrailingPoint", "[2.0, 3]", "[2., 3]", "2., 3", "", "write a digit after the point"},
    {"PeriodicYes", "periodic = false", "periodic = yes", "periodic = yes", "", "write true or false"},
    {"AzimuthTypographicMinus", "270", "\u221290", "\u221290", "a typographic minus", "write the hyphen, -"},
    {"TitleTypographicQuote", "\"A test stand\"", "\u201cA test stand\u201d", "\u201cA", "a typographic quote",
     "straight quotes"},
    {"LatitudeLettered", "elevation = 30.0\nazimuth   = 270",
     "time = 2002-08-08T10:10:00Z\nlatitude = \"48.85N\"\nlongitude = 4", "latitude", "sun.latitude",
     "write it without quotes and unit: 48.85"},
    {"LongitudeWest", "elevation = 30.0\nazimuth   = 270", "time = 2002-08-08T10:10:00Z\nlatitude = 3\nlongitude = \"4.5 W\"",
     "longitude", "sun.longitude", "write it without quotes and unit: -4.5"},
    {"LatitudeUnquoted", "elevation = 30.0\nazimuth   = 270", "time = 2002-08-08T10:10:00Z\nlatitude = 48.85N\nlongitude = 4",
     "latitude", "", "negative for south and west"},
    {"BandUnitNotKnown", "direct_normal = 400", "direct_normal = 400\nunit = \"umol_m2_s\"", "unit", "band.unit",
     "add umol_per_joule"},
    {"PlotNoComma", "[2.0, 3]", "[2.0 3]", "[2.0 3]", "", "put commas between the numbers"},
    {"PlotRoundBrackets", "[2.0, 3]", "(2.0, 3)", "(2.0, 3)", "", "square brackets"},
    {"ElevationColon", "elevation = 30.0", "elevation: 30.0", "elevation:", "", "write = between"},
    {"ElevationAltitude", "elevation = 30.0", "altitude = 30.0", "altitude", "sun.altitude", "use elevation"},
    {"ElevationZenith", "elevation = 30.0", "zenith = 60.0", "zenith", "sun.zenith", "use elevation, 90 minus"},
    {"TimeWithSlashes", "elevation = 30.0\nazimuth   = 270", "time = 08/08/2002 10:10", "time", "",
     "2002-08-08T10:10:00+08:00"},
    {"BandWattsUnquoted", "350.0", "350 W", "350 W", "", "write the number without its unit"},
    {"PlotSizeMissing", "size     = [2.0, 3]\n", "", "[plot]", "plot.size", "add size"},
    {"PlotKeyTypo", "size     =", "sise =", "sise", "plot.sise", "did you mean size?"},
    {"PeriodicNumber", "periodic = false", "periodic = 0", "periodic = 0", "plot.periodic", "true or false"},
    {"TopTableTypo", "[camera]", "[camra]", "[camra]", "camra", "did you mean camera?"},
    {"TopKeyUnknown", "[plot]", "units = \"cm\"\n[plot]", "units", "units", "remove it"},
    {"TitleNumber", "\"A test stand\"", "3", "title", "title", "in quotes"},
    {"TitleTwoLines", "\"A test stand\"", "\"A\\nB\"", "title", "title", "one line"},
    {"ElevationRange", "30.0", "91", "elevation", "sun.elevation", "-90..90"},
    {"ElevationInfinite", "30.0", "inf", "elevation", "sun.elevation", "inf"},
    {"ElevationText", "30.0", "\"noon\"", "elevation", "sun.elevation", "number"},
    {"AzimuthRange", "270", "-361", "azimuth", "sun.azimuth", "-360..360"},
    {"AzimuthMissing", "azimuth   = 270\n", "", "[sun]", "sun.azimuth", "add azimuth"},
    {"SunMixed", "azimuth   = 270", "latitude = 3", "elevation", "sun.elevation", "remove it"},
    {"ScaleUnit", "scale   = 0.5", "scale = \"cm\"", "cm", "geometry.scale", "without quotes: 0.01"},
    {"OpticsAsList", "[optics.leaf]", "[[optics]]\nname = \"leaf\"", "[[optics]]", "optics", "write [optics.leaf]"},
    {"SpectrumNumber", "reflectance   = { PAR = 0.12, NIR_1 = 0.45 }\ntransmittance = { PAR = 0.06, NIR_1 = 0.55 }",
     "spectrum = 0.1", "spectrum = 0.1", "optics.leaf.spectrum", "or give numbers as reflectance"},
    {"RangeNumber", "diffuse = 0.0", "range_nm = 550", "range_nm", "band.range_nm", "write it as [400, 700]"},
    {"RangeText", "diffuse = 0.0", "range_nm = \"400-700\"", "range_nm", "band.range_nm", "write it as [400, 700]"},
    {"RangeKey", "diffuse = 0.0", "range = [400, 700]", "range", "band.range", "use range_nm"},
    {"UnitPhotons", "diffuse = 0.0", "unit = \"PPFD\"", "PPFD", "band.unit", "did you mean umol_m2_s?"},
    {"UnitMicromol", "diffuse = 0.0", "unit = \"umol\"", "unit", "band.unit", "did you mean umol_m2_s?"},
    {"UnitNumber", "diffuse = 0.0", "unit = 1", "unit", "band.unit", "must be one of W_m2, umol_m2_s, not a whole number"},
    {"RoleWood", "up      = \"y\"", "role = \"wood\"", "wood", "geometry.role", "did you mean stem?"},
    {"RoleLeaves", "up      = \"y\"", "role = \"Leaves\"", "Leaves", "geometry.role", "did you mean leaf?"},
    {"SplitTrue", "up      = \"y\"", "split = true", "split", "geometry.split",
     "must be one of names, materials, parts, not true"},
    {"SplitOther", "up      = \"y\"", "split = \"part\"", "split", "geometry.split", "did you mean parts?"},
    {"PositionsList", "heading = [0, 90.0]\nat      =", "positions =", "positions", "geometry.positions",
     "write a list of positions as at"},
    {"OpticsList", "{ leaf = \"leaf\", \"*\" = \"bark\" }", "[\"leaf\"]", "optics  =", "geometry.optics",
     "write \"leaf\", or {"},
    {"OpticsInline", "{ leaf = \"leaf\", \"*\" = \"bark\" }", "{ reflectance = 0.1 }", "reflectance = 0.1",
     "geometry.optics.reflectance", "reflectance under [optics.leaf]"},
    {"PatternUnquoted", "{ leaf = \"leaf\", \"*\" = \"bark\" }", "{ leaf* = \"leaf\" }", "leaf*", "",
     "put the pattern in quotes"},
    {"RoleUnknown", "up      = \"y\"", "role = \"leafs\"", "leafs", "geometry.role", "did you mean leaf?"},
    {"RoleNumber", "[optics.bark.upper]", "[optics.bark]\nrole = 1\n[optics.bark.upper]", "role = 1", "optics.bark.role",
     "in quotes"},
    {"SunNoOffset", "elevation = 30.0\nazimuth   = 270", "time = 2002-08-08T10:10:00\nlatitude = 3\nlongitude = 4", "time",
     "sun.time", "+08:00"},
    {"SunTimeText", "elevation = 30.0\nazimuth   = 270", "time = \"2002-08-08T10:10:00Z\"\nlatitude = 3\nlongitude = 4", "time",
     "sun.time", "without quotes"},
    {"SunTimeYear", "elevation = 30.0\nazimuth   = 270", "time = 1202-08-08T10:10:00Z\nlatitude = 3\nlongitude = 4", "time",
     "sun.time", "1900..2100"},
    {"SunNoLatitude", "elevation = 30.0\nazimuth   = 270", "time = 2002-08-08T10:10:00Z\nlongitude = 4", "[sun]",
     "sun.latitude", "degrees north"},
    {"SunLatitudeRange", "elevation = 30.0\nazimuth   = 270", "time = 2002-08-08T10:10:00Z\nlatitude = 90.5\nlongitude = 4",
     "latitude", "sun.latitude", "-90..90"},
    {"SunLongitudeRange", "elevation = 30.0\nazimuth   = 270", "time = 2002-08-08T10:10:00Z\nlatitude = 3\nlongitude = 361",
     "longitude", "sun.longitude", "-180..360"},
    {"SunGoneBandStays", "[sun]\nelevation = 30.0\nazimuth   = 270\n", "", "direct  = 350.0", "band.direct", "add [sun]"},
    {"BandMissing",
     "[[band]]\nname    = \"PAR\"\ndirect  = 350.0\ndiffuse = 0.0\n\n[[band]]\nname          = \"NIR_1\"\ndirect_normal = "
     "400\n",
     "", "title", "band", "add [[band]]"},
    {"BandSingleBrackets", "[[band]]\nname    = \"PAR\"", "[band]\nname    = \"PAR\"", "[[band]]\nname          =", "band",
     "TOML"},
    {"BandNumber",
     "[[band]]\nname    = \"PAR\"\ndirect  = 350.0\ndiffuse = 0.0\n\n[[band]]\nname          = \"NIR_1\"\ndirect_normal = "
     "400\n",
     "[band]\nname = \"PAR\"\n", "[band]", "band", "two brackets"},
    {"BandTwice", "NIR_1", "PAR", "name          =", "band.name", "a different name"},
    {"BandNameSpace", "\"NIR_1\"", "\"N I R\"", "N I R", "band.name", "letters, digits"},
    {"BandNameOfPoints", "\"NIR_1\"", "\"point_PAR\"", "point_PAR", "band.name", "leave out point_"},
    {"BandNameEmpty", "\"NIR_1\"", "\"\"", "\"\"", "band.name", "must not be empty"},
    {"BandNameMissing", "name          = \"NIR_1\"\n", "", "[[band]]\ndirect_normal", "band.name", "add name"},
    {"BandNegative", "350.0", "-350.0", "-350", "band.direct", "give W m-2"},
    {"BandNan", "350.0", "nan", "nan", "band.direct", "must lie in"},
    {"BandHuge", "350.0", "1e16", "1e16", "band.direct", "1e+15"},
    {"BandBothDirect", "direct_normal = 400", "direct_normal = 400\ndirect = 3", "direct_normal", "band.direct_normal",
     "remove one"},
    {"BandDiffuse", "diffuse = 0.0", "diffuse = 60.0", "diffuse", "band.diffuse", "add [sky]"},
    {"BandDiffuseNegative", "diffuse = 0.0", "diffuse = -60.0", "diffuse", "band.diffuse", "give W m-2"},
    {"BandShare", "diffuse = 0.0", "share = 0.5", "share", "band.share", "add [weather]"},
    {"BandSharePercent", "diffuse = 0.0", "share = 50", "share", "band.share = 50", "give 0.5 if percent"},
    {"BandPhotons", "diffuse = 0.0", "umol_per_joule = 0", "umol_per_joule", "band.umol_per_joule", "4.57"},
    {"EmissionBand", "rgb           = [0.05, 0.1, 0.04]", "emission = { PAR = 100.0 }", "emission",
     "optics.leaf.emission.NIR_1", "band NIR_1"},
    {"EmissionNegative", "rgb           = [0.05, 0.1, 0.04]", "emission = -1.0", "emission", "optics.leaf.emission = -1",
     "W m-2"},
    {"SoilPercent", "PAR = 0.15", "PAR = 15", "PAR = 15", "soil.reflectance.PAR = 15", "give 0.15 if percent was meant"},
    {"SoilNoReflectance", "reflectance = { PAR = 0.15, NIR_1 = 0.25 }\n", "", "[soil]", "soil.reflectance", "add reflectance"},
    {"SoilPatchZero", "0.02", "0", "patch", "soil.patch", "give metres"},
    {"SoilPatchTooFine", "0.02", "1e-5", "patch", "soil.patch", "larger patches"},
    {"SoilRgb", "[0.2, 0.15, 0.1]", "[46, 38, 26]", "rgb", "soil.rgb", "divide 8-bit colours"},
    {"TableWithoutBand", "PAR = 0.12, NIR_1 = 0.45", "PAR = 0.12", "PAR = 0.12", "optics.leaf.reflectance.NIR_1", "band NIR_1"},
    {"TableOtherBand", "PAR = 0.12, NIR_1 = 0.45", "PAR = 0.12, NIR_2 = 0.45", "NIR_2", "optics.leaf.reflectance.NIR_2",
     "did you mean NIR_1?"},
    {"SumAboveOne", "NIR_1 = 0.55", "NIR_1 = 0.56", "NIR_1 = 0.56", "optics.leaf.transmittance", "at most 1"},
    {"ReflectanceNegative", "PAR = 0.12", "PAR = -0.12", "-0.12", "optics.leaf.reflectance.PAR = -0.12", "0..1"},
    {"ReflectanceText", "reflectance = 0.3", "reflectance = \"0.3\"", "\"0.3\"", "optics.bark.upper.reflectance",
     "without quotes"},
    {"FaceMissing", "[optics.bark.upper]\nreflectance = 0.3\n", "", "[optics.bark.lower]", "optics.bark.upper",
     "add [optics.bark.upper]"},
    {"FaceAndWhole", "[optics.bark.upper]", "[optics.bark]\nreflectance = 0.1\n[optics.bark.upper]", "reflectance = 0.1\n[",
     "optics.bark.reflectance", "remove it"},
    {"OpticsNotTable", "[optics.leaf]", "[optics]\nstem = 3\n[optics.leaf]", "stem = 3", "optics.stem", "write [optics.leaf]"},
    {"OpticsKeyTypo", "rgb           = [0.05", "rbg = [0.05", "rbg", "optics.leaf.rbg", "did you mean rgb?"},
    {"OpticsUndefined", "[optics.leaf]", "[optics.Leaf]", "optics  =", "geometry.optics.leaf", "did you mean Leaf?"},
    {"OpticsOfTableUndefined", "\"bark\"", "\"wood\"", "optics  =", "geometry.optics.*", "add [optics.wood]"},
    {"OpticsOfAllUndefined", "{ leaf = \"leaf\", \"*\" = \"bark\" }", "\"leef\"", "optics  =", "geometry.optics = \"leef\"",
     "did you mean leaf?"},
    {"GeometryEmpty", "file    = \"plates.obj\"\n", "", "[[geometry]]", "geometry.file", "add file"},
    {"GeometryBoth", "optics  = { leaf = \"leaf\", \"*\" = \"bark\" }", "generator = \"maize\"", "plates.obj", "geometry.file",
     "keep one"},
    {"GeometryTypo", "file    =", "fil =", "fil =", "geometry.fil", "did you mean file?"},
    {"GeneratorUnknown", "file    = \"plates.obj\"", "generator = \"maze\"", "maze", "geometry.generator",
     "did you mean maize?"},
    {"GeneratorWithAt", "file    = \"plates.obj\"", "generator = \"maize\"", "optics  =", "geometry.optics", "remove it"},
    {"FileWithRows", "optics  = { leaf = \"leaf\", \"*\" = \"bark\" }", "rows = 3", "rows", "geometry.rows", "remove it"},
    {"FileMissing", "plates.obj", "plate.obj", "plate.obj", "geometry.file", "no such file"},
    {"FileUnknownFormat", "plates.obj", "scene.toml", "\"scene.toml\"", "geometry.file", ".glb"},
    {"FileIsFolder", "plates.obj", ".", "file    =", "geometry.file", "name a mesh file"},
    {"FileWithNul", "plates.obj", "plates.obj\\u0000", "plates.obj", "geometry.file", "control characters"},
    {"UpUnknown", "\"y\"", "\"w\"", "\"w\"", "geometry.up", "one of x, y, z"},
    {"ScaleZero", "scale   = 0.5", "scale = 0", "scale = 0", "geometry.scale", "file in cm"},
    {"ScaleHuge", "scale   = 0.5", "scale = 1e9", "plates.obj", "geometry.file", "scale = 0.001"},
    {"HeadingCount", "[0, 90.0]", "[0, 90.0, 180]", "heading", "geometry.heading", "give one for each"},
    {"HeadingText", "[0, 90.0]", "\"north\"", "heading", "geometry.heading", "number"},
    {"AtFlat", "[[0.5, 0.0, 1.0], [1.5, 0.25, 2.0]]", "[0.5, 0.0, 1.0]", "at      =", "geometry.at", "[[0.9, 0.0, 1.2]]"},
    {"AtEmpty", "[[0.5, 0.0, 1.0], [1.5, 0.25, 2.0]]", "[]", "at      =", "geometry.at", "[[0.9, 0.0, 1.2]]"},
    {"AtTwoNumbers", "[1.5, 0.25, 2.0]", "[1.5, 2.0]", "at      =", "geometry.at, item 2", "has 2 numbers"},
    {"AtOnLaterLine", "[1.5, 0.25, 2.0]", "\n\n [1.5, inf, 2.0]", "[1.5, inf", "geometry.at", "inf"},
    {"DirectBoundZero", "0.002", "0", "direct     = 0", "accuracy.direct", "0.001"},
    {"IndirectBoundOne", "0.004", "1.0", "indirect", "accuracy.indirect", "below 1"},
    {"ConfidencePercent", "confidence = 0.9", "confidence = 95", "confidence", "accuracy.confidence", "0.95"},
    {"OfSensorsWithoutAny", "\"organ\"", "\"sensors\"", "sensors", "accuracy.of", "[[sensor]]"},
    {"OfUnknown", "\"organ\"", "\"organs\"", "organs", "accuracy.of", "did you mean organ?"},
    {"CameraNowhere", "[0.9, 1.0, 1.2]", "[3.0, 2.5, 3.0]", "look_at", "camera.look_at", "another point"},
    {"CameraFov", "fov      = 50", "fov = 180", "fov", "camera.fov", "1..179"},
    {"CameraNoPosition", "position = [3.0, 2.5, 3.0]\n", "", "[camera]", "camera.position", "add position"},
    {"LayersZero", "layers = 12", "layers = 0", "layers", "output.layers", "1..10000"},
    {"LayersReal", "layers = 12", "layers = 12.0", "layers", "output.layers", "whole number"},
    {"LayersTypo", "layers = 12", "layer = 12", "layer = 12", "output.layer", "did you mean layers?"},
    {"SyntaxNoValue", "fov      = 50", "fov = ", "fov =", "TOML", "correct the TOML syntax"},
    {"SyntaxQuote", "\"A test stand\"", "\"A test stand", "title", "TOML", "TOML syntax"},
    {"SyntaxDecimalComma", "fov      = 50", "fov = 48,85 # \"x\"", "fov =", "TOML", "with a point, not a comma"},
    {"SyntaxCommaInTable", "PAR = 0.15", "PAR = 0,15", "PAR = 0,15", "TOML", "with a point, not a comma"},
    {"SyntaxBackslash", "\"A test stand\"", R"("C:\Users")", "title", "TOML", "write / for each backslash"},
    {"SyntaxEscape", "\"A test stand\"", R"("C:\data")", "title", "TOML", "in single quotes"},
    {"SyntaxBoolean", "fov      = 50", "fov = True", "fov =", "TOML", "write true or false"},
    {"SyntaxPercent", "fov      = 50", "fov = 10 %", "fov =", "TOML", "0.1 for 10 %"},
    {"SyntaxPercentClose", "fov      = 50", "fov = 10%", "fov =", "TOML", "0.1 for 10 %"},
    {"SyntaxTime", "elevation = 30.0", "time = 2002-08-08T12:00+02:00", "time =", "TOML", "hh:mm:ss"},
    {"SyntaxBareText", "\"A test stand\"", "stand", "title", "TOML", "put the text in quotes"},
    {"SyntaxBareFile", "\"plates.obj\"", "./plates.obj", "file    =", "TOML", "put the text in quotes"},
    {"KeyTwice", "fov      = 50", "fov = 50\nfov = 60", "fov = 60", "TOML", "keep one"},
    {"NulByte", "fov      = 50", std::string("fov = 5\0", 8), "fov =", "NUL", "UTF-8"},
};

using BrokenSceneFile = SceneFolder;

class BrokenScene : public SceneFolder, public ::testing::WithParamInterface<Breakage> {};

TEST_P(BrokenScene, IsOneClearError) {
  const Breakage& breakage = GetParam();
  const std::string text = replaced(good_scene, breakage.from, breakage.to);
  const std::string message = expect_refusal([&] { static_cast<void>(read(text)); }, breakage.hint);
  const std::string place = file().string() + ":" + std::to_string(line_of(text, breakage.mark)) + ": ";
  EXPECT_EQ(message.substr(0, place.size()), place) << message;
  EXPECT_NE(message.find(breakage.key), std::string::npos) << message;
}

INSTANTIATE_TEST_SUITE_P(All, BrokenScene, ::testing::ValuesIn(breakages), [](const auto& each) { return each.param.name; });

TEST_F(BrokenSceneFile, GeneratorsNumbersAreChecked) {
  const std::string text =
      bare_scene + "[[geometry]]\ngenerator = \"maize\"\nrows = 4\nper_row = 3\nspacing = [0.6, 0.6]\nseed = 1\n";
  const std::vector<Breakage> cases = {
      {"", "rows = 4", "rows = 0", "rows = 0", "geometry.rows", "1..10000"},
      {"", "rows = 4", "rows = 10001", "rows", "geometry.rows", "1..10000"},
      {"", "rows = 4", "rows = 10000", "rows", "geometry.rows", "30000 plants"},
      {"", "rows = 4", "rows = 4.5", "rows", "geometry.rows", "whole number"},
      {"", "per_row = 3", "per_row = -3", "per_row", "geometry.per_row", "1..10000"},
      {"", "[0.6, 0.6]", "[0.6, 0]", "spacing", "geometry.spacing, item 2", "above 0"},
      {"", "[0.6, 0.6]", "0.6", "spacing", "geometry.spacing", "2 numbers"},
      {"", "seed = 1", "seed = -1", "seed", "geometry.seed", "at least 0"},
      {"", "seed = 1", "at = [[0, 0, 0]]", "at =", "geometry.at", "remove it"},
      {"", "seed = 1", "", "generator", "geometry.generator", "add [optics.leaf]"},
  };
  for (const Breakage& breakage : cases) {
    expect_refused(replaced(text, breakage.from, breakage.to), breakage.mark, breakage.key, breakage.hint);
  }
}

TEST_F(BrokenSceneFile, RefusesWhatIsNoScene) {
  const auto refused = [&](const std::filesystem::path& path) {
    expect_refusal([&] { static_cast<void>(read_scene(path)); }, path.filename().string());
  };
  refused(folder_ / "missing.toml");
  refused(folder_.path());
  const std::vector<std::string> texts = {"",
                                          " \n\n",
                                          "# only a comment\n",
                                          {'\xff', '\xfe', '[', '\0', 'p', '\0'},  // the beginning of a UTF-16 text
                                          std::string(1000, '\0'),
                                          "title = \"\xc3\"\n",
                                          "# \xff\n",
                                          "\x1b[31m = 3\n",
                                          "{}",
                                          "]]]]"};
  for (const std::string& text : texts) {
    write(file(), text);
    refused(file());
  }
}

TEST_F(BrokenSceneFile, RefusesAMesh) {
  write(folder_ / "stand.glb", "glTF");
  expect_refusal([&] { static_cast<void>(read_scene(folder_ / "stand.glb")); },
                 "stand.glb: not a scene (this is a mesh); write a scene for it");
}

TEST_F(BrokenSceneFile, RefusesFormatsThatNoReaderIsFor) {
  for (const char* name : {"stand.fbx", "STAND.USDZ", "stand.ops", "stand.mtg", "stand.bgeom", "stand.lpy", "cloud.las"}) {
    write(folder_ / name, "FBXHeaderExtension:  {\n");
    expect_refusal([&] { static_cast<void>(read_scene(folder_ / name)); },
                   fmt::format("{}: not a scene (there is no reader for this format); export a mesh as .glb", name));
  }
}

TEST_F(BrokenSceneFile, RefusesAMeshOfAnotherName) {
  const std::pair<const char*, const char*> meshes[] = {{"ply\nformat ascii 1.0\n", ".ply"},
                                                        {"# Blender\nmtllib a.mtl\n", ".obj"},
                                                        {"v 0 0 1\n", ".obj"},
                                                        {"p 1 100001001000 3 0 0 0\n", ".can"},
                                                        {"solid a\n facet normal", ".stl"},
                                                        {"<?xml?>\n<COLLADA>", ".dae"},
                                                        {"<opf version>", ".opf"}};
  for (const auto& [bytes, ending] : meshes) {
    write(folder_ / "mesh.txt", bytes);
    expect_refusal([&] { static_cast<void>(read_scene(folder_ / "mesh.txt")); },
                   fmt::format("is a mesh ({0}), not a scene in TOML); rename it so that it ends in {0}", ending));
    expect_refusal([&] { static_cast<void>(read(replaced(good_scene, "plates.obj", "mesh.txt"))); },
                   fmt::format("looks like {0}); rename it so that it ends in {0}", ending));
  }
}

// Excessive nesting must overflow the stack neither in the parser nor when its tree is freed.
TEST_F(BrokenSceneFile, DeepNestingIsRefused) {
  constexpr int depth = 200000;
  const auto repeated = [](const std::string& piece) {
    std::string text;
    for (int i = 0; i < depth; ++i) text += piece;
    return text;
  };
  const std::string dotted = repeated("a.");
  const std::vector<std::string> texts = {
      fmt::format("{}a = 1\n", dotted),
      fmt::format("[{}a]\n", dotted),
      fmt::format("[[{}a]]\n", repeated("\"=\" . ")),
      fmt::format("x = {{ b = [\"\"\"a\"\"\"\"\", {{{}a = 1}}] }}\n", repeated("'#'.")),
      fmt::format("x = {}\n", repeated("[")),
      fmt::format("x = {}{}\n", repeated("["), repeated("]")),
      fmt::format("x = {}1{}\n", repeated("{a = "), repeated("}")),
      fmt::format("x = \"\\\"\" # {}\n{}a = 1\n", repeated("."), dotted),
  };
  for (const std::string& text : texts) {
    SCOPED_TRACE(text.substr(0, 20));
    EXPECT_LT(expect_refusal([&] { static_cast<void>(read(bare_scene + text)); }).size(), 1000U);
  }
  // Dots in texts and comments are not nesting.
  EXPECT_FALSE(
      message_of([&] { static_cast<void>(read("title = \"....................\" # ....................\n" + bare_scene)); }));
}

}  // namespace
}  // namespace sunfleck
