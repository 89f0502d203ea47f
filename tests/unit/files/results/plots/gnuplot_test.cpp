#include "files/results/plots/gnuplot.h"

#include "base/error.h"
#include "support/gnuplot.h"

#include <gtest/gtest.h>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
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

// All processes that it started hold the pipe open until the last of them ends.
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

}  // namespace
}  // namespace sunfleck
