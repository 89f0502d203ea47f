#include "io/table_text.h"

#include <fmt/format.h>

#include <cmath>
#include <iterator>

namespace sunfleck {

std::string table_head(const RunRecord& record, std::string_view content, std::string_view units) {
  std::string title = record.title;
  for (char& c : title) c = c == '\n' || c == '\r' ? ' ' : c;
  return fmt::format("# {}\n# {}\n{}# seed {}, confidence {}\n# {}\n", title, content,
                     record.complete ? "" : "# incomplete: the run stopped before its work was done\n", record.seed,
                     record.accuracy.confidence, units);
}

void append_number(std::string& row, double value) {
  row += ',';
  if (!std::isnan(value)) fmt::format_to(std::back_inserter(row), "{:.9g}", value);
}

void append_estimate(std::string& row, const Estimate& estimate) {
  append_number(row, estimate.value);
  append_number(row, estimate.half_width);
}

Estimate as_share(Estimate estimate) {
  if (estimate.value > 1.0) estimate.value = 1.0;
  return estimate;
}

std::string csv_field(std::string_view text) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(text);
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

}  // namespace sunfleck
