#include "programs/validate/validate_report.h"

#include "files/results/tables/summary_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

namespace sunfleck {
namespace {

struct Cells {
  std::string expected, got, standard_error, z;
  const char* verdict;
};

Cells cells_of(const JudgedAnswer& judged) {
  const KnownAnswer& answer = judged.answer;
  Cells shown{"", "", "", "", judged.passed ? "pass" : "fail"};
  if (!answer.trouble.empty()) return shown;
  shown.expected = fmt::format("{:.8g}", answer.expected);
  shown.got = fmt::format("{:.8g}", answer.got);
  shown.standard_error = fmt::format("{:.1e}", answer.standard_error);
  if (answer.standard_error == 0.0) shown.standard_error = "0";
  if (const auto z = answer.z()) shown.z = fmt::format("{:+.2f}", *z);
  return shown;
}

// Returns what a reader needs to know about a failed case besides its numbers.
std::string remark(const JudgedAnswer& judged) {
  const KnownAnswer& answer = judged.answer;
  if (judged.passed) return {};
  if (!answer.trouble.empty()) return answer.trouble;
  if (answer.is_estimate() && !(answer.standard_error <= answer.largest_error)) {
    return fmt::format("standard error above {:.1e}: too wide to be a test", answer.largest_error);
  }
  return {};
}

std::string escaped(std::string text) {
  for (std::size_t at = text.find('|'); at != std::string::npos; at = text.find('|', at + 2)) text.insert(at, 1, '\\');
  return text;
}

}  // namespace

std::size_t count_failed(std::span<const JudgedAnswer> answers) {
  return static_cast<std::size_t>(
      std::count_if(answers.begin(), answers.end(), [](const JudgedAnswer& judged) { return !judged.passed; }));
}

std::string answer_heading() {
  return fmt::format("{:<80} {:>13} {:>13} {:>8} {:>7}  {}", "case", "expected", "got", "error", "z", "verdict");
}

std::string answer_line(const JudgedAnswer& judged) {
  const Cells cells = cells_of(judged);
  const std::string more = remark(judged);
  return fmt::format("{:<80} {:>13} {:>13} {:>8} {:>7}  {}{}", judged.answer.name, cells.expected, cells.got,
                     cells.standard_error, cells.z, judged.passed ? "pass" : "FAIL", more.empty() ? "" : ": " + more);
}

std::string answer_summary(const ValidationRecord& record, std::span<const JudgedAnswer> answers) {
  const std::size_t failed = count_failed(answers);
  std::string line =
      fmt::format("{} of {} known answers right on {}", answers.size() - failed, answers.size(), record.device.name);
  if (failed > 0) line += fmt::format(", {} WRONG: do not trust results of this device and build", failed);
  if (!record.complete) line += "; interrupted before all cases were run";
  return line;
}

std::string validation_markdown(const ValidationRecord& record, std::span<const JudgedAnswer> answers) {
  std::string text = fmt::format("# Known answers\n\nsunfleck {} ({}), {}{}, {:.0f} s. {}.\n\n", record.version, record.commit,
                                 record.device.name, record.device.driver.empty() ? "" : ", " + record.device.driver,
                                 record.seconds, answer_summary(record, answers));
  text +=
      "An estimate passes within Student's t for the whole table at 0.1 % (Sidak), counted in standard errors: z says how many "
      "it is off. A value without error must be equal, to the last digit its source gives.\n\n"
      "| case | expected | got | standard_error | z | verdict |\n| --- | ---: | ---: | ---: | ---: | --- |\n";
  for (const JudgedAnswer& judged : answers) {
    const Cells cells = cells_of(judged);
    const std::string more = remark(judged);
    text +=
        fmt::format("| {} | {} | {} | {} | {} | {} |\n", escaped(judged.answer.name + (more.empty() ? "" : " (" + more + ")")),
                    cells.expected, cells.got, cells.standard_error, cells.z, cells.verdict);
  }
  return text;
}

std::string validation_json(const ValidationRecord& record, std::span<const JudgedAnswer> answers) {
  nlohmann::ordered_json json;
  json["sunfleck"] = record.version;
  json["commit"] = record.commit;
  json["complete"] = record.complete;
  json["device"] = {{"kind", record.device.kind}, {"name", record.device.name}, {"driver", record.device.driver}};
  json["seconds"] = record.seconds;
  json["passed"] = answers.size() - count_failed(answers);
  json["failed"] = count_failed(answers);
  json["cases"] = nlohmann::ordered_json::array();
  for (const JudgedAnswer& judged : answers) {
    const KnownAnswer& answer = judged.answer;
    nlohmann::ordered_json row;
    row["case"] = answer.name;
    const bool has_answer = answer.trouble.empty();
    row["expected"] = has_answer ? number_or_null(answer.expected) : nullptr;
    row["got"] = has_answer ? number_or_null(answer.got) : nullptr;
    row["standard_error"] = has_answer ? number_or_null(answer.standard_error) : nullptr;
    const auto z = answer.z();
    row["z"] = z ? number_or_null(*z) : nullptr;
    row["verdict"] = cells_of(judged).verdict;
    row["tolerance"] = answer.tolerance;
    if (const std::string more = remark(judged); !more.empty()) row["remark"] = more;
    json["cases"].push_back(row);
  }
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace sunfleck
