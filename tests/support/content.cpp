#include "support/content.h"

#include <fstream>
#include <sstream>

namespace sunfleck::test {

std::string content(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

}  // namespace sunfleck::test
