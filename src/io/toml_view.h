#pragma once
// A strict view of a TOML text: every access checks type and range, and every message is one line that names the file, the
// line and the dotted key. All failures are Error (input).

#include <toml++/impl/forward_declarations.h>
#include <cstdint>
#include <glm/vec3.hpp>
#include <initializer_list>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sunfleck {

// Allowed values of a number; an open end excludes the bound itself. Values that are not finite are never allowed.
struct NumberRange {
  double lo = std::numeric_limits<double>::lowest();
  double hi = std::numeric_limits<double>::max();
  bool lo_open = false;
  bool hi_open = false;
  bool is_share = false;  // of a whole: a value above 1 is answered with the percent it may have meant
  std::string_view cure = "give a value in that range";
};

// A date and time as written, with its distance from UTC (east of Greenwich positive).
struct OffsetTime {
  int year = 2000, month = 1, day = 1, hour = 0, minute = 0;
  double second = 0.0;
  int offset_minutes = 0;
};

// The candidate nearest to `word`: at most two edits away, upper or lower case aside, and no more than half of the
// letters. None if there is no such.
[[nodiscard]] std::optional<std::string> nearest_word(std::string_view word, const std::vector<std::string>& candidates);

// "did you mean X?" if there is a nearest word, else `otherwise`.
[[nodiscard]] std::string did_you_mean(std::string_view word, const std::vector<std::string>& candidates,
                                       std::string_view otherwise);

// One table of a TOML text. A cheap handle; it keeps the whole text's tree alive.
// Optional values: an accessor returns nothing where the key is absent; call `require` first where it must not be.
class TomlTable {
 public:
  // The root table of a text. `file` is the name that messages carry.
  [[nodiscard]] static TomlTable parse(const std::string& file, std::string_view text);

  // Refuses any key that is not one of these, with the nearest of them as a suggestion.
  void allow(std::initializer_list<std::string_view> keys) const;
  // Refuses the table if `key` is absent; the cure shows `example`.
  void require(std::string_view key, std::string_view example) const;

  [[nodiscard]] bool has(std::string_view key) const;
  [[nodiscard]] bool is_table(std::string_view key) const;
  [[nodiscard]] std::vector<std::string> keys() const;  // in alphabetical order

  [[nodiscard]] std::optional<double> number(std::string_view key, const NumberRange& range) const;
  [[nodiscard]] std::optional<std::int64_t> integer(std::string_view key, std::int64_t lo, std::int64_t hi) const;
  [[nodiscard]] std::optional<bool> boolean(std::string_view key) const;
  [[nodiscard]] std::optional<std::string> text(std::string_view key) const;  // one line, not empty, at most 4096 bytes
  // The place of the text found among `words`.
  [[nodiscard]] std::optional<std::size_t> word(std::string_view key, const std::vector<std::string>& words) const;
  // A list of exactly `count` numbers.
  [[nodiscard]] std::optional<std::vector<double>> numbers(std::string_view key, std::size_t count,
                                                           const NumberRange& range) const;
  [[nodiscard]] std::optional<glm::dvec3> triple(std::string_view key, const NumberRange& range) const;
  // A list of at least one [x, y, z].
  [[nodiscard]] std::optional<std::vector<glm::dvec3>> triples(std::string_view key, const NumberRange& range) const;
  // One number, or a list of `count` numbers; the result has `count` of them.
  [[nodiscard]] std::optional<std::vector<double>> number_or_list(std::string_view key, std::size_t count,
                                                                  const NumberRange& range) const;
  [[nodiscard]] std::optional<OffsetTime> offset_time(std::string_view key) const;
  [[nodiscard]] std::optional<TomlTable> table(std::string_view key) const;
  [[nodiscard]] std::vector<TomlTable> tables(std::string_view key) const;  // of [[key]]; empty if absent

  // Throws: the key with its value, (why); cure. `refuse_table` speaks of the table as a whole.
  [[noreturn]] void refuse(std::string_view key, std::string_view why, std::string_view cure) const;
  [[noreturn]] void refuse_table(std::string_view why, std::string_view cure) const;

  // "file:line: dotted.key" of a key that is there, and of the table itself.
  [[nodiscard]] std::string place(std::string_view key) const;
  [[nodiscard]] std::string place() const;

 private:
  TomlTable(std::shared_ptr<const std::string> file, std::shared_ptr<const toml::table> table, std::string name, unsigned line)
      : file_(std::move(file)), table_(std::move(table)), name_(std::move(name)), line_(line) {}

  [[nodiscard]] const toml::node* find(std::string_view key) const;
  [[nodiscard]] std::string dotted(std::string_view key) const;
  [[noreturn]] void refuse_item(std::string_view key, const toml::node& item, std::optional<std::size_t> index,
                                std::string_view why, std::string_view cure) const;
  [[nodiscard]] double checked(std::string_view key, const toml::node& item, std::optional<std::size_t> index,
                               const NumberRange& range) const;
  [[nodiscard]] glm::dvec3 checked_triple(std::string_view key, const toml::node& item, std::size_t index,
                                          const NumberRange& range) const;

  std::shared_ptr<const std::string> file_;
  std::shared_ptr<const toml::table> table_;
  std::string name_;  // dotted; empty for the root
  unsigned line_ = 1;
};

}  // namespace sunfleck
