#include "files/scene/toml_parse.h"

#include "base/error.h"
#include "base/file.h"
#include "base/text.h"
#include "base/text_reader.h"
#include "files/formats/mesh/mesh_content.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <regex>

namespace sunfleck {

namespace {

// Most dots in a key, more than any key of a scene needs. toml++ makes a table of every segment and frees them recursively, so
// a chain of 100,000 segments would overflow the stack. (It limits nested arrays and inline tables to 256 itself.)
constexpr int max_dots_in_key = 8;

std::size_t count_lines(std::string_view text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

[[noreturn]] void refuse_at(const std::string& file, std::string_view text, std::size_t at, std::string_view what,
                            std::string_view why, std::string_view cure) {
  throw_input(fmt::format("{}:{}: {}", file, 1 + count_lines(text.substr(0, at)), what), why, cure);
}

// Returns the position after the string that starts at `begin`. An unterminated string ends with its line or the text; the
// parser refuses it later.
std::size_t end_of_string(const std::string& file, std::string_view text, std::size_t begin) {
  const char quote = text[begin];
  const std::string fence(3, quote);
  const bool multi_line = text.substr(begin, 3) == fence;
  std::size_t at = begin + (multi_line ? 3 : 1);
  while (at < text.size()) {
    if (text[at] == '\\' && quote == '"') {
      const std::size_t next = text.find_first_not_of(" \t\r\n", at + 1);
      if (next != text.npos && !is_ascii(text[next]))
        refuse_at(file, text, at, "a backslash before a non-ASCII character", "this is not an escape sequence",
                  "move the character or write \\uXXXX");
      at += 2;
    } else if (multi_line && text.substr(at, 3) == fence) {
      at += 3;
      // Up to two quotes may precede the closing three.
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

struct Lookalike {
  std::string_view sign;
  const char* name;
  const char* cure;
};

// What word processors and web pages make of ASCII characters.
constexpr Lookalike lookalikes[] = {
    {"\u2212", "a typographic minus", "write the hyphen, -"},
    {"\u2013", "a dash", "write the hyphen, -"},
    {"\u2014", "a dash", "write the hyphen, -"},
    {"\u201c", "a typographic quote", "write straight quotes, \""},
    {"\u201d", "a typographic quote", "write straight quotes, \""},
    {"\u201e", "a typographic quote", "write straight quotes, \""},
    {"\u2018", "a typographic quote", "write straight quotes, \""},
    {"\u2019", "a typographic quote", "write straight quotes, \""},
    {"\u00a0", "a non-breaking space", "write an ordinary blank"},
    {"\u00b0", "a degree sign", "write the number of degrees alone"},
};

[[noreturn]] void refuse_non_ascii(const std::string& file, std::string_view text, std::size_t at) {
  for (const auto& [sign, name, cure] : lookalikes) {
    if (text.substr(at).starts_with(sign)) refuse_at(file, text, at, name, "TOML does not know it outside quotes", cure);
  }
  refuse_at(file, text, at, "a non-ASCII character", "these are allowed only in quoted texts and comments",
            "write it in quotes");
}

// Refuses non-ASCII characters outside strings and comments, and after a line-ending backslash. toml++ 3.3 would test whether
// they are blanks with a function whose behaviour is undefined for most characters.
void check_syntax(const std::string& file, std::string_view text) {
  int dots = 0;
  for (std::size_t at = 0; at < text.size();) {
    const char c = text[at];
    if (c == '"' || c == '\'') {
      if (at > 0 && std::string_view(" \t\r\n=[{,.").find(text[at - 1]) == std::string_view::npos)
        refuse_at(file, text, at, "a quote inside a word", "only texts may begin with a quote",
                  "put a blank or a comma before it");
      at = end_of_string(file, text, at);
      continue;
    }
    if (c == '#') {
      at = std::min(text.find('\n', at), text.size());
      continue;
    }
    if (!is_ascii(c)) refuse_non_ascii(file, text, at);
    if (std::string_view("\n=[]{},").find(c) != std::string_view::npos) dots = 0;
    if (c == '.' && ++dots > max_dots_in_key)
      refuse_at(file, text, at, "a dotted key",
                fmt::format("has more than {} dots, more than any key of a scene", max_dots_in_key), "shorten it");
    ++at;
  }
}

void refuse_non_text(const std::string& file, std::string_view text) {
  if (text.find_first_not_of(" \t\r\n") == std::string_view::npos) {
    throw_input(fmt::format("{}:1: the file", file), "is empty", "write a scene with at least [plot] size and one [[band]]");
  }
  constexpr std::size_t enough = 4096;  // to recognise a mesh
  if (const auto ending = mesh_ending_of(without_mark(text).substr(0, enough))) {
    throw_input(
        fmt::format("{}:1: the file", file), fmt::format("is a mesh ({}), not a scene in TOML", *ending),
        fmt::format("rename it so that it ends in {0}, and write a scene for it: sunfleck new FILE{0} -o stand.toml", *ending));
  }
  const std::size_t first = without_mark(text).find_first_not_of(" \t\r\n");
  const std::string_view begin = without_mark(text).substr(std::min(first, without_mark(text).size()));
  if (begin.starts_with('<')) {
    throw_input(fmt::format("{}:1: the file", file), "is XML, not a scene in TOML",
                "convert a mesh to .obj, .ply or .glb and name it under [[geometry]] of a scene file");
  }
  if (begin.starts_with('{')) {
    throw_input(fmt::format("{}:1: the file", file), "looks like JSON, not a scene in TOML",
                "give a scene file, with tables such as [plot]");
  }
  const std::size_t nul = text.find('\0');
  if (nul != std::string_view::npos) {
    refuse_at(file, text, nul, "a NUL byte", "a scene is UTF-8 text; this is binary or UTF-16",
              "give a TOML file saved as UTF-8");
  }
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    if (!is_utf8(text.substr(at, end - at)))
      refuse_at(file, text, at, "a character that is not UTF-8", "a scene is UTF-8 text", "save the file as UTF-8");
    at = end + 1;
  }
}

// Returns the line without its comment and without the content of its texts, cut to fit regular expressions.
std::string bare_line(std::string_view text, std::size_t number) {
  constexpr std::size_t longest = 300;
  std::string_view line;
  for (LineReader lines(text); lines.number() < number && lines.next();) line = lines.line();
  std::string bare;
  char quote = '\0';
  for (const char c : line.substr(0, longest)) {
    if (quote == '\0' && c == '#') break;
    const bool closes = c == quote;
    if (quote == '\0' || closes) bare += c;
    if (closes)
      quote = '\0';
    else if (quote == '\0' && (c == '"' || c == '\''))
      quote = c;
  }
  return bare;
}

struct Cure {
  const char* sign;
  const char* cure;
};

constexpr const char* cure_of_backslash = "write / for each backslash, or put the text in single quotes";

// Patterns in the parser's description.
constexpr Cure cures_by_description[] = {
    {"utf-8", "save the file as UTF-8"},
    {"array-of-tables", "write each of them in double brackets, [[NAME]]"},
    {"redefine", "keep one of the two"},
    {"parsing time", "write the time as hh:mm:ss, with seconds"},
    {"end-of-file", "complete it; the file may be truncated"},
    {"escape sequence", cure_of_backslash},
    {"unicode scalar", cure_of_backslash},
};

struct CureByLine {
  CureByLine(const char* pattern, const char* advice) : sign(pattern), cure(advice) {}

  std::regex sign;
  const char* cure;
};

// Returns the cures by patterns in the line. Patterns take long to compile, so they are compiled once, when a file has an error.
const std::vector<CureByLine>& cures_by_line() {
  static const std::vector<CureByLine> cures = {
      {R"(^\s*[A-Za-z_]+\s*:)", "write = between the key and its value"},
      {R"([0-9]{1,2}[/.][0-9]{1,2}[/.][0-9]{2,4})", "write the time as 2002-08-08T10:10:00+08:00"},
      {R"(=\s*\()", "write the list in square brackets"},
      {R"(\[\s*[-+]?[0-9.]+\s+[-+]?[0-9.])", "put commas between the numbers"},
      {R"(=\s*(True|TRUE|False|FALSE)\b)", "write true or false"},
      {R"(=\s*(yes|no|on|off|Yes|No|On|Off|YES|NO|ON|OFF)\b)", "write true or false"},
      {R"([=\[,]\s*[-+]?\.[0-9])", "write a digit before the point, 0.1 for .1"},
      {R"([0-9]\.\s*($|[,\]}]))", "write a digit after the point, 1.0 for 1."},
      {R"((latitude|longitude)\s*=\s*[-+]?[0-9.]+\s*[NSEW]\b)",
       "write the number of degrees alone, negative for south and west"},
      {R"([{,]\s*[A-Za-z_.]*[*?][^"]*=)", "put the pattern in quotes, \"leaf*\""},
      {R"([=\[,]\s*[-+]?[0-9.]+\s*(mm|cm|m|deg|degrees|nm|W)\b)", "write the number without its unit: metres, degrees, W m-2"},
      {R"([0-9]\s*%)", "write the share without a percent sign, 0.1 for 10 %"},
      {R"(=\s*[-+]?[0-9]+,[0-9])", "write the number with a point, not a comma"},
      {R"(=\s*(?!(true|false|inf|nan)\b)([A-Za-z]|\.{0,2}[/\\]))", "put the text in quotes"},
  };
  return cures;
}

std::string cure_for(std::string_view description, const std::string& line) {
  for (const auto& [sign, cure] : cures_by_description)
    if (description.find(sign) != std::string_view::npos) return cure;
  for (const auto& [sign, cure] : cures_by_line())
    if (std::regex_search(line, sign)) return cure;
  return "correct the TOML syntax there";
}

}  // namespace

std::shared_ptr<const toml::table> parse_toml(const std::string& file, std::string_view text) {
  refuse_non_text(file, text);
  check_syntax(file, without_mark(text));
  try {
    return std::make_shared<const toml::table>(toml::parse(text));
  } catch (const toml::parse_error& error) {
    const unsigned line = std::max<unsigned>(error.source().begin.line, 1);
    throw_input(fmt::format("{}:{}: not valid TOML", file, line), printable(error.description()),
                cure_for(error.description(), bare_line(text, line)));
  }
}

}  // namespace sunfleck
