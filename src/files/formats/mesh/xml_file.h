#pragma once
// XML files of meshes: their numbers, and messages with the line of an element.

#include "files/formats/mesh/mesh_source.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <pugixml.hpp>
#include <string_view>
#include <vector>

namespace sunfleck {

class XmlFile {
 public:
  // Parses the bytes: UTF-8, or else what the file declares of UTF-16, UTF-32 and Latin-1. Entities of a document type are not
  // expanded and nothing else is opened. Throws Error (input) if they are no well-formed XML. `source` must outlive the object.
  explicit XmlFile(const MeshSource& source);

  // Returns the outermost element; refuses the file if it has another name.
  [[nodiscard]] pugi::xml_node root(std::string_view name) const;

  // Return the numbers in the text of an element; refuse anything else in it, as well as values that are not finite.
  [[nodiscard]] std::vector<double> numbers(pugi::xml_node element) const;
  [[nodiscard]] std::vector<std::int64_t> integers(pugi::xml_node element) const;
  // Returns the numbers in the text of an element that must have `count` of them.
  [[nodiscard]] std::vector<double> numbers(pugi::xml_node element, std::size_t count) const;

  // Throws Error (input) with the line of the element.
  [[noreturn]] void refuse_at(pugi::xml_node element, std::string_view what, std::string_view why,
                              std::string_view cure = "export the file again") const;

 private:
  template <class Value>
  [[nodiscard]] std::vector<Value> values(pugi::xml_node element, std::optional<Value> (*parse)(std::string_view),
                                          std::string_view why) const;
  [[nodiscard]] std::size_t line_at(std::ptrdiff_t offset) const;

  const MeshSource& source_;
  bool is_utf8_;
  pugi::xml_document document_;
};

}  // namespace sunfleck
