#include "base/text_reader.h"

#include "base/error.h"
#include "base/file.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <clocale>
#include <cmath>
#include <string>
#include <system_error>

namespace sunfleck {

namespace {

constexpr std::string_view blanks = " \t\f\v";

// Returns 0 for a number too small for a double and infinity for one too large, which from_chars leaves open; in any locale.
double limit_of(const std::string& word) {
  static const locale_t plain = ::newlocale(LC_ALL_MASK, "C", nullptr);
  return ::strtod_l(word.c_str(), nullptr, plain);
}

// Returns where the first cell of a line ends; npos for the last one. Two quotes within quotes stand for one.
std::size_t end_of_cell(std::string_view line, char separator) {
  const std::size_t end = line.find(separator), open = line.substr(0, end).find_first_not_of(blanks);
  if (open == line.npos || line[open] != '"') return end;
  std::size_t close = line.find('"', open + 1);
  while (close != line.npos && line.substr(close + 1).starts_with('"')) close = line.find('"', close + 2);
  return close == line.npos ? end : line.find(separator, close);
}

}  // namespace

void refuse_line(const std::filesystem::path& file, std::size_t line, std::string_view what, std::string_view why,
                 std::string_view cure) {
  const std::string place = line == 0 ? file.string() : fmt::format("{}:{}", file.string(), line);
  throw_input(printable(fmt::format("{}: {}", place, what)), printable(why), cure);
}

std::string in_quotes(std::string_view text) {
  constexpr std::size_t longest = 40;
  return fmt::format("'{}'", printable(shortened(text, longest)));
}

bool LineReader::next() {
  if (rest_.empty()) return false;
  const std::size_t end = rest_.find_first_of("\r\n");
  line_ = rest_.substr(0, end);
  if (end == rest_.npos)
    rest_ = {};
  else
    rest_.remove_prefix(rest_.substr(end).starts_with("\r\n") ? end + 2 : end + 1);
  ++number_;
  return true;
}

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == text.npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

std::string_view next_word(std::string_view& rest) {
  std::size_t first = 0;
  while (first < rest.size() && blanks.find(rest[first]) != blanks.npos) ++first;
  std::size_t last = first;
  while (last < rest.size() && blanks.find(rest[last]) == blanks.npos) ++last;
  const std::string_view word = rest.substr(first, last - first);
  rest.remove_prefix(last);
  return word;
}

std::string_view unquoted(std::string_view cell) {
  cell = trimmed(cell);
  return cell.size() >= 2 && cell.front() == '"' && cell.back() == '"' ? trimmed(cell.substr(1, cell.size() - 2)) : cell;
}

void split_cells(std::string_view line, std::vector<std::string_view>& cells, char separator) {
  cells.clear();
  while (true) {
    const std::size_t end = end_of_cell(line, separator);
    cells.push_back(unquoted(line.substr(0, end)));
    if (end == line.npos) return;
    line.remove_prefix(end + 1);
  }
}

char separator_of(std::string_view first_line) {
  for (const char separator : {';', '\t'}) {
    if (first_line.find(separator) != first_line.npos) return separator;
  }
  return ',';
}

std::string_view name_of_separator(char separator) {
  return separator == ';' ? "semicolons" : separator == '\t' ? "tabs" : "commas";
}

std::optional<double> parse_number(std::string_view word) {
  if (word.starts_with('+') && !word.starts_with("+-")) word.remove_prefix(1);
  double value = 0.0;
  const auto [end, code] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (end != word.data() + word.size() || word.empty() || code == std::errc::invalid_argument) return std::nullopt;
  if (code == std::errc::result_out_of_range) value = limit_of(std::string(word));
  if (!std::isfinite(value)) return std::nullopt;
  return value;
}

std::optional<double> parse_number(std::string_view cell, char separator) {
  if (separator == ',' || cell.find(',') == cell.npos) return parse_number(cell);
  std::string with_point(cell);
  std::replace(with_point.begin(), with_point.end(), ',', '.');
  return parse_number(with_point);
}

std::optional<std::int64_t> parse_integer(std::string_view word) {
  if (word.starts_with('+') && !word.starts_with("+-")) word.remove_prefix(1);
  std::int64_t value = 0;
  const auto [end, code] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (end != word.data() + word.size() || word.empty() || code != std::errc()) return std::nullopt;
  return value;
}

}  // namespace sunfleck
