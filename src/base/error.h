#pragma once
// The exception of all messages for users, and the three parts that each has:
//   WHERE AND WHAT (WHY IT IS WRONG); WHAT TO DO
// e.g.  maize.toml:14: optics.leaf.reflectance.PAR = 12 (must lie in 0..1); give 0.12 if percent was meant

#include <stdexcept>
#include <string>
#include <string_view>

namespace sunfleck {

// The values are the exit statuses of the program.
enum class ErrorKind { failure = 1, input = 2, device = 3 };

class Error : public std::runtime_error {
 public:
  Error(ErrorKind kind, const std::string& message) : std::runtime_error(message), kind_(kind) {}
  [[nodiscard]] ErrorKind kind() const { return kind_; }

 private:
  ErrorKind kind_;
};

// Bad input: a file does not exist.
class MissingFile : public Error {
 public:
  explicit MissingFile(const std::string& message) : Error(ErrorKind::input, message) {}
};

[[nodiscard]] inline std::string three_part_message(std::string_view what, std::string_view why, std::string_view cure) {
  std::string message(what);
  message.append(" (").append(why).append("); ").append(cure);
  return message;
}

// Throws for bad usage or bad input: `what` names the file, line or key and the value found, `why` the rule it breaks,
// `cure` what would be right. Each of the three is one line.
[[noreturn]] inline void throw_input(std::string_view what, std::string_view why, std::string_view cure) {
  throw Error(ErrorKind::input, three_part_message(what, why, cure));
}

// Throws for a run that could not be finished (full disk, lost device, a ledger that does not close).
[[noreturn]] inline void throw_failure(std::string_view what, std::string_view why, std::string_view cure) {
  throw Error(ErrorKind::failure, three_part_message(what, why, cure));
}

// Throws if there is no device of the requested kind, or if it lacks something that the program relies on.
[[noreturn]] inline void throw_device(std::string_view what, std::string_view why, std::string_view cure) {
  throw Error(ErrorKind::device, three_part_message(what, why, cure));
}

}  // namespace sunfleck
