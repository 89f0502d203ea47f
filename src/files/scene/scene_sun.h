#pragma once
// Reads [sun].

#include "files/scene/scene_reader.h"
#include "files/scene/toml_view.h"
#include "physics/light/sun.h"

#include <optional>

namespace sunfleck {

struct SunInput {
  SunPosition position;
  std::optional<SunMoment> moment;
  TomlTable table;
};

// Returns nothing for a scene without [sun].
[[nodiscard]] std::optional<SunInput> read_sun(const TomlTable& root);

}  // namespace sunfleck
