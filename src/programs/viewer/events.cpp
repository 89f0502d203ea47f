#include "programs/viewer/events.h"

#include <nlohmann/json.hpp>

#include <cstdio>

namespace sunfleck {

void Events::tell(const std::string& name, const nlohmann::json& fields) const {
  if (!wanted()) return;
  nlohmann::ordered_json line;
  line["event"] = name;
  for (const auto& [key, value] : fields.items()) line[key] = value;
  const std::string text = line.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
  std::fputs(text.c_str(), stdout);
  std::fflush(stdout);
}

}  // namespace sunfleck
