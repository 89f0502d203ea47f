#pragma once
// A strict view of a TOML text: every access checks type and range, and every message is one line that names the file, the line
// and the dotted key. All failures throw Error (input).

#include <toml++/impl/forward_declarations.h>

#include <cstdint>
#include <glm/vec3.hpp>
#include <initializer_list>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sunfleck {

// Allowed values of a number; an open end excludes the bound itself. Values that are not finite are never allowed.
struct NumberRange {
  double lo = std::numeric_limits<double>::lowest();
  double hi = std::numeric_limits<double>::max();
  bool lo_open = false;
  bool hi_open = false;
  bool is_share = false;  // share of a whole: for a value above 1 the message suggests that percent was meant
  std::string_view cure = "give a value in that range";
};

inline constexpr double farthest_m = 1e7;  // largest coordinate of a scene
inline constexpr NumberRange anywhere{.lo = -farthest_m, .hi = farthest_m, .cure = "give metres"};

// A date and time as written, with its offset from UTC (positive to the east).
struct OffsetTime {
  int year = 2000, month = 1, day = 1, hour = 0, minute = 0;
  double second = 0.0;
  int offset_minutes = 0;
};

// One table of a TOML text. It is a cheap handle that keeps the tree of the whole text alive. The accessors return nothing if
// the key is absent; call `require` first for mandatory keys.
class TomlTable {
 public:
  // Returns the root table of a text. Messages refer to it as `file`.
  [[nodiscard]] static TomlTable parse(const std::string& file, std::string_view text);

  // Refuses any key that is not listed, and suggests the nearest one.
  void allow(std::initializer_list<std::string_view> keys) const;
  // Refuses the table if `key` is absent; the advice shows `example`.
  void require(std::string_view key, std::string_view example) const;

  [[nodiscard]] bool has(std::string_view key) const;
  [[nodiscard]] bool is_table(std::string_view key) const;
  [[nodiscard]] bool is_text(std::string_view key) const;
  [[nodiscard]] std::vector<std::string> keys() const;  // in alphabetical order
  [[nodiscard]] std::vector<std::string> keys_as_written() const;

  [[nodiscard]] std::optional<double> number(std::string_view key, const NumberRange& range) const;
  [[nodiscard]] std::optional<std::int64_t> integer(std::string_view key, std::int64_t lo, std::int64_t hi) const;
  [[nodiscard]] std::optional<bool> boolean(std::string_view key) const;
  [[nodiscard]] std::optional<std::string> text(std::string_view key) const;  // one line, not empty, at most 4096 bytes
  // Returns the index of the text in `words`.
  [[nodiscard]] std::optional<std::size_t> word(std::string_view key, const std::vector<std::string>& words) const;
  // Returns a list of exactly `count` numbers.
  [[nodiscard]] std::optional<std::vector<double>> numbers(std::string_view key, std::size_t count,
                                                           const NumberRange& range) const;
  [[nodiscard]] std::optional<glm::dvec3> triple(std::string_view key, const NumberRange& range) const;
  // Returns a list of at least one [x, y, z].
  [[nodiscard]] std::optional<std::vector<glm::dvec3>> triples(std::string_view key, const NumberRange& range) const;
  // Returns `count` numbers, from a list of that length or from one number that is repeated.
  [[nodiscard]] std::optional<std::vector<double>> number_or_list(std::string_view key, std::size_t count,
                                                                  const NumberRange& range) const;
  [[nodiscard]] std::optional<OffsetTime> offset_time(std::string_view key) const;
  [[nodiscard]] std::optional<TomlTable> table(std::string_view key) const;
  [[nodiscard]] std::vector<TomlTable> tables(std::string_view key) const;  // the [[key]] tables; empty if absent

  // Throw Error: the key with its value, (why); cure. `refuse_table` refers to the table as a whole.
  [[noreturn]] void refuse(std::string_view key, std::string_view why, std::string_view cure) const;
  // Throws MissingFile for a key that names a file, relative to the scene's folder.
  [[noreturn]] void refuse_missing_file(std::string_view key) const;
  [[noreturn]] void refuse_table(std::string_view why, std::string_view cure) const;

  // Return "file:line: dotted.key" of an existing key, and the same of the table itself.
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
