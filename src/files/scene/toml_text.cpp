#include "files/scene/toml_text.h"

#include "base/error.h"
#include "base/file.h"
#include "files/scene/plain_name.h"

namespace sunfleck {

std::string toml_string(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    result += c;
  }
  return result + '"';
}

std::string toml_key(std::string_view name) {
  return is_plain_name(name) ? std::string(name) : toml_string(name);
}

void check_nameable(const std::string& name) {
  if (is_utf8(name) && printable(name) == name) return;
  throw_input(printable(name), "a scene file cannot name it: names must be UTF-8 without control characters", "rename it");
}

}  // namespace sunfleck
