#include "programs/viewer/state.h"

#include <algorithm>

namespace sunfleck {

std::size_t ViewerState::band() const {
  const auto found = std::find(bands.begin(), bands.end(), options.band);
  return found == bands.end() ? 0 : static_cast<std::size_t>(found - bands.begin());
}

bool is_picked_shown(const ViewerState& state) {
  return state.picked && state.frame && state.frame->pick == state.picked;
}

}  // namespace sunfleck
