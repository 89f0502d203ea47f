#pragma once
// The corners of all elements. Those of meshes that stand many times in a large canopy are kept once for each mesh.

#include "base/prefetch.h"
#include "base/shared_vector.h"
#include "physics/canopy/triangle.h"
#include "shared/turn.h"

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <iterator>
#include <span>
#include <vector>

namespace sunfleck {

// A mesh whose copies share its triangles.
struct SharedMesh {
  std::vector<Triangle> corners;  // [triangle], m, in a frame of its own
  // [triangle]: false for those that rays cannot meet: copies of earlier triangles, and those without area in some copy
  std::vector<bool> traced;
};

// One copy of a shared mesh. Its triangle t is the element first_element + t.
struct MeshCopy {
  std::uint32_t mesh = 0;
  std::uint32_t first_element = 0;
  shared::CopyTurn turn;
};

// A list of triangles, in the order of the elements, as a vector would hold them; but reading returns values. In a periodic
// plot an element with corners of its own is wrapped: its centroid lies in the plot. A copy of a shared mesh stays whole, and
// the origin of its mesh lies in the plot.
class ElementCorners {
 public:
  ElementCorners() = default;
  ElementCorners(std::initializer_list<Triangle> corners) : own_(corners) {}
  ElementCorners(std::vector<Triangle> corners) : own_(std::move(corners)) {}  // NOLINT(google-explicit-constructor)

  // Walks over the elements; what it refers to lives until its next step.
  class Iterator {
   public:
    using iterator_category = std::input_iterator_tag;
    using value_type = Triangle;
    using difference_type = std::ptrdiff_t;
    using pointer = const Triangle*;
    using reference = Triangle;

    Iterator(const ElementCorners& corners, std::size_t element) : corners_(&corners), element_(element) {}
    Triangle operator*() const { return (*corners_)[element_]; }
    Iterator& operator++() {
      ++element_;
      return *this;
    }
    Iterator operator++(int) { return {*corners_, element_++}; }
    friend bool operator==(const Iterator& a, const Iterator& b) { return a.element_ == b.element_; }

   private:
    const ElementCorners* corners_;
    std::size_t element_;
  };

  [[nodiscard]] std::size_t size() const { return own_.size() + shared_; }
  [[nodiscard]] bool empty() const { return size() == 0; }
  [[nodiscard]] Triangle operator[](std::size_t element) const { return runs_.empty() ? own_[element] : in_run(element); }
  // Asks for the memory of an element's corners, if they are its own.
  void prefetch(std::size_t element) const {
    if (runs_.empty()) sunfleck::prefetch(own_[element]);
  }
  [[nodiscard]] Triangle front() const { return (*this)[0]; }
  [[nodiscard]] Iterator begin() const { return {*this, 0}; }
  [[nodiscard]] Iterator end() const { return {*this, size()}; }

  // Reserves memory for elements with corners of their own.
  void reserve(std::size_t elements) { own_.reserve(elements); }
  // Appends an element with corners of its own.
  void push_back(const Triangle& corners);
  // Adds a mesh and returns its number.
  std::uint32_t add_mesh(SharedMesh mesh);
  // Appends the elements of a copy.
  void add_copy(std::uint32_t mesh, const shared::CopyTurn& turn);

  [[nodiscard]] std::span<const SharedMesh> meshes() const { return meshes_.get(); }
  [[nodiscard]] std::span<const MeshCopy> copies() const { return copies_.get(); }  // in ascending order of elements

  // Return the corners of the elements that have their own, and the numbers of these elements, ascending.
  [[nodiscard]] std::span<const Triangle> own() const { return own_.get(); }
  [[nodiscard]] std::vector<std::uint32_t> own_elements() const;

  static constexpr std::uint32_t no_copy = 0xffffffffU;
  // Consecutive elements that belong to one copy, or that have their own corners from own()[first_own] on.
  struct Run {
    std::uint32_t first_element = 0;
    std::uint32_t copy = no_copy;
    std::uint32_t first_own = 0;
  };
  // Returns the runs of all elements, in their order; none without copies.
  [[nodiscard]] std::span<const Run> runs() const { return runs_.get(); }

  // Returns all corners as one array.
  [[nodiscard]] std::vector<Triangle> all() const { return {begin(), end()}; }

  friend bool operator==(const ElementCorners& a, const ElementCorners& b);

 private:
  static constexpr unsigned index_shift = 8;

  [[nodiscard]] Triangle in_run(std::size_t element) const;
  void add_run(const Run& run, std::size_t elements);

  SharedVector<Triangle> own_;
  std::size_t shared_ = 0;  // number of elements that belong to copies
  SharedVector<SharedMesh> meshes_;
  SharedVector<MeshCopy> copies_;
  SharedVector<Run> runs_;                 // empty without copies
  SharedVector<std::uint32_t> run_index_;  // [element >> index_shift]: the run of the first of these elements
};

}  // namespace sunfleck
