#pragma once
// CSV tables of numbers, as people and other programs hand them in.

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sunfleck {

struct NumberTable {
  struct Row {
    std::size_t line = 0;
    std::vector<double> cells;  // [column], NaN where the cell is empty
  };
  std::filesystem::path file;
  std::vector<std::string> comments;  // the `#` lines, without that
  std::size_t header_line = 0;
  std::vector<std::string> columns;  // no name twice
  std::vector<Row> rows;             // at least one, each with a cell a column

  // Throws Error (input) if it is not there.
  [[nodiscard]] std::size_t column(std::string_view name) const;
  [[nodiscard]] std::optional<std::size_t> find_column(std::string_view name) const;
};

using HeaderCheck = std::function<void(const NumberTable&)>;

// A comma between cells, a line of column names first; `#` lines and blank ones may stand anywhere, cells in double quotes.
// Throws Error (input), one line `FILE:LINE: ...`, for what is no such table, numbers that are not finite, and files of more
// than 10 MB. `check_header` is called when the columns are known and no row is.
[[nodiscard]] NumberTable read_number_table(const std::filesystem::path& file, const HeaderCheck& check_header = {});

// Throws Error (input) about that line of the file; line 0: about the file as a whole.
[[noreturn]] void refuse_table(const NumberTable& table, std::size_t line, std::string_view what, std::string_view why,
                               std::string_view cure);

}  // namespace sunfleck
