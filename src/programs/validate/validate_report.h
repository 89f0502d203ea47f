#pragma once
// The table of known answers: for people, as Markdown and as JSON.

#include "physics/transport/model/tracer.h"
#include "programs/validate/known_cases.h"

#include <span>
#include <string>

namespace sunfleck {

// Where and how the table was made.
struct ValidationRecord {
  std::string version;
  std::string commit;
  TracerDevice device;
  bool complete = true;  // false: stopped before all groups were done
  double seconds = 0.0;
};

// Return the table for people: one line of it, its heading, and its last line with the numbers of passed and failed cases.
[[nodiscard]] std::string answer_line(const JudgedAnswer& judged);
[[nodiscard]] std::string answer_heading();
[[nodiscard]] std::string answer_summary(const ValidationRecord& record, std::span<const JudgedAnswer> answers);

[[nodiscard]] std::size_t count_failed(std::span<const JudgedAnswer> answers);

// Return the contents of validate.md and validate.json. For a case that ended with an error the numbers are left out, or null.
[[nodiscard]] std::string validation_markdown(const ValidationRecord& record, std::span<const JudgedAnswer> answers);
[[nodiscard]] std::string validation_json(const ValidationRecord& record, std::span<const JudgedAnswer> answers);

}  // namespace sunfleck
