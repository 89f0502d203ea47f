#include "simulate/unwritten_files.h"

#include <fmt/format.h>

namespace sunfleck {

void UnwrittenFiles::throw_if_any(const std::string& cure) const {
  if (names_.empty()) return;
  std::string line = first_ + cure;
  if (const std::size_t more = names_.size() - 1; more > 0) line += fmt::format("; {} more could not be written", more);
  throw Error(ErrorKind::failure, line);
}

void UnwrittenFiles::note(const std::string& name, const std::string& why) {
  if (names_.empty()) first_ = why;
  names_.push_back(name);
}

}  // namespace sunfleck
