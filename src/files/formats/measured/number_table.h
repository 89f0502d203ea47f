#pragma once
// Reads CSV tables of numbers written by people or by other programs.

#include "base/source_files.h"

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
  std::vector<std::string> comments;  // the `#` lines without the `#`
  std::size_t header_line = 0;
  std::vector<std::string> columns;  // distinct names
  std::vector<Row> rows;             // at least one, each with one cell per column

  // Returns the index of a column. Throws Error (input) if there is none of that name.
  [[nodiscard]] std::size_t column(std::string_view name) const;
  [[nodiscard]] std::optional<std::size_t> find_column(std::string_view name) const;
};

using HeaderCheck = std::function<void(const NumberTable&)>;

// Reads a table that begins with a line of column names. Commas separate its cells, or semicolons or tabs if that line has any;
// a comma may then be the decimal mark. `#` lines and blank lines may occur anywhere, cells may be in double quotes. Throws
// Error (input), one line `FILE:LINE: ...`, for malformed tables, numbers that are not finite, and files of more than 10 MB.
// Calls `check_header` once the columns are known, before any row is read. Adds the file to `files` if that is given.
[[nodiscard]] NumberTable read_number_table(const std::filesystem::path& file, const HeaderCheck& check_header = {},
                                            SourceFiles* files = nullptr);

}  // namespace sunfleck
