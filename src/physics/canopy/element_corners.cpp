#include "physics/canopy/element_corners.h"

#include "base/check.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace sunfleck {

Triangle ElementCorners::in_run(std::size_t element) const {
  std::size_t number = run_index_[element >> index_shift];
  while (number + 1 < runs_.size() && runs_[number + 1].first_element <= element) ++number;
  const Run& run = runs_[number];
  const std::size_t within = element - run.first_element;
  if (run.copy == no_copy) return own_[run.first_own + within];
  const MeshCopy& copy = copies_[run.copy];
  const Triangle& corners = meshes_[copy.mesh].corners[within];
  return {shared::placed_point(copy.turn, corners[0]), shared::placed_point(copy.turn, corners[1]),
          shared::placed_point(copy.turn, corners[2])};
}

void ElementCorners::add_run(const Run& run, std::size_t elements) {
  runs_.push_back(run);
  const std::size_t end = run.first_element + elements;
  while (run_index_.size() << index_shift < end) run_index_.push_back(static_cast<std::uint32_t>(runs_.size() - 1));
}

void ElementCorners::push_back(const Triangle& corners) {
  if (!runs_.empty()) {
    const auto element = static_cast<std::uint32_t>(size());
    const auto number = static_cast<std::uint32_t>(own_.size());
    if (runs_.back().copy != no_copy) {
      add_run({element, no_copy, number}, 1);
    } else if (run_index_.size() << index_shift <= element) {
      run_index_.push_back(static_cast<std::uint32_t>(runs_.size() - 1));
    }
  }
  own_.push_back(corners);
}

std::uint32_t ElementCorners::add_mesh(SharedMesh mesh) {
  EXPECT(mesh.traced.size(), ==, mesh.corners.size());
  meshes_.push_back(std::move(mesh));
  return static_cast<std::uint32_t>(meshes_.size() - 1);
}

void ElementCorners::add_copy(std::uint32_t mesh, const shared::CopyTurn& turn) {
  const std::size_t triangles = meshes_[mesh].corners.size();
  if (runs_.empty() && !own_.empty()) add_run({0, no_copy, 0}, own_.size());
  const auto first_element = static_cast<std::uint32_t>(size());
  add_run({first_element, static_cast<std::uint32_t>(copies_.size()), 0}, triangles);
  copies_.push_back({mesh, first_element, turn});
  shared_ += triangles;
}

std::vector<std::uint32_t> ElementCorners::own_elements() const {
  std::vector<std::uint32_t> elements(own_.size());
  std::iota(elements.begin(), elements.end(), 0U);
  for (std::size_t r = 0; r < runs_.size(); ++r) {
    if (runs_[r].copy != no_copy) continue;
    const std::size_t end = r + 1 < runs_.size() ? runs_[r + 1].first_element : size();
    std::iota(elements.begin() + runs_[r].first_own,
              elements.begin() + static_cast<std::ptrdiff_t>(runs_[r].first_own + (end - runs_[r].first_element)),
              runs_[r].first_element);
  }
  return elements;
}

bool operator==(const ElementCorners& a, const ElementCorners& b) {
  return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin());
}

}  // namespace sunfleck
