#pragma once
// What the result tables have in common as text.

#include "io/result_writer.h"

#include <string>
#include <string_view>

namespace sunfleck {

// The `#` lines: title, content, seed and confidence, units.
[[nodiscard]] std::string table_head(const RunRecord& record, std::string_view content, std::string_view units);

// A comma and nine significant digits; the cell stays empty for NaN.
void append_number(std::string& row, double value);

// Value and half-width.
void append_estimate(std::string& row, const Estimate& estimate);

// A share as it is told to users: its estimate, which has no bias, may exceed 1 by chance, the share itself cannot.
[[nodiscard]] Estimate as_share(Estimate estimate);

// Quoted as RFC 4180 has it if the text holds a comma, a quote or a line break.
[[nodiscard]] std::string csv_field(std::string_view text);

}  // namespace sunfleck
