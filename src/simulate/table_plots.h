#pragma once
// Draws the plots of the tables in a result folder.

#include "files/results/plots/plots.h"
#include "simulate/unwritten_files.h"

#include <filesystem>
#include <string>

namespace sunfleck {

// Draws plots until gnuplot fails; reports that failure and tries no further plots.
class TablePlots {
 public:
  TablePlots(const std::filesystem::path& folder, UnwrittenFiles& unwritten) : folder_(folder), unwritten_(unwritten) {}

  // Draws `file` in the folder with a script such as "profile.gp".
  void draw(const char* script, const PlotVariables& variables, const std::string& file);

 private:
  const std::filesystem::path& folder_;
  UnwrittenFiles& unwritten_;
  bool given_up_ = false;
};

}  // namespace sunfleck
