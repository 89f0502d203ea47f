#pragma once
// Text functions shared by the result tables.

#include "files/results/tables/result_writer.h"
#include "files/results/tables/table.h"

#include <string>
#include <string_view>

namespace sunfleck {

// Returns the `#` lines: title, content, seed and confidence, units.
[[nodiscard]] std::string table_head(const RunRecord& record, std::string_view content, std::string_view units);

// Appends a comma and the number with nine significant digits; leaves the cell empty for NaN.
void append_number(std::string& row, double value);

// Returns a table as CSV below its `#` lines. Numbers have nine significant digits.
[[nodiscard]] std::string csv_text(const RunRecord& record, const Table& table);
// Return its two parts: the `#` lines with the line of column names, and the rows. The rows of further tables of the same columns
// may follow.
[[nodiscard]] std::string csv_head(const RunRecord& record, const Table& table);
[[nodiscard]] std::string csv_rows(const Table& table);

}  // namespace sunfleck
