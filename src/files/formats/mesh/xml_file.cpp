#include "files/formats/mesh/xml_file.h"

#include "base/file.h"
#include "base/text_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <new>
#include <string>

namespace sunfleck {

namespace {

constexpr std::string_view xml_blanks = " \t\r\n";

// Removes the next word from the text and returns it; empty at the end.
std::string_view next_xml_word(std::string_view& text) {
  text.remove_prefix(std::min(text.find_first_not_of(xml_blanks), text.size()));
  const std::string_view word = text.substr(0, text.find_first_of(xml_blanks));
  text.remove_prefix(word.size());
  return word;
}

// Returns the text of an element without the comments and elements in it.
std::string text_of(pugi::xml_node element) {
  std::string text;
  for (const pugi::xml_node part : element.children()) text += part.value();
  return text;
}

}  // namespace

XmlFile::XmlFile(const MeshSource& source) : source_(source), is_utf8_(is_utf8(source.bytes)) {
  const pugi::xml_encoding encoding = is_utf8_ ? pugi::encoding_utf8 : pugi::encoding_auto;
  const pugi::xml_parse_result result =
      document_.load_buffer(source.bytes.data(), source.bytes.size(), pugi::parse_default, encoding);
  if (result.status == pugi::status_out_of_memory) throw std::bad_alloc();
  if (!result) refuse(source, line_at(result.offset), "is not well-formed XML", result.description(), "export the file again");
}

pugi::xml_node XmlFile::root(std::string_view name) const {
  const pugi::xml_node element = document_.document_element();
  if (element.name() != name)
    refuse_at(element, fmt::format("begins with <{}>", in_quotes(element.name())), fmt::format("must be <{}>", name),
              "export the file again, or rename it to match its format");
  return element;
}

template <class Value>
std::vector<Value> XmlFile::values(pugi::xml_node element, std::optional<Value> (*parse)(std::string_view),
                                   std::string_view why) const {
  std::vector<Value> values;
  const std::string whole = text_of(element);
  std::string_view text = whole;
  for (std::string_view word = next_xml_word(text); !word.empty(); word = next_xml_word(text)) {
    const std::optional<Value> value = parse(word);
    if (!value) refuse_at(element, fmt::format("<{}>: {}", element.name(), in_quotes(word)), why);
    values.push_back(*value);
  }
  return values;
}

std::vector<double> XmlFile::numbers(pugi::xml_node element) const {
  return values<double>(element, parse_number, "not a finite number");
}

std::vector<std::int64_t> XmlFile::integers(pugi::xml_node element) const {
  return values<std::int64_t>(element, parse_integer, "not a whole number");
}

std::vector<double> XmlFile::numbers(pugi::xml_node element, std::size_t count) const {
  std::vector<double> values = numbers(element);
  if (values.size() != count)
    refuse_at(element, fmt::format("<{}> has {} numbers", element.name(), values.size()), fmt::format("it needs {}", count));
  return values;
}

void XmlFile::refuse_at(pugi::xml_node element, std::string_view what, std::string_view why, std::string_view cure) const {
  refuse(source_, line_at(element.offset_debug()), what, why, cure);
}

std::size_t XmlFile::line_at(std::ptrdiff_t offset) const {
  if (offset < 0 || !is_utf8_) return 0;  // the offset is one in the text as UTF-8
  const std::string_view before = source_.bytes.substr(0, static_cast<std::size_t>(offset));
  return 1 + static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n'));
}

}  // namespace sunfleck
