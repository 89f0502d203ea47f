#include "support/table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <sstream>

namespace sunfleck::regression {

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '"' && quoted && i + 1 < line.size() && line[i + 1] == '"') {
      cells.back() += line[++i];
    } else if (line[i] == '"') {
      quoted = !quoted;
    } else if (line[i] == ',' && !quoted) {
      cells.emplace_back();
    } else {
      cells.back() += line[i];
    }
  }
  return cells;
}

Table::Table(const std::string& text) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind('#', 0) == 0) {
      EXPECT_TRUE(columns_.empty()) << "a comment below the columns: " << line;
      comments_.push_back(line);
    } else if (columns_.empty()) {
      header_ = line;
      columns_ = cells_of(line);
    } else {
      rows_.push_back(cells_of(line));
      EXPECT_EQ(rows_.back().size(), columns_.size()) << line;
    }
  }
  EXPECT_TRUE(!text.empty() && text.back() == '\n');
}

const std::string& Table::cell(std::size_t row, const std::string& column) const {
  const auto found = std::find(columns_.begin(), columns_.end(), column);
  static const std::string missing = "no such column";
  return found == columns_.end() ? missing : rows_.at(row).at(static_cast<std::size_t>(found - columns_.begin()));
}

double Table::number(std::size_t row, const std::string& column) const {
  const std::string& text = cell(row, column);
  if (text.empty()) return std::numeric_limits<double>::quiet_NaN();
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  EXPECT_TRUE(*end == '\0' && std::isfinite(value)) << column << ", row " << row << ": " << text;
  return value;
}

}  // namespace sunfleck::regression
