#include "simulate/table_plots.h"

#include "base/log.h"

#include <optional>

namespace sunfleck {

void TablePlots::draw(const char* script, const PlotVariables& variables, const std::string& file) {
  if (given_up_) return;
  std::optional<std::string> problem;
  unwritten_.attempt(file, [&] { problem = draw_table(script, variables, folder_ / file); });
  if (problem) warn(*problem);
  given_up_ = problem.has_value();
}

}  // namespace sunfleck
