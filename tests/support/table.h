#pragma once
// Reads a result table as a script would.

#include <cstddef>
#include <string>
#include <vector>

namespace sunfleck::regression {

// Splits a line into its cells; a quoted cell keeps its commas, and a doubled quote in it stands for one.
[[nodiscard]] std::vector<std::string> cells_of(const std::string& line);

class Table {
 public:
  // Fails the test where a row has other columns than the header, or a comment stands below it.
  explicit Table(const std::string& text);

  [[nodiscard]] const std::vector<std::string>& comments() const { return comments_; }
  [[nodiscard]] const std::string& header() const { return header_; }
  [[nodiscard]] const std::vector<std::string>& columns() const { return columns_; }
  [[nodiscard]] std::size_t size() const { return rows_.size(); }
  [[nodiscard]] const std::string& cell(std::size_t row, const std::string& column) const;
  // Returns the number, or NaN for an empty cell; text that is not a number fails the test.
  [[nodiscard]] double number(std::size_t row, const std::string& column) const;

 private:
  std::vector<std::string> comments_, columns_;
  std::string header_;
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace sunfleck::regression
