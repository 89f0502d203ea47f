#pragma once
// Runs the built program as a user does, in a separate folder and with its output in files, and reads the files that it wrote.

#include "support/content.h"
#include "support/temp_folder.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

namespace sunfleck::regression {

using Arguments = std::vector<std::string>;

struct Outcome {
  int status = -1;
  std::string out, err;
  double seconds = 0.0;
  double peak_mib = 0.0;  // peak of resident memory
};

using test::content;

inline std::filesystem::path scene_file(const std::string& name) {
  return std::filesystem::path(SUNFLECK_SOURCE_DIR) / "scenes" / name;
}

inline Arguments operator+(Arguments left, const Arguments& right) {
  left.insert(left.end(), right.begin(), right.end());
  return left;
}

// Runs the tests of one program in one folder.
class ProgramTest : public ::testing::Test {
 protected:
  using Files = std::map<std::string, std::string>;
  using Watch = std::function<void(pid_t, const std::string& err)>;

  // Runs the program with the test's folder as the working directory; `watch` is called every few milliseconds.
  [[nodiscard]] Outcome run(const Arguments& arguments, const Watch& watch = {}) const {
    const std::filesystem::path out = folder_ / "stdout.txt";
    const std::filesystem::path err = folder_ / "stderr.txt";
    std::filesystem::remove(out);
    std::filesystem::remove(err);
    const auto begin = std::chrono::steady_clock::now();
    const auto elapsed_s = [&] { return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(); };
    const pid_t child = ::fork();
    if (child == 0) become_program(arguments, out, err);
    int state = 0;
    rusage usage{};
    while (::wait4(child, &state, WNOHANG, &usage) == 0) {
      if (watch) watch(child, content(err));
      if (elapsed_s() > longest_run_s) {
        ADD_FAILURE() << "it did not end within " << longest_run_s << " s";
        ::kill(child, SIGKILL);
        ::wait4(child, &state, 0, &usage);
        break;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    EXPECT_TRUE(WIFEXITED(state) || may_be_killed_) << "killed by signal " << WTERMSIG(state);
    return {WIFEXITED(state) ? WEXITSTATUS(state) : -1, content(out), content(err), elapsed_s(),
            static_cast<double>(usage.ru_maxrss) / 1024.0};
  }

  // Runs `run SCENE ... -o out` and expects exit status `status`.
  Outcome simulate(const std::filesystem::path& scene, const Arguments& more, int status = 0, const std::string& to = "out",
                   const Watch& watch = {}) const {
    Outcome outcome = run(Arguments{"run", scene.string(), "-o", to} + more, watch);
    EXPECT_EQ(outcome.status, status) << outcome.err;
    return outcome;
  }

  [[nodiscard]] nlohmann::json summary(const std::string& of = "out") const {
    return nlohmann::json::parse(content(folder_ / of / "summary.json"), nullptr, false);
  }
  [[nodiscard]] std::string file(const std::string& name, const std::string& of = "out") const {
    return content(folder_ / of / name);
  }
  [[nodiscard]] bool exists(const std::string& name, const std::string& of = "out") const {
    return std::filesystem::exists(folder_ / of / name);
  }
  // Returns all files of a folder and its subfolders, with their contents.
  [[nodiscard]] Files files(const std::string& of = "out") const {
    Files found;
    if (!std::filesystem::exists(folder_ / of)) return found;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_ / of)) {
      if (entry.is_regular_file()) {
        found[std::filesystem::relative(entry.path(), folder_ / of).string()] = content(entry.path());
      }
    }
    return found;
  }
  // Returns the CSV files among them, whose bytes must not depend on how a run was made.
  [[nodiscard]] Files csv_files(const std::string& of) const {
    Files found = files(of);
    std::erase_if(found, [](const auto& file) { return !file.first.ends_with(".csv"); });
    return found;
  }

  TempFolder folder_;
  std::function<void()> before_program_;  // called in the new process
  bool may_be_killed_ = false;

 private:
  // Limits runs that hang: a run that ends at all ends within this time, even with line counters or under a sanitizer, beside
  // another build.
  static constexpr double longest_run_s = 600.0;

  [[noreturn]] void become_program(const Arguments& arguments, const std::filesystem::path& out,
                                   const std::filesystem::path& err) const {
    std::vector<char*> argv{const_cast<char*>("sunfleck")};
    for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
    argv.push_back(nullptr);
    constexpr int mode = 0600;
    const int out_file = ::open(out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, mode);
    const int err_file = ::open(err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, mode);
    const bool ready = out_file >= 0 && err_file >= 0 && ::dup2(out_file, STDOUT_FILENO) >= 0 &&
                       ::dup2(err_file, STDERR_FILENO) >= 0 && ::chdir(folder_.path().c_str()) == 0;
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) std::signal(signal, SIG_DFL);  // as in a terminal
    if (before_program_) before_program_();
    if (ready) ::execv(SUNFLECK_PROGRAM, argv.data());
    ::_exit(126);
  }
};

// Expects the error that a user sees: one line that names the place (`names`), the fault in brackets and the remedy; standard
// output must be empty.
inline void expect_one_error(const Outcome& outcome, int status, const std::string& names) {
  EXPECT_EQ(outcome.status, status) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(outcome.err.rfind("sunfleck: ", 0), 0U) << outcome.err;
  EXPECT_EQ(outcome.err.find('\n'), outcome.err.size() - 1) << outcome.err;
  EXPECT_NE(outcome.err.find(names), std::string::npos) << outcome.err << "does not name " << names;
  const std::size_t why = outcome.err.find(" (");
  const std::size_t cure = outcome.err.find("); ");
  EXPECT_TRUE(why < cure && cure < outcome.err.size() - 4) << outcome.err;
}

inline bool is_set(const char* variable) {
  const char* value = std::getenv(variable);
  return value != nullptr && std::string(value) == "1";
}

}  // namespace sunfleck::regression
