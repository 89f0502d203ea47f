#include "files/formats/mesh/mesh_source.h"

#include "base/text_reader.h"

#include <fmt/format.h>

namespace sunfleck {

void refuse(const MeshSource& source, std::size_t line, std::string_view what, std::string_view why, std::string_view cure) {
  refuse_line(source.file, line, what, why, cure);
}

double coordinate(const MeshSource& source, std::size_t line, std::string_view& rest) {
  const std::string_view word = next_word(rest);
  if (word.empty()) refuse(source, line, "a coordinate is missing", "the line is too short", "export the file again");
  const std::optional<double> value = parse_number(word);
  if (!value) refuse(source, line, fmt::format("coordinate {}", in_quotes(word)), "not a finite number", "correct the number");
  return *value;
}

}  // namespace sunfleck
