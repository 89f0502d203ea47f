#pragma once
// Reads the lines of the small files that accompany a CARIBU .can file.

#include "base/text_reader.h"

#include <filesystem>
#include <string_view>

namespace sunfleck {

// Iterates over the lines that are neither blank nor comments, and over their words.
class CaribuLines {
 public:
  // Both arguments must outlive the lines. Skips a byte order mark.
  CaribuLines(const std::filesystem::path& file, std::string_view bytes);

  bool next();  // returns false at the end
  [[nodiscard]] bool has_more() const { return !trimmed(rest_).empty(); }
  std::string_view word() { return next_word(rest_); }

  // Removes the next word and returns it as a finite number. `what` names the number, `form` is the advice, and `too_short` the
  // reason why the number must not be missing.
  double number(std::string_view what, std::string_view form, std::string_view too_short = "the line is too short");

  void end_of_line(std::string_view form);

  // Throws Error (input) about the current line, or about the whole file.
  [[noreturn]] void refuse_here(std::string_view what, std::string_view why, std::string_view cure) const;
  [[noreturn]] void refuse_file(std::string_view what, std::string_view why, std::string_view cure) const;

 private:
  const std::filesystem::path& file_;
  LineReader lines_;
  std::string_view rest_;
};

}  // namespace sunfleck
