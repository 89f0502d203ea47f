#pragma once
// The program's own identity, which every result names.

#include <string>

namespace sunfleck {

[[nodiscard]] std::string version();  // e.g. "0.1.0"
[[nodiscard]] std::string commit();   // as built; "unknown" outside a repository

}  // namespace sunfleck
