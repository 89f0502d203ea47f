#include "files/results/tables/table_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <iterator>

namespace sunfleck {
namespace {

void append_value(std::string& row, double value) {
  if (!std::isnan(value)) fmt::format_to(std::back_inserter(row), "{:.9g}", value);
}

// Returns the text, quoted as in RFC 4180 if it holds a comma, a quote, a line break or the '#' of comments.
std::string csv_field(std::string_view text) {
  if (text.find_first_of(",\"\r\n#") == std::string_view::npos) return std::string(text);
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

struct AppendCell {
  std::string& row;
  const Column& column;
  std::size_t i;  // index of the value

  void operator()(const RowNumbers&) const { fmt::format_to(std::back_inserter(row), "{}", i); }
  void operator()(std::span<const double> numbers) const { append_value(row, numbers[i]); }
  void operator()(std::span<const std::string> texts) const { row += csv_field(texts[i]); }
  void operator()(const auto& numbers) const {
    if (!column.categories) {
      fmt::format_to(std::back_inserter(row), "{}", numbers[i]);
    } else {
      row += csv_field((*column.categories)[static_cast<std::size_t>(numbers[i])]);
    }
  }
};

std::vector<const Column*> csv_columns(const Table& table) {
  std::vector<const Column*> columns;
  for (const Column& column : table.columns) {
    if (column.is_in(in_csv)) columns.push_back(&column);
  }
  return columns;
}

}  // namespace

std::string table_head(const RunRecord& record, std::string_view content, std::string_view units) {
  std::string title = record.title;
  for (char& c : title) c = c == '\n' || c == '\r' ? ' ' : c;
  return fmt::format("# {}\n# {}\n{}# seed {}, confidence {}\n# {}\n", title, content,
                     record.complete ? "" : "# incomplete: the run stopped before its work was done\n", record.seed,
                     record.accuracy.confidence, units);
}

void append_number(std::string& row, double value) {
  row += ',';
  append_value(row, value);
}

std::string csv_text(const RunRecord& record, const Table& table) {
  return csv_head(record, table) + csv_rows(table);
}

std::string csv_head(const RunRecord& record, const Table& table) {
  std::string text = table_head(record, table.content, table.units);
  for (const std::string& note : table.notes) text += "# " + note + '\n';
  std::vector<std::string_view> names;
  for (const Column* column : csv_columns(table)) names.push_back(column->name);
  return text + fmt::format("{}\n", fmt::join(names, ","));
}

std::string csv_rows(const Table& table) {
  std::string text;
  const std::vector<const Column*> columns = csv_columns(table);
  const std::size_t rows = table.rows();
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t c = 0; c < columns.size(); ++c) {
      if (c > 0) text += ',';
      std::visit(AppendCell{text, *columns[c], table.value_in_row(*columns[c], row)}, columns[c]->values);
    }
    text += '\n';
  }
  return text;
}

}  // namespace sunfleck
