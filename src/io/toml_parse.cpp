// From text to a TomlTable: what toml++ leaves unchecked, and its errors as one line.

#include "base/error.h"
#include "io/toml_view.h"

#include <fmt/format.h>

#include <toml++/toml.h>
#include <algorithm>

namespace sunfleck {

namespace {

// Deeper than any key of a scene; toml++ makes a table of every segment and frees them by recursion, so that a chain of
// 100,000 segments overflows the stack. (It limits nested arrays and inline tables to 256 by itself.)
constexpr int max_dots_in_key = 8;

std::size_t count_lines(std::string_view text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

// The place after the string that starts at `begin`; an unterminated one ends at its line or at the text's end, and the
// parser refuses it later.
std::size_t end_of_string(std::string_view text, std::size_t begin) {
  const char quote = text[begin];
  const std::string fence(3, quote);
  const bool multi_line = text.substr(begin, 3) == fence;
  std::size_t at = begin + (multi_line ? 3 : 1);
  while (at < text.size()) {
    if (text[at] == '\\' && quote == '"') {
      at += 2;
    } else if (multi_line && text.substr(at, 3) == fence) {
      at += 3;
      // Up to two quotes may stand directly before the closing three.
      for (int extra = 0; extra < 2 && at < text.size() && text[at] == quote; ++extra) ++at;
      return at;
    } else if (!multi_line && (text[at] == quote || text[at] == '\n')) {
      return text[at] == quote ? at + 1 : at;
    } else {
      ++at;
    }
  }
  return text.size();
}

void refuse_deep_keys(const std::string& file, std::string_view text) {
  int dots = 0;
  for (std::size_t at = 0; at < text.size();) {
    const char c = text[at];
    if (c == '"' || c == '\'') {
      at = end_of_string(text, at);
      continue;
    }
    if (c == '#') {
      at = std::min(text.find('\n', at), text.size());
      continue;
    }
    if (std::string_view("\n=[]{},").find(c) != std::string_view::npos) dots = 0;
    if (c == '.' && ++dots > max_dots_in_key) {
      throw_input(fmt::format("{}:{}: a dotted key", file, 1 + count_lines(text.substr(0, at))),
                  fmt::format("has more than {} dots, deeper than any key of a scene", max_dots_in_key), "shorten it");
    }
    ++at;
  }
}

void refuse_non_text(const std::string& file, std::string_view text) {
  if (text.find_first_not_of(" \t\r\n") == std::string_view::npos) {
    throw_input(fmt::format("{}:1: the file", file), "is empty", "write a scene with at least [plot] size and one [[band]]");
  }
  const std::size_t nul = text.find('\0');
  if (nul != std::string_view::npos) {
    throw_input(fmt::format("{}:{}: a NUL byte", file, 1 + count_lines(text.substr(0, nul))),
                "a scene is UTF-8 text; this is binary or UTF-16", "give a TOML file saved as UTF-8");
  }
}

// On one line and whole: a file's name is found by its end, so it is not shortened.
std::string one_line(std::string_view text) {
  std::string line(text);
  std::replace_if(
      line.begin(), line.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; }, '?');
  return line;
}

std::string cure_for(std::string_view description) {
  if (description.find("utf-8") != std::string_view::npos) return "save the file as UTF-8";
  if (description.find("redefine") != std::string_view::npos) return "keep one of the two";
  if (description.find("end-of-file") != std::string_view::npos) return "finish it; the file may be cut off";
  return "correct the TOML syntax there";
}

}  // namespace

TomlTable TomlTable::parse(const std::string& file, std::string_view text) {
  const auto name = std::make_shared<const std::string>(one_line(file));
  refuse_non_text(*name, text);
  refuse_deep_keys(*name, text);
  try {
    auto tree = std::make_shared<const toml::table>(toml::parse(text));
    return TomlTable(name, std::move(tree), "", 1);
  } catch (const toml::parse_error& error) {
    const auto line = error.source().begin.line;
    throw_input(fmt::format("{}:{}: not valid TOML", *name, std::max<unsigned>(line, 1)), one_line(error.description()),
                cure_for(error.description()));
  }
}

}  // namespace sunfleck
