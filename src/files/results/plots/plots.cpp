#include "files/results/plots/plots.h"

#include "base/file.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <iterator>

namespace sunfleck {
namespace {

namespace fs = std::filesystem;

bool is_harmless(char c) {
  constexpr std::string_view signs = " .,:/_-";
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || signs.find(c) != std::string_view::npos;
}

std::string number_text(double number) {
  return std::isfinite(number) ? fmt::format("{:.9g}", number) : "NaN";
}

// Returns the scripts' folder beside the Python module or below the program's prefix, depending on which of them runs this code.
fs::path installed_folder() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  Dl_info object{};
  // A program's name is the one it was called by, perhaps relative; a module's name is absolute.
  if (::dladdr(reinterpret_cast<const void*>(&plot_folder), &object) != 0 && object.dli_fname != nullptr) {
    const fs::path file = object.dli_fname;
    if (file.is_absolute() && !fs::equivalent(file, program, error)) return file.parent_path() / "plots";
  }
  return program.parent_path().parent_path() / "share" / "sunfleck" / "plots";
}

}  // namespace

std::string gnuplot_text(std::string_view text) {
  std::string constant = "\"";
  bool octal = false;  // the last one is an octal number, which extends in gnuplot as far as digits follow
  for (const char c : text) {
    if (c == '\0') continue;
    octal = !is_harmless(c) || (octal && c >= '0' && c <= '9');
    if (octal) {
      fmt::format_to(std::back_inserter(constant), "\\{:03o}", static_cast<unsigned char>(c));
    } else {
      constant += c;
    }
  }
  return constant + '"';
}

void PlotVariables::set(std::string_view name, double number) {
  commands_ += fmt::format("{} = {}\n", name, number_text(number));
}

void PlotVariables::set_text(std::string_view name, std::string_view text) {
  commands_ += fmt::format("{} = {}\n", name, gnuplot_text(printable(text)));
}

void PlotVariables::set_texts(std::string_view name, std::span<const std::string> texts) {
  commands_ += fmt::format("array {}[{}]\n", name, texts.size());
  for (std::size_t i = 0; i < texts.size(); ++i) set_text(fmt::format("{}[{}]", name, i + 1), texts[i]);
}

void PlotVariables::set_file(std::string_view name, const fs::path& file) {
  commands_ += fmt::format("{} = {}\n", name, gnuplot_text(fs::absolute(file).string()));
}

void PlotVariables::set_files(std::string_view name, std::span<const fs::path> files) {
  commands_ += fmt::format("array {}[{}]\n", name, files.size());
  for (std::size_t i = 0; i < files.size(); ++i) set_file(fmt::format("{}[{}]", name, i + 1), files[i]);
}

void PlotVariables::set_table(std::string_view name, std::string_view columns, std::span<const std::vector<double>> rows) {
  commands_ += fmt::format("${} << EOD\n{}\n", name, columns);
  for (const std::vector<double>& row : rows) {
    for (const double number : row) commands_ += number_text(number) + ',';
    commands_.back() = '\n';
  }
  commands_ += "EOD\n";
}

fs::path plot_folder() {
  const char* named = std::getenv("SUNFLECK_PLOTS");
  if (named != nullptr && *named != '\0') return named;
  fs::path installed = installed_folder();
  std::error_code error;
  return fs::is_directory(installed, error) ? installed : fs::path(SUNFLECK_SOURCE_PLOTS);
}

std::optional<std::string> draw_table(std::string_view script, const PlotVariables& variables, const fs::path& picture,
                                      const Gnuplot& gnuplot) {
  const fs::path file = fs::absolute(plot_folder() / script);
  std::error_code error;
  if (!fs::is_regular_file(file, error)) {
    return fmt::format("{} is left out: {} is missing; install sunfleck again, or correct SUNFLECK_PLOTS",
                       printable(picture.filename().string()), printable(file.string()));
  }
  return draw_plot(fmt::format("set encoding utf8\n{}load {}\n", variables.commands(), gnuplot_text(file.string())), picture,
                   gnuplot);
}

}  // namespace sunfleck
