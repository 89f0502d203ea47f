#include "files/formats/mesh/ply_colours.h"

#include <fmt/format.h>

#include <algorithm>

namespace sunfleck {

namespace {

// Plants drawn organ by organ have a handful of colours; scanned ones have thousands.
constexpr std::size_t most_colours = 64;

}  // namespace

void PlyColours::add_face(std::span<const std::uint32_t> corners, std::optional<std::uint32_t> colour) {
  if (!colour) {
    const auto is_known = [&](std::uint32_t corner) { return corner < of_vertex_.size(); };
    is_complete_ = is_complete_ && std::all_of(corners.begin(), corners.end(), is_known);
    if (!is_complete_) return;
    colour = of_vertex_[corners.front()];
    if (std::any_of(corners.begin(), corners.end(), [&](std::uint32_t corner) { return of_vertex_[corner] != *colour; }))
      ++mixed_;
  }
  if (colours_.size() > most_colours) return;
  const auto [entry, is_new] = number_of_.try_emplace(*colour, static_cast<std::uint32_t>(colours_.size()));
  if (is_new) colours_.push_back(*colour);
  of_triangle_.insert(of_triangle_.end(), corners.size() - 2, entry->second);
}

std::vector<std::string> PlyColours::names() const {
  std::vector<std::string> names;
  if (!is_complete_ || colours_.size() < 2 || mixed_ > 0 || colours_.size() > most_colours) return names;
  for (const std::uint32_t colour : colours_) names.push_back(fmt::format("colour_{:06x}", colour));
  return names;
}

std::size_t PlyColours::mixed_faces() const {
  return colours_.size() > most_colours ? 0 : mixed_;
}

}  // namespace sunfleck
