#pragma once
// Reads text files that people or other programs wrote: their lines, words, cells and numbers, and messages about them.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sunfleck {

// Throws Error (input) `FILE:LINE: what (why); cure`. Line 0 leaves the line out.
[[noreturn]] void refuse_line(const std::filesystem::path& file, std::size_t line, std::string_view what, std::string_view why,
                              std::string_view cure);

// Returns a piece of the file for a message: in quotes, on one line, cut after 40 bytes.
[[nodiscard]] std::string in_quotes(std::string_view text);

// Iterates over lines ended by \n, \r\n or \r, numbered from 1.
class LineReader {
 public:
  explicit LineReader(std::string_view text) : rest_(text) {}
  bool next();  // returns false at the end
  [[nodiscard]] std::string_view line() const { return line_; }
  [[nodiscard]] std::size_t number() const { return number_; }
  [[nodiscard]] std::string_view rest() const { return rest_; }

 private:
  std::string_view rest_, line_;
  std::size_t number_ = 0;
};

// Removes the next blank-separated word from `rest` and returns it; empty at the end.
[[nodiscard]] std::string_view next_word(std::string_view& rest);
[[nodiscard]] std::string_view trimmed(std::string_view text);

// Returns the cell of a table trimmed and without enclosing double quotes.
[[nodiscard]] std::string_view unquoted(std::string_view cell);

// Splits a line of a table at its separators into `cells`, each unquoted. A cell in double quotes keeps the separators in it; a
// quote that nothing closes is a character like any other. The views point into `line`.
void split_cells(std::string_view line, std::vector<std::string_view>& cells, char separator = ',');

// Returns what separates the cells of a table: semicolons or tabs if its first line has any, or else commas.
[[nodiscard]] char separator_of(std::string_view first_line);
// Returns its name in the plural, for messages.
[[nodiscard]] std::string_view name_of_separator(char separator);

// Parse a finite number or an integer; return nothing unless the whole word is one.
[[nodiscard]] std::optional<double> parse_number(std::string_view word);
[[nodiscard]] std::optional<std::int64_t> parse_integer(std::string_view word);

// Parses the number in a cell of a table. Unless commas separate its cells, a comma may be the decimal mark.
[[nodiscard]] std::optional<double> parse_number(std::string_view cell, char separator);

}  // namespace sunfleck
