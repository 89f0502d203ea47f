#include "files/formats/caribu/caribu_lines.h"

#include "base/file.h"

#include <fmt/format.h>

#include <optional>

namespace sunfleck {

CaribuLines::CaribuLines(const std::filesystem::path& file, std::string_view bytes)
    : file_(file), lines_(without_mark(bytes)) {}

bool CaribuLines::next() {
  while (lines_.next()) {
    rest_ = trimmed(lines_.line().substr(0, lines_.line().find('#')));
    if (!rest_.empty()) return true;
  }
  return false;
}

double CaribuLines::number(std::string_view what, std::string_view form, std::string_view too_short) {
  const std::string_view text = word();
  if (text.empty()) refuse_here(fmt::format("{} is missing", what), too_short, form);
  const std::optional<double> value = parse_number(text);
  if (!value) refuse_here(fmt::format("{} = {}", what, in_quotes(text)), "must be a finite number", form);
  return *value;
}

void CaribuLines::end_of_line(std::string_view form) {
  if (const std::string_view more = word(); !more.empty())
    refuse_here(fmt::format("{} at the end of the line", in_quotes(more)), "the line should end here", form);
}

void CaribuLines::refuse_here(std::string_view what, std::string_view why, std::string_view cure) const {
  refuse_line(file_, lines_.number(), what, why, cure);
}

void CaribuLines::refuse_file(std::string_view what, std::string_view why, std::string_view cure) const {
  refuse_line(file_, 0, what, why, cure);
}

}  // namespace sunfleck
