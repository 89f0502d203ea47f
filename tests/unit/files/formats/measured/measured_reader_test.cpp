#include "files/formats/measured/measured_reader.h"

#include "base/error.h"
#include "support/error_text.h"
#include "support/temp_folder.h"

#include <gtest/gtest.h>

#include <string>

namespace sunfleck {
namespace {

class Measured : public testing::Test {
 protected:
  [[nodiscard]] MeasuredProfile read(const std::string& text) const { return read_measured(folder_.write("field.csv", text)); }

  // Returns the message without the folder's path.
  [[nodiscard]] std::string message(const std::string& text) const {
    const auto what = message_of([&] { static_cast<void>(read(text)); });
    if (!what) return "no error";
    EXPECT_EQ(what->find('\n'), std::string::npos) << *what;
    return what->substr(what->find("field.csv"));
  }

  TempFolder folder_;
};

TEST_F(Measured, ReadsItsPoints) {
  const MeasuredProfile got = read("# by Ma, 2002\nheight_m,sunfleck_ratio\n0,0.18\n# a remark\n\n0.5 , 0.25\n2.6,1\n");
  EXPECT_EQ(got.name, "field.csv");
  ASSERT_EQ(got.points.size(), 3U);
  EXPECT_EQ(got.points[1].height_m, 0.5);
  EXPECT_EQ(got.points[1].sunfleck_ratio, 0.25);
}

TEST_F(Measured, TakesWhatSpreadsheetsAndRWrite) {
  EXPECT_EQ(read("\xef\xbb\xbf\"height_m\",\"sunfleck_ratio\"\r\n0.1,0.2\r\n").points.at(0).sunfleck_ratio, 0.2);
  EXPECT_EQ(read("height_m;sunfleck_ratio\n0,1;0,25\n").points.at(0).sunfleck_ratio, 0.25);
  EXPECT_EQ(read("height_m\tsunfleck_ratio\n0.1\t0,25\n").points.at(0).height_m, 0.1);
  const MeasuredProfile swapped = read("sunfleck_ratio,height_m\n0.2,1.5");
  EXPECT_EQ(swapped.points.at(0).height_m, 1.5);
  EXPECT_EQ(swapped.points.at(0).sunfleck_ratio, 0.2);
}

TEST_F(Measured, RefusesOtherColumns) {
  const std::string cure = "(exactly height_m and sunfleck_ratio are expected); give the header height_m,sunfleck_ratio";
  EXPECT_EQ(message("0.1,0.2\n0.3,0.4\n"), "field.csv:1: columns '0.1,0.2' " + cure);
  EXPECT_EQ(message("height,ratio\n0.3,0.4\n"), "field.csv:1: columns 'height,ratio' " + cure);
  EXPECT_EQ(message("height_m,sunfleck_ratio,n\n0.3,0.4,3\n"), "field.csv:1: columns 'height_m,sunfleck_ratio,n' " + cure);
  EXPECT_EQ(message("height;ratio\n0,3;0,4\n"), "field.csv:1: columns 'height,ratio' " + cure);
  EXPECT_EQ(message("a,b\nx,y\n"), "field.csv:1: columns 'a,b' " + cure);
  EXPECT_EQ(message("#\nheight_m\n0.3\n"), "field.csv:2: columns 'height_m' " + cure);
  EXPECT_EQ(message("height_m;sunfleck_ratio\n0.3\n"),
            "field.csv:2: 1 cells (the header in line 1 has 2 columns); give one cell per column, separated by semicolons");
  EXPECT_EQ(message("height_m,height_m\n"), "field.csv:1: column 'height_m' twice (column names must differ); rename one");
  EXPECT_EQ(message(",height_m,sunfleck_ratio\n1,2,3\n"),
            "field.csv:1: a column without a name (the header must name every column); name it");
}

TEST_F(Measured, RefusesWhatIsNoShareOrNoHeight) {
  const std::string head = "height_m,sunfleck_ratio\n";
  EXPECT_EQ(message(head + "1,12\n"), "field.csv:2: sunfleck_ratio = 12 (must lie in 0..1); give 0.12 if percent was meant");
  EXPECT_EQ(message(head + "1,0.1\n1,-0.1\n"),
            "field.csv:3: sunfleck_ratio = -0.1 (must lie in 0..1); give the share of the horizontal plane in direct sun");
  EXPECT_EQ(message(head + "-0.5,0.1\n"),
            "field.csv:2: height_m = -0.5 (must not lie below the ground); give the height above the ground in metres");
  EXPECT_EQ(message(head + ",0.1\n"), "field.csv:2: height_m is empty (every row needs both values); fill it in");
  EXPECT_EQ(message(head + "1,\n"),
            "field.csv:2: sunfleck_ratio is empty (every row needs both values); fill it in or remove the row");
  for (const char* bad : {"nan", "NaN", "inf", "-inf", "1e999", "0x1p-1", "0.1.2", "1 m", "--1", "\"", "1e"})
    EXPECT_EQ(message(head + "1," + bad + "\n"),
              "field.csv:2: sunfleck_ratio = '" + std::string(bad) + "' (not a finite number); correct the number");
  EXPECT_EQ(message(head + "0,5,0,2\n"),
            "field.csv:2: 4 cells (the header in line 1 has 2 columns); give one cell per column, separated by commas, "
            "with a decimal point in numbers");
  EXPECT_EQ(message(head + "1\n").substr(0, 20), "field.csv:2: 1 cells");
}

TEST_F(Measured, RefusesFilesWithoutContent) {
  for (const char* nothing : {"", "\n\n", "# only\n# remarks\n", "\xef\xbb\xbf"})
    EXPECT_EQ(message(nothing),
              "field.csv: only blank lines and comments (a line of column names must come first); check the file");
  EXPECT_EQ(message("height_m,sunfleck_ratio\n# none\n"),
            "field.csv:1: no rows below the header (at least one is required); check the file");
  EXPECT_THROW(static_cast<void>(read_measured(folder_ / "missing.csv")), Error);
  EXPECT_THROW(static_cast<void>(read_measured(folder_.path())), Error);
}

TEST_F(Measured, RefusesFilesThatAreNoTable) {
  EXPECT_EQ(message(std::string(10'000'001, '0')),
            "field.csv: cannot be read (it has 10000001 bytes, but at most 10000000 are allowed); use a smaller file");
  EXPECT_NE(message(std::string("\0\1\2\3\xff\xfe,\x1b[31m", 12)).find("field.csv:1: "), std::string::npos);
  EXPECT_LT(message(std::string(1'000'000, 'x')).size(), 200U) << "a long cell is cut";
}

// Every cut of a good file, and every byte of it changed, is read or refused in one line of three parts, and never anything else.
TEST_F(Measured, SurvivesBeingCutAndGarbled) {
  const std::string good = "# x\nheight_m,sunfleck_ratio\n0,0.18\n0.5,0.25\n";
  int read = 0;
  int refused = 0;
  const auto attack = [&](const std::string& text) {
    const std::string said = message(text);
    ++(said == "no error" ? read : refused);
    if (said == "no error") return;
    EXPECT_EQ(said.rfind("field.csv", 0), 0U) << said;
    EXPECT_LT(said.find(" ("), said.find("); ")) << said;
    EXPECT_LT(said.find("); "), said.size() - 4) << said;
  };
  for (std::size_t length = 0; length < good.size(); ++length) attack(good.substr(0, length));
  const auto header = static_cast<int>(good.find("\n0,"));
  EXPECT_GT(refused, header) << "without a point there is no profile";
  EXPECT_GT(read, 0);
  read = refused = 0;
  for (std::size_t at = 0; at < good.size(); ++at) {
    for (const char c : {'\0', '\n', '\r', ',', '"', '#', '-', '9', '\xff'}) {
      std::string garbled = good;
      garbled[at] = c;
      attack(garbled);
    }
  }
  EXPECT_GT(refused, 7 * static_cast<int>(good.size())) << "of nine changes a byte";
  EXPECT_GT(read, 0);
}

}  // namespace
}  // namespace sunfleck
