#include "files/formats/measured/number_table.h"

#include "base/file.h"
#include "base/text_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <utility>

namespace sunfleck {
namespace {

constexpr std::uintmax_t most_bytes = 10'000'000;
constexpr std::size_t most_columns = 1000;

void take_header(NumberTable& table, std::size_t line, const std::vector<std::string_view>& names) {
  table.header_line = line;
  if (names.size() > most_columns)
    refuse_line(table.file, line, fmt::format("{} columns", names.size()),
                fmt::format("a table may have at most {}", most_columns), "remove the columns that are not needed");
  for (const std::string_view name : names) {
    if (name.empty()) refuse_line(table.file, line, "a column without a name", "the header must name every column", "name it");
    if (table.find_column(name))
      refuse_line(table.file, line, fmt::format("column {} twice", in_quotes(name)), "column names must differ", "rename one");
    table.columns.emplace_back(name);
  }
}

void take_row(NumberTable& table, std::size_t line, const std::vector<std::string_view>& cells, char separator) {
  if (cells.size() != table.columns.size()) {
    refuse_line(table.file, line, fmt::format("{} cells", cells.size()),
                fmt::format("the header in line {} has {} columns", table.header_line, table.columns.size()),
                fmt::format("give one cell per column, separated by {}{}", name_of_separator(separator),
                            separator == ',' ? ", with a decimal point in numbers" : ""));
  }
  NumberTable::Row row{line, {}};
  for (std::size_t c = 0; c < cells.size(); ++c) {
    const std::optional<double> value =
        cells[c].empty() ? std::numeric_limits<double>::quiet_NaN() : parse_number(cells[c], separator);
    if (!value) {
      refuse_line(table.file, line, fmt::format("{} = {}", table.columns[c], in_quotes(cells[c])), "not a finite number",
                  "correct the number");
    }
    row.cells.push_back(*value);
  }
  table.rows.push_back(std::move(row));
}

}  // namespace

std::optional<std::size_t> NumberTable::find_column(std::string_view name) const {
  const auto found = std::find(columns.begin(), columns.end(), name);
  if (found == columns.end()) return {};
  return static_cast<std::size_t>(found - columns.begin());
}

std::size_t NumberTable::column(std::string_view name) const {
  const std::optional<std::size_t> found = find_column(name);
  if (!found) {
    refuse_line(file, header_line, fmt::format("no column {}", name), "it is required",
                "use a file as written by this program");
  }
  return *found;
}

NumberTable read_number_table(const std::filesystem::path& file, const HeaderCheck& check_header, SourceFiles* files) {
  NumberTable table;
  table.file = file;
  const std::string bytes = read_source(file, files, most_bytes);
  std::vector<std::string_view> cells;
  char separator = ',';
  for (LineReader lines(without_mark(bytes)); lines.next();) {
    const std::string_view line = trimmed(lines.line());
    if (line.empty()) continue;
    if (line.front() == '#') {
      table.comments.emplace_back(trimmed(line.substr(1)));
      continue;
    }
    if (table.columns.empty()) separator = separator_of(line);
    split_cells(line, cells, separator);
    if (table.columns.empty()) {
      take_header(table, lines.number(), cells);
      if (check_header) check_header(table);
    } else {
      take_row(table, lines.number(), cells, separator);
    }
  }
  if (table.columns.empty())
    refuse_line(table.file, 0, "only blank lines and comments", "a line of column names must come first", "check the file");
  if (table.rows.empty())
    refuse_line(table.file, table.header_line, "no rows below the header", "at least one is required", "check the file");
  return table;
}

}  // namespace sunfleck
