#include "physics/bvh/encode.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace sunfleck::detail {
namespace {

std::uint32_t biased_exponent(float value) {
  return (std::bit_cast<std::uint32_t>(value) >> 23U) & 0xffU;
}

// Returns a grid line as a walk may compute it: rounded to single precision or exactly (a double holds it).
float line_float(float origin, float step, int q) {
  return origin + static_cast<float>(q) * step;
}
double line_exact(float origin, float step, int q) {
  return double{origin} + q * double{step};
}

bool line_is_below(float origin, float step, int q, float value) {
  return line_float(origin, step, q) <= value && line_exact(origin, step, q) <= value;
}
bool line_is_above(float origin, float step, int q, float value) {
  return line_float(origin, step, q) >= value && line_exact(origin, step, q) >= value;
}

// Returns the exponent of the smallest power of two of which 255 steps lead from lo to hi or beyond, but no less than the
// spacing of floats there: the coordinates have no finer detail, and an empty slot (lo = 255, hi = 0) stays inverted in a
// box without extent.
std::uint32_t grid_exponent(float lo, float hi) {
  const auto step = static_cast<float>((double{hi} - lo) / 255.0);
  const std::uint32_t spacing = biased_exponent(std::max(std::fabs(lo), std::fabs(hi)));
  std::uint32_t exponent = std::max({biased_exponent(step), spacing > 23 ? spacing - 23 : 0, 1U});
  while (!line_is_above(lo, power_of_two(exponent), 255, hi)) ++exponent;
  return exponent;
}

std::uint8_t quantised_down(float origin, float step, float value) {
  int q = std::min(static_cast<int>((double{value} - origin) / step), 255);
  while (!line_is_below(origin, step, q, value)) --q;
  return static_cast<std::uint8_t>(q);
}

std::uint8_t quantised_up(float origin, float step, float value) {
  int q = std::min(static_cast<int>((double{value} - origin) / step), 255);
  while (!line_is_above(origin, step, q, value)) ++q;
  return static_cast<std::uint8_t>(q);
}

}  // namespace

// Ylitie et al. 2017, section 3.3: the gain of a child in a slot is its distance in the direction of the slot, and the sum
// of gains is maximized. Their auction is replaced by swapping the contents of any two slots as long as that gains: visits
// are within 0.1 % of those after an exact assignment (up to 3.5 % fewer than by taking the greatest gain first), and the
// whole build takes a quarter of the time.
std::array<int, 8> assign_slots(std::span<const Bounds> children) {
  Bounds box = nothing;
  for (const Bounds& child : children) box.grow(child);
  const Float4 middle = box.lo + box.hi;
  std::array<std::array<float, 8>, 8> gains{};  // [child][slot]; the rows of absent children stay 0
  for (std::size_t child = 0; child < children.size(); ++child) {
    const Float4 offset = children[child].lo + children[child].hi - middle;
    for (unsigned slot = 0; slot < 8; ++slot) {
      gains[child][slot] = ((slot & 4U) != 0 ? -offset[0] : offset[0]) + ((slot & 2U) != 0 ? -offset[1] : offset[1]) +
                           ((slot & 1U) != 0 ? -offset[2] : offset[2]);
    }
  }
  std::array<std::size_t, 8> child_in{0, 1, 2, 3, 4, 5, 6, 7};
  constexpr int max_sweeps = 8;  // rounding could make two swaps undo each other forever
  bool swapped = true;
  for (int sweep = 0; swapped && sweep < max_sweeps; ++sweep) {
    swapped = false;
    for (std::size_t s = 0; s < 8; ++s) {
      for (std::size_t t = s + 1; t < 8; ++t) {
        const auto& a = gains[child_in[s]];
        const auto& b = gains[child_in[t]];
        if (!(a[t] + b[s] > a[s] + b[t])) continue;
        std::swap(child_in[s], child_in[t]);
        swapped = true;
      }
    }
  }
  std::array<int, 8> result;
  for (std::size_t slot = 0; slot < 8; ++slot) {
    result[slot] = child_in[slot] < children.size() ? static_cast<int>(child_in[slot]) : -1;
  }
  return result;
}

BvhNode empty_node(std::span<const Bounds> children) {
  Bounds box = nothing;
  for (const Bounds& child : children) box.grow(child);
  BvhNode node{};
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    node.origin[i] = box.lo[axis];
    node.exponent[i] = static_cast<std::uint8_t>(grid_exponent(box.lo[axis], box.hi[axis]));
  }
  for (auto* lines : {&node.lo_x, &node.lo_y, &node.lo_z}) lines->fill(255);
  return node;
}

void set_box(BvhNode& node, std::size_t slot, const Bounds& box) {
  const std::array lo = {&node.lo_x, &node.lo_y, &node.lo_z};
  const std::array hi = {&node.hi_x, &node.hi_y, &node.hi_z};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const float step = power_of_two(node.exponent[axis]);
    (*lo[axis])[slot] = quantised_down(node.origin[axis], step, box.lo[static_cast<int>(axis)]);
    (*hi[axis])[slot] = quantised_up(node.origin[axis], step, box.hi[static_cast<int>(axis)]);
  }
}

}  // namespace sunfleck::detail
