#include "files/results/plots/gnuplot.h"

#include "base/file.h"
#include "base/stopwatch.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <thread>
#include <vector>

namespace sunfleck {
namespace {

constexpr off_t largest_output_bytes = 64 << 20;  // a picture of this program has less than one megabyte
constexpr auto look_again = std::chrono::milliseconds(5);

// An anonymous file in memory. gnuplot reads its script from one and writes to two others, so that no pipe can break or fill up
// and no file is left behind.
class MemoryFile {
 public:
  explicit MemoryFile(const char* name) : number_(::memfd_create(name, MFD_CLOEXEC)) {}
  ~MemoryFile() {
    if (number_ >= 0) ::close(number_);
  }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  [[nodiscard]] int number() const { return number_; }

  // Fills the file. Returns false, with errno, if it could not be created or filled.
  [[nodiscard]] bool fill(std::string_view bytes) const {
    if (number_ < 0) return false;
    while (!bytes.empty()) {
      const ssize_t written = ::write(number_, bytes.data(), bytes.size());
      if (written < 0 && errno != EINTR) return false;
      if (written > 0) bytes.remove_prefix(static_cast<std::size_t>(written));
    }
    return ::lseek(number_, 0, SEEK_SET) == 0;
  }

  [[nodiscard]] off_t size() const {
    struct stat state {};
    return ::fstat(number_, &state) == 0 ? state.st_size : 0;
  }

  [[nodiscard]] std::string content() const {
    std::string bytes(static_cast<std::size_t>(size()), '\0');
    std::size_t got = 0;
    while (got < bytes.size()) {
      const ssize_t more = ::pread(number_, bytes.data() + got, bytes.size() - got, static_cast<off_t>(got));
      if (more == 0 || (more < 0 && errno != EINTR)) break;
      if (more > 0) got += static_cast<std::size_t>(more);
    }
    bytes.resize(got);
    return bytes;
  }

 private:
  int number_;
};

struct Files {
  MemoryFile script{"script"}, picture{"picture"}, messages{"messages"};
};

// Returns the user's environment without the variables that change gnuplot's language, number format or terminal.
std::vector<std::string> plain_environment() {
  std::vector<std::string> kept{"LC_ALL=C.UTF-8"};
  for (char** entry = environ; entry != nullptr && *entry != nullptr; ++entry) {
    const std::string_view text(*entry);
    const auto begins = [&](std::string_view name) { return text.starts_with(name); };
    if (!begins("LC_") && !begins("LANG") && !begins("GNUTERM") && !begins("GNUPLOT_") && !begins("GDFONTPATH"))
      kept.emplace_back(text);
  }
  return kept;
}

std::vector<char*> pointers(std::vector<std::string>& texts) {
  std::vector<char*> list;
  list.reserve(texts.size() + 1);
  for (std::string& text : texts) list.push_back(text.data());
  list.push_back(nullptr);
  return list;
}

// Starts gnuplot in its own process group, so that its child processes can be killed with it. Returns 0 or errno.
int start(const Gnuplot& gnuplot, const Files& files, pid_t& child) {
  posix_spawn_file_actions_t actions;
  posix_spawnattr_t attributes;
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawnattr_init(&attributes);
  ::posix_spawn_file_actions_adddup2(&actions, files.script.number(), STDIN_FILENO);
  ::posix_spawn_file_actions_adddup2(&actions, files.picture.number(), STDOUT_FILENO);
  ::posix_spawn_file_actions_adddup2(&actions, files.messages.number(), STDERR_FILENO);
  sigset_t none, all;
  ::sigemptyset(&none);
  ::sigfillset(&all);
  ::posix_spawnattr_setsigmask(&attributes, &none);
  ::posix_spawnattr_setsigdefault(&attributes, &all);
  ::posix_spawnattr_setpgroup(&attributes, 0);
  ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);

  std::vector<std::string> arguments{gnuplot.program, "--default-settings"};
  std::vector<std::string> environment = plain_environment();
  const int code = ::posix_spawnp(&child, gnuplot.program.c_str(), &actions, &attributes, pointers(arguments).data(),
                                  pointers(environment).data());
  ::posix_spawnattr_destroy(&attributes);
  ::posix_spawn_file_actions_destroy(&actions);
  return code;
}

// Returns the last line of gnuplot's messages; the lines before it are parts of the script.
std::string last_message(std::string_view messages) {
  constexpr std::size_t longest = 160;
  constexpr std::string_view blanks = "\r\n\t ";
  const std::size_t end = messages.find_last_not_of(blanks);
  if (end == std::string_view::npos) return "";
  messages = messages.substr(0, end + 1);
  messages.remove_prefix(messages.find_last_of("\r\n") + 1);  // if there is none, npos + 1 is 0
  messages.remove_prefix(messages.find_first_not_of(blanks));
  return printable(shortened(messages, longest));
}

// Waits until gnuplot ends; kills it after the time limit or if its output is too large. Returns why it failed, or nothing.
std::optional<std::string> wait_for(pid_t child, const Gnuplot& gnuplot, const Files& files) {
  const Stopwatch watch;
  const auto end_all = [&] {
    ::kill(-child, SIGKILL);
    while (::waitpid(child, nullptr, 0) < 0 && errno == EINTR) {
    }
  };
  int state = 0;
  for (pid_t ended = 0; ended != child;) {
    ended = ::waitpid(child, &state, WNOHANG);
    if (ended < 0 && errno != EINTR) return std::strerror(errno);
    if (ended == child) break;
    if (watch.seconds() > gnuplot.limit_s) {
      end_all();
      return fmt::format("it did not end within {:g} s", gnuplot.limit_s);
    }
    if (files.picture.size() > largest_output_bytes || files.messages.size() > largest_output_bytes) {
      end_all();
      return "its output is too large";
    }
    std::this_thread::sleep_for(look_again);
  }
  if (WIFSIGNALED(state)) return fmt::format("it was killed by signal {}", WTERMSIG(state));
  if (WEXITSTATUS(state) == 0) return {};
  const std::string said = last_message(files.messages.content());
  return fmt::format("exit status {}{}{}", WEXITSTATUS(state), said.empty() ? "" : ": ", said);
}

// Returns whether the bytes are a whole PNG, with its signature at the beginning (PNG specification, section 5.2) and its last
// chunk at the end (section 11.2.5).
bool is_whole_png(std::string_view bytes) {
  constexpr std::string_view signature("\x89PNG\r\n\x1a\n", 8);
  constexpr std::string_view last_chunk("\0\0\0\0IEND\xae\x42\x60\x82", 12);
  return bytes.size() > signature.size() + last_chunk.size() && bytes.substr(0, signature.size()) == signature &&
         bytes.substr(bytes.size() - last_chunk.size()) == last_chunk;
}

}  // namespace

std::optional<std::string> draw_plot(std::string_view script, const std::filesystem::path& file, const Gnuplot& gnuplot) {
  const std::string name = printable(file.filename().string());
  const auto failed = [&](const std::string& why) { return fmt::format("gnuplot failed: {} is left out ({})", name, why); };
  const Files files;
  if (!files.script.fill(script) || files.picture.number() < 0 || files.messages.number() < 0)
    return failed(std::strerror(errno));
  pid_t child = 0;
  const int code = start(gnuplot, files, child);
  if (code == ENOENT) return fmt::format("gnuplot not found: {} is left out; install gnuplot-nox", name);
  if (code != 0) return failed(std::strerror(code));

  if (const std::optional<std::string> why = wait_for(child, gnuplot, files)) return failed(*why);
  const std::string picture = files.picture.content();
  if (!is_whole_png(picture)) return failed("it wrote no picture");
  write_file(file, picture);
  return {};
}

}  // namespace sunfleck
