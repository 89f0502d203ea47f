#pragma once
// Text functions shared by the result tables.

#include "io/result_writer.h"

#include <string>
#include <string_view>

namespace sunfleck {

// Returns the `#` lines: title, content, seed and confidence, units.
[[nodiscard]] std::string table_head(const RunRecord& record, std::string_view content, std::string_view units);

// Appends a comma and nine significant digits; the cell stays empty for NaN.
void append_number(std::string& row, double value);

// Appends the value and its half-width.
void append_estimate(std::string& row, const Estimate& estimate);

// Limits a share to 1 for reporting: the estimate is unbiased and may exceed 1 by chance, although the share cannot.
[[nodiscard]] Estimate as_share(Estimate estimate);

// Returns the text, quoted as in RFC 4180 if it holds a comma, a quote or a line break.
[[nodiscard]] std::string csv_field(std::string_view text);

}  // namespace sunfleck
