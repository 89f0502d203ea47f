#include "files/scene/toml_view.h"

#include "base/error.h"
#include "base/file.h"
#include "base/suggestions.h"
#include "files/scene/text_number.h"
#include "files/scene/toml_parse.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace sunfleck {
namespace {

constexpr std::size_t longest_text = 4096;  // the longest path in Linux
constexpr std::size_t longest_shown = 200;  // longest excerpt shown in a message

std::string kind_of(const toml::node& node) {
  switch (node.type()) {
    case toml::node_type::table:
      return "a table";
    case toml::node_type::array:
      return "a list";
    case toml::node_type::string:
      return "a text";
    case toml::node_type::integer:
      return "a whole number";
    case toml::node_type::floating_point:
      return "a number";
    case toml::node_type::boolean:
      return "true or false";
    case toml::node_type::date:
      return "a date";
    case toml::node_type::time:
      return "a time of day";
    case toml::node_type::date_time:
      return "a date and time";
    default:
      return "nothing";
  }
}

std::string value_of(const toml::node& node) {
  if (const auto* text = node.as_string()) return "\"" + printable(shortened(text->get(), longest_shown)) + "\"";
  if (const auto* whole = node.as_integer()) return fmt::format("{}", whole->get());
  if (const auto* real = node.as_floating_point()) return fmt::format("{}", real->get());
  if (const auto* truth = node.as_boolean()) return truth->get() ? "true" : "false";
  if (node.is_array()) return "[...]";
  if (node.is_table()) return "{...}";
  std::ostringstream written;
  node.visit([&](const auto& value) {
    if constexpr (toml::is_chronological<decltype(value)>) written << value.get();
  });
  return written.str();
}

// Returns "= value" if the value is worth showing.
std::string assigned(const toml::node& node) {
  return node.is_table() || node.is_array_of_tables() ? "" : " = " + value_of(node);
}

std::string rule_of(const NumberRange& range) {
  const bool no_lo = range.lo == NumberRange{}.lo;
  const bool no_hi = range.hi == NumberRange{}.hi;
  if (no_lo && no_hi) return "must be a finite number";
  const std::string over = fmt::format("{} {:.12g}", range.lo_open ? "above" : "at least", range.lo);
  const std::string under = fmt::format("{} {:.12g}", range.hi_open ? "below" : "at most", range.hi);
  if (no_hi) return "must be " + over;
  if (no_lo) return "must be " + under;
  if (!range.lo_open && !range.hi_open) return fmt::format("must lie in {:.12g}..{:.12g}", range.lo, range.hi);
  return fmt::format("must be {} and {}", over, under);
}

bool allows(const NumberRange& range, double value) {
  if (!std::isfinite(value)) return false;
  return (range.lo_open ? value > range.lo : value >= range.lo) && (range.hi_open ? value < range.hi : value <= range.hi);
}

struct Synonym {
  std::string_view word, key;
};

// Words of other programs for keys of a scene.
constexpr Synonym synonyms[] = {
    {"altitude", "elevation"}, {"zenith", "elevation"},  {"lat", "latitude"},   {"lon", "longitude"},
    {"lng", "longitude"},      {"mesh", "file"},         {"rotate", "heading"}, {"rotation", "heading"},
    {"date", "time"},          {"irradiance", "direct"}, {"range", "range_nm"}, {"wavelengths", "range_nm"},
    {"rotations", "heading"},  {"start", "from"},        {"end", "to"},         {"stop", "to"},
    {"width", "step"}};

// Returns what an unknown key is to be replaced with.
std::string cure_of_key(std::string_view key, const std::vector<std::string>& known, std::string_view otherwise) {
  for (const auto& [word, meant] : synonyms) {
    if (key == word && std::find(known.begin(), known.end(), meant) != known.end()) {
      return fmt::format("use {}{}", meant, key == "zenith" ? ", 90 minus the zenith angle" : "");
    }
  }
  return did_you_mean(key, known, otherwise);
}

}  // namespace

TomlTable TomlTable::parse(const std::string& file, std::string_view text) {
  const auto name = std::make_shared<const std::string>(printable(file));
  return TomlTable(name, parse_toml(*name, text), "", 1);
}

const toml::node* TomlTable::find(std::string_view key) const {
  return table_->get(key);
}

std::string TomlTable::dotted(std::string_view key) const {
  const std::string shown = printable(shortened(key, longest_shown));
  return name_.empty() ? shown : name_ + "." + shown;
}

std::string TomlTable::place(std::string_view key) const {
  const auto entry = table_->find(key);
  const unsigned line = entry == table_->end() ? line_ : entry->first.source().begin.line;
  return fmt::format("{}:{}: {}", *file_, line, dotted(key));
}

std::string TomlTable::place() const {
  return fmt::format("{}:{}: {}", *file_, line_, name_.empty() ? "the scene" : name_);
}

void TomlTable::refuse(std::string_view key, std::string_view why, std::string_view cure) const {
  const toml::node* node = find(key);
  throw_input(place(key) + (node == nullptr ? "" : assigned(*node)), why, cure);
}

void TomlTable::refuse_missing_file(std::string_view key) const {
  throw MissingFile(three_part_message(place(key) + assigned(*find(key)),
                                       "there is no such file; names are relative to the scene's folder", "correct the name"));
}

void TomlTable::refuse_table(std::string_view why, std::string_view cure) const {
  throw_input(place(), why, cure);
}

void TomlTable::refuse_item(std::string_view key, const toml::node& item, std::optional<std::size_t> index,
                            std::string_view why, std::string_view cure) const {
  if (!index) refuse(key, why, cure);
  throw_input(fmt::format("{}:{}: {}, item {} = {}", *file_, item.source().begin.line, dotted(key), *index + 1, value_of(item)),
              why, cure);
}

void TomlTable::allow(std::initializer_list<std::string_view> keys) const {
  const std::vector<std::string> known(keys.begin(), keys.end());
  for (const auto& [key, node] : *table_) {
    if (std::find(keys.begin(), keys.end(), key.str()) != keys.end()) continue;
    throw_input(place(key.str()), "is not a key of " + (name_.empty() ? "a scene file" : name_),
                cure_of_key(key.str(), known, fmt::format("remove it, or use one of {}", fmt::join(known, ", "))));
  }
}

void TomlTable::require(std::string_view key, std::string_view example) const {
  if (!has(key))
    throw_input(fmt::format("{}:{}: {}", *file_, line_, dotted(key)), "is missing", fmt::format("add {}", example));
}

bool TomlTable::has(std::string_view key) const {
  return find(key) != nullptr;
}

bool TomlTable::is_table(std::string_view key) const {
  return (*table_)[key].is_table();
}

bool TomlTable::is_text(std::string_view key) const {
  return (*table_)[key].is_string();
}

std::vector<std::string> TomlTable::keys() const {
  std::vector<std::string> names;
  for (const auto& [key, node] : *table_) names.emplace_back(key.str());
  return names;
}

std::vector<std::string> TomlTable::keys_as_written() const {
  std::vector<const toml::key*> written;
  for (const auto& [key, node] : *table_) written.push_back(&key);
  std::sort(written.begin(), written.end(),
            [](const toml::key* a, const toml::key* b) { return a->source().begin < b->source().begin; });
  std::vector<std::string> names;
  for (const toml::key* key : written) names.emplace_back(key->str());
  return names;
}

double TomlTable::checked(std::string_view key, const toml::node& item, std::optional<std::size_t> index,
                          const NumberRange& range) const {
  if (!item.is_number()) {
    refuse_item(key, item, index, "must be a number, not " + kind_of(item),
                item.is_string() ? cure_of_text(item.as_string()->get(), range.cure) : "give a number");
  }
  const double value = item.is_integer() ? static_cast<double>(item.as_integer()->get()) : item.as_floating_point()->get();
  if (!allows(range, value)) {
    const std::string cure = range.is_share && value > 1.0 && value <= 100.0
                                 ? fmt::format("give {:.6g} if percent was meant", value / 100.0)
                                 : std::string(range.cure);
    refuse_item(key, item, index, rule_of(range), cure);
  }
  return value;
}

std::optional<double> TomlTable::number(std::string_view key, const NumberRange& range) const {
  const toml::node* node = find(key);
  if (node == nullptr) return std::nullopt;
  return checked(key, *node, std::nullopt, range);
}

std::optional<std::int64_t> TomlTable::integer(std::string_view key, std::int64_t lo, std::int64_t hi) const {
  const toml::node* node = find(key);
  if (node == nullptr) return std::nullopt;
  const bool unbounded = hi == std::numeric_limits<std::int64_t>::max();
  const std::string rule = unbounded ? fmt::format("must be a whole number of at least {}", lo)
                                     : fmt::format("must be a whole number in {}..{}", lo, hi);
  if (!node->is_integer()) refuse(key, rule + ", not " + kind_of(*node), "write it without quotes or decimals");
  const std::int64_t value = node->as_integer()->get();
  if (value < lo || value > hi) refuse(key, rule, "give a value in that range");
  return value;
}

std::optional<bool> TomlTable::boolean(std::string_view key) const {
  const toml::node* node = find(key);
  if (node == nullptr) return std::nullopt;
  if (!node->is_boolean()) refuse(key, "must be true or false, not " + kind_of(*node), "write true or false, without quotes");
  return node->as_boolean()->get();
}

std::optional<std::string> TomlTable::text(std::string_view key) const {
  const toml::node* node = find(key);
  if (node == nullptr) return std::nullopt;
  if (!node->is_string())
    refuse(key, "must be a text, not " + kind_of(*node),
           node->is_array() || node->is_table() ? "write a single text in quotes" : "write it in quotes");
  const std::string& value = node->as_string()->get();
  const bool control = std::any_of(value.begin(), value.end(), [](char c) { return (c >= 0 && c < 0x20) || c == 0x7f; });
  if (control) refuse(key, "must be one line without control characters", "remove them");
  if (value.empty()) refuse(key, "must not be empty", "give a text or remove the key");
  if (value.size() > longest_text) refuse(key, fmt::format("must have at most {} bytes", longest_text), "shorten it");
  return value;
}

std::optional<std::size_t> TomlTable::word(std::string_view key, const std::vector<std::string>& words) const {
  if (has(key) && !is_text(key)) {
    refuse(key, fmt::format("must be one of {}, not {}", fmt::join(words, ", "), kind_of(*find(key))),
           "choose one of them, in quotes");
  }
  const auto value = text(key);
  if (!value) return std::nullopt;
  const auto found = std::find(words.begin(), words.end(), *value);
  if (found == words.end()) {
    refuse(key, fmt::format("must be one of {}", fmt::join(words, ", ")), did_you_mean(*value, words, "choose one of them"));
  }
  return static_cast<std::size_t>(found - words.begin());
}

std::optional<std::vector<double>> TomlTable::numbers(std::string_view key, std::size_t count, const NumberRange& range) const {
  const toml::node* node = find(key);
  if (node == nullptr) return std::nullopt;
  const toml::array* list = node->as_array();
  if (list == nullptr || list->size() != count) {
    const std::string found = list == nullptr ? "not " + kind_of(*node) : fmt::format("but has {}", list->size());
    const auto number = node->is_string() ? number_in_text(node->as_string()->get(), range.cure) : std::nullopt;
    const std::size_t shown = range.cure.find('[');  // an example of its own
    const std::string example = shown != range.cure.npos ? std::string(range.cure.substr(shown))
                                : number                 ? fmt::format("[{0:.12g}, {0:.12g}]", *number)
                                : count == 2             ? "[1.8, 2.4]"
                                                         : "[0.1, 0.2, 0.3]";
    refuse(key, fmt::format("must be a list of {} numbers, {}", count, found), "write it as " + example);
  }
  std::vector<double> values;
  for (std::size_t i = 0; i < count; ++i) values.push_back(checked(key, (*list)[i], i, range));
  return values;
}

glm::dvec3 TomlTable::checked_triple(std::string_view key, const toml::node& item, std::size_t index,
                                     const NumberRange& range) const {
  const toml::array* list = item.as_array();
  if (list == nullptr) {
    refuse_item(key, item, index, "must be a list of positions, not " + kind_of(item), "write it as [[0.9, 0.0, 1.2]]");
  }
  if (list->size() != 3) {
    refuse_item(key, item, index, fmt::format("must be x, y, z, but has {} numbers", list->size()),
                "write it as [0.9, 0.0, 1.2]");
  }
  return {checked(key, (*list)[0], index, range), checked(key, (*list)[1], index, range),
          checked(key, (*list)[2], index, range)};
}

std::optional<glm::dvec3> TomlTable::triple(std::string_view key, const NumberRange& range) const {
  const auto values = numbers(key, 3, range);
  if (!values) return std::nullopt;
  return glm::dvec3((*values)[0], (*values)[1], (*values)[2]);
}

std::optional<std::vector<glm::dvec3>> TomlTable::triples(std::string_view key, const NumberRange& range) const {
  const toml::node* node = find(key);
  if (node == nullptr) return std::nullopt;
  const toml::array* list = node->as_array();
  if (list == nullptr || list->empty()) {
    refuse(key, "must be a list of at least one position, but is " + (list == nullptr ? kind_of(*node) : "empty"),
           "write it as [[0.9, 0.0, 1.2]]");
  }
  std::vector<glm::dvec3> values;
  for (std::size_t i = 0; i < list->size(); ++i) values.push_back(checked_triple(key, (*list)[i], i, range));
  return values;
}

std::optional<std::vector<double>> TomlTable::number_or_list(std::string_view key, std::size_t count,
                                                             const NumberRange& range) const {
  const toml::node* node = find(key);
  if (node == nullptr) return std::nullopt;
  const toml::array* list = node->as_array();
  if (list == nullptr) return std::vector<double>(count, checked(key, *node, std::nullopt, range));
  if (list->size() != count) {
    refuse(key, fmt::format("has {} numbers for {} positions in `at`", list->size(), count),
           "give one for each position, or a single number");
  }
  std::vector<double> values;
  for (std::size_t i = 0; i < count; ++i) values.push_back(checked(key, (*list)[i], i, range));
  return values;
}

std::optional<OffsetTime> TomlTable::offset_time(std::string_view key) const {
  const toml::node* node = find(key);
  if (node == nullptr) return std::nullopt;
  const auto* value = node->as_date_time();
  constexpr auto example = "write it as 2002-08-08T10:10:00+08:00, without quotes";
  if (value == nullptr) refuse(key, "must be a date and time with its offset from UTC, not " + kind_of(*node), example);
  const toml::date_time& moment = value->get();
  if (!moment.offset) refuse(key, "has no offset from UTC, so the time is ambiguous", example);
  return OffsetTime{.year = moment.date.year,
                    .month = moment.date.month,
                    .day = moment.date.day,
                    .hour = moment.time.hour,
                    .minute = moment.time.minute,
                    .second = moment.time.second + 1e-9 * moment.time.nanosecond,
                    .offset_minutes = moment.offset->minutes};
}

std::optional<TomlTable> TomlTable::table(std::string_view key) const {
  const toml::node* node = find(key);
  if (node == nullptr) return std::nullopt;
  const toml::table* found = node->as_table();
  if (found == nullptr) {
    refuse(key, "must be a table, not " + (node->is_array_of_tables() ? "a list of tables" : kind_of(*node)),
           fmt::format("write [{}] once, with its keys below it", dotted(key)));
  }
  const unsigned line = table_->find(key)->first.source().begin.line;
  return TomlTable(file_, std::shared_ptr<const toml::table>(table_, found), dotted(key), line);
}

std::vector<TomlTable> TomlTable::tables(std::string_view key) const {
  const toml::node* node = find(key);
  if (node == nullptr) return {};
  const std::string cure = fmt::format("write [[{}]] with two brackets, and its keys below it", dotted(key));
  const toml::array* list = node->as_array();
  if (list == nullptr) refuse(key, "must be a list of tables, not " + kind_of(*node), cure);
  std::vector<TomlTable> found;
  for (std::size_t i = 0; i < list->size(); ++i) {
    const toml::table* item = (*list)[i].as_table();
    if (item == nullptr) refuse_item(key, (*list)[i], i, "must be a table, not " + kind_of((*list)[i]), cure);
    found.push_back(TomlTable(file_, std::shared_ptr<const toml::table>(table_, item), dotted(key), item->source().begin.line));
  }
  return found;
}

}  // namespace sunfleck
