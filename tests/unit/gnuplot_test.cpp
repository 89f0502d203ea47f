#include "io/gnuplot.h"

#include "base/error.h"
#include "io/plot_script.h"
#include "support/gnuplot.h"

#include <gtest/gtest.h>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <random>
#include <string>
#include <thread>

namespace sunfleck {
namespace {

namespace fs = std::filesystem;

// Limits the wait for something that should end at once.
constexpr std::chrono::duration<double> patience{600.0};

// Puts a shell script in gnuplot's place.
class Impostor : public testing::Test {
 protected:
  [[nodiscard]] std::string warning(const std::string& body, double limit_s = patience.count()) const {
    const fs::path program = folder_.write("impostor", "#!/bin/sh\n" + body + "\n");
    fs::permissions(program, fs::perms::owner_all);
    const std::string script(1 << 20, '#');  // more than a pipe holds
    return draw_plot(script, file(), {program.string(), limit_s}).value_or("");
  }
  [[nodiscard]] fs::path file() const { return folder_ / "profile.png"; }

  TempFolder folder_;
};

TEST_F(Impostor, ThatIsNotThere) {
  EXPECT_EQ(draw_plot("plot x", file(), {"no-such-gnuplot"}).value_or(""),
            "gnuplot not found: profile.png is left out; install gnuplot-nox");
  EXPECT_EQ(draw_plot("plot x", file(), {(folder_ / "gnuplot").string()}).value_or(""),
            "gnuplot not found: profile.png is left out; install gnuplot-nox");
}

TEST_F(Impostor, ThatMayNotBeRun) {
  const fs::path program = folder_.write("impostor", "#!/bin/sh\n");
  fs::permissions(program, fs::perms::owner_read | fs::perms::owner_write);
  EXPECT_EQ(draw_plot("plot x", file(), {program.string()}).value_or(""),
            "gnuplot failed: profile.png is left out (Permission denied)");
}

// Everything it started holds a pipe open, which ends with the last of them.
TEST_F(Impostor, ThatHangsIsKilledWithAllItStarted) {
  const fs::path pipe = folder_ / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  const int end = ::open(pipe.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  ASSERT_GE(end, 0);
  EXPECT_EQ(warning("exec 9> '" + pipe.string() + "'; sleep 100000 & wait", 0.5),
            "gnuplot failed: profile.png is left out (it did not end within 0.5 s)");
  char byte = 0;
  ssize_t got = -1;
  for (const auto begin = std::chrono::steady_clock::now(); got != 0;) {
    got = ::read(end, &byte, 1);
    ASSERT_LT(std::chrono::steady_clock::now() - begin, patience) << "one of them is still there";
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  ::close(end);
}

TEST_F(Impostor, ThatFailsIsQuoted) {
  EXPECT_EQ(warning("echo 'plot oops' >&2; echo '         line 3: undefined variable: oops' >&2; exit 7"),
            "gnuplot failed: profile.png is left out (exit status 7: line 3: undefined variable: oops)");
  EXPECT_EQ(warning("exit 3"), "gnuplot failed: profile.png is left out (exit status 3)");
  EXPECT_EQ(warning("kill -9 $$"), "gnuplot failed: profile.png is left out (it was killed by signal 9)");
  EXPECT_FALSE(fs::exists(file()));
}

TEST_F(Impostor, ThatDrawsNothing) {
  for (const char* body : {"true", "echo no picture", "cat", "printf '\\211PNG\\r\\n\\032\\n and then nothing'"})
    EXPECT_EQ(warning(body), "gnuplot failed: profile.png is left out (it wrote no picture)") << body;
  EXPECT_FALSE(fs::exists(file()));
}

TEST_F(Impostor, ThatWritesWithoutEnd) {
  EXPECT_EQ(warning("cat /dev/zero"), "gnuplot failed: profile.png is left out (its output is too large)");
  EXPECT_EQ(warning("cat /dev/zero >&2"), "gnuplot failed: profile.png is left out (its output is too large)");
}

TEST_F(Impostor, SeesNeitherTheUsersSettingsNorHisLanguage) {
  ::setenv("GNUTERM", "x11", 1);
  ::setenv("LC_NUMERIC", "de_DE.UTF-8", 1);
  EXPECT_EQ(warning("echo $1 $GNUTERM $LC_NUMERIC $LC_ALL >&2; exit 1"),
            "gnuplot failed: profile.png is left out (exit status 1: --default-settings C.UTF-8)");
  ::unsetenv("GNUTERM");
  ::unsetenv("LC_NUMERIC");
}

using Gnuplot_ = test::GnuplotTest;

TEST_F(Gnuplot_, SaysWhatItDidNotUnderstand) {
  const std::string warning = draw_plot("set terminal pngcairo\nplot oops\n", folder_ / "a.png").value_or("");
  EXPECT_NE(warning.find("a.png is left out (exit status 1: "), std::string::npos) << warning;
  EXPECT_NE(warning.find("undefined variable: oops"), std::string::npos) << warning;
}

TEST_F(Gnuplot_, AFolderThatIsNotThereIsAnError) {
  EXPECT_THROW(static_cast<void>(draw_plot("set terminal pngcairo\nplot x\n", folder_ / "none" / "a.png")), Error);
}

// Draws a title that a user could have written, inserted at every place of a script that takes text.
test::Picture with_title(const test::GnuplotTest&, const std::string& title, const TempFolder& folder) {
  PlotScript script(500, 300);
  script.place({60.0, 60.0, 400.0, 150.0});
  script.legend(60.0, 40.0, 1);
  script.headline(title, 20.0, 12, 40);
  script.x_title(title);
  script.y_title(title);
  script.notice(title);
  script.add("set title {} noenhanced", plot_quoted(title));
  script.add("plot [0:1] x title {}, keyentry with points title {}", plot_quoted(title), plot_quoted(title));
  const fs::path file = folder / "title.png";
  EXPECT_EQ(draw_plot(script.text(), file).value_or(""), "") << title;
  return test::read_picture(file);
}

TEST_F(Gnuplot_, AHostileTitleIsOnlyText) {
  const fs::path mark = folder_ / "mark";
  const std::string touch = "touch " + mark.string();
  const std::string titles[] = {"'; system '" + touch + "'; set title '",
                                "\"; system \"" + touch + "\"; \"",
                                "`" + touch + "`",
                                "a `" + touch + "` \" `" + touch + "` ' `" + touch + "`",
                                "$(" + touch + ")",
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
                                "$data << EOD",
                                "EOD",
                                "",
                                std::string("nul\0nul", 7),
                                "\xff\xfe broken \xc3",
                                "W m\u207b\u00b2 \u00b1 \u6c34",
                                std::string(100000, 'M')};
  const test::Picture plain = with_title(*this, "plain", folder_);
  EXPECT_GT(plain.count({255, 255, 255}), 0U);
  for (const std::string& title : titles) {
    const test::Picture picture = with_title(*this, title, folder_);
    EXPECT_EQ(picture.width, 500) << title;
    EXPECT_EQ(picture.height, 300) << title;
    EXPECT_FALSE(fs::exists(mark)) << title;
  }
}

TEST_F(Gnuplot_, RandomTextsOfTheDangerousCharactersAreOnlyText) {
  const std::string alphabet = "'\"`\\{}()[]@$#!|;,&<>%^_~*?\n\r\t ax0\xc3\xa9\xff";
  std::mt19937 random(1);
  for (int i = 0; i < 60; ++i) {
    std::string title;
    for (int length = 1 + static_cast<int>(random() % 30); length > 0; --length) title += alphabet[random() % alphabet.size()];
    EXPECT_EQ(with_title(*this, title, folder_).width, 500) << title;
  }
}

TEST(PlotQuoted, HoldsOneLineOfUtf8WithoutQuotes) {
  EXPECT_EQ(plot_quoted("it's `x`"), "'it\u2019s \u2018x\u2018'");
  EXPECT_EQ(plot_quoted("a\nb\tc\x7f"), "'a b c '");
  EXPECT_EQ(plot_quoted("\xc3\xa9\xc3"), "'\xc3\xa9\xef\xbf\xbd'");
  EXPECT_EQ(plot_quoted("\xed\xa0\x80"), "'\xef\xbf\xbd\xef\xbf\xbd\xef\xbf\xbd'") << "half of a surrogate pair";
  EXPECT_EQ(plot_quoted("\xc2\x85"), "' '") << "a control character of two bytes";
  EXPECT_EQ(plot_quoted("abc", 3), "'abc'");
  EXPECT_EQ(plot_quoted("abcd", 3), "'abc\xe2\x80\xa6'");
  EXPECT_EQ(plot_quoted("\xc3\xa9\xc3\xa9", 1), "'\xc3\xa9\xe2\x80\xa6'") << "counted in characters";
}

TEST(TicStep, LeavesRoomForLabels) {
  EXPECT_DOUBLE_EQ(tic_step(1.0, 1000.0, 100.0), 0.1);
  EXPECT_DOUBLE_EQ(tic_step(2.6, 700.0, 70.0), 0.5);
  EXPECT_DOUBLE_EQ(tic_step(350.0, 100.0, 50.0), 200.0);
  EXPECT_DOUBLE_EQ(tic_step(7.0, 100.0, 100.0), 10.0);
  EXPECT_DOUBLE_EQ(tic_step(0.0, 100.0, 50.0), 1.0);
}

}  // namespace
}  // namespace sunfleck
