#version 460
#extension GL_GOOGLE_include_directive : require
// Finds what a unit of weight carries of each column, retires columns that no packet carries, and takes what waits off its
// places. Each thread of one group takes some columns.

#include "pass.glsl"

// Takes what waits off the places of a stack; of a retired column it stays where it is. Returns the lowest place where any waited.
uint take_off(PlaneStack stack, uint column, bool retired) {
  uint lowest = 0u;
  for (uint k = stack.places; k > 0u; --k) {
    uint word = word_of_place(stack, place_waiting, k - 1u, column);
    uint64_t waiting = retired ? uint64_t(0u) : totals[word];
    if (waiting > uint64_t(0u)) lowest = k - 1u;
    totals[moved_word(stack, k - 1u, column)] -= waiting;
    totals[word] = uint64_t(0u);
  }
  return lowest;
}

void load_column(uint column) {
  uint weight_word = sum_weights * pass.columns + column;
  Load load = load_of(columns[column].total, totals[weight_word]);
  totals[weight_word] = uint64_t(0u);
  columns[column].load_factor = load.factor;
  columns[column].load_shift = load.shift;
  bool retired = columns[column].is_active != 0u && load.factor == uint64_t(0u);
  if (retired) {
    columns[column].is_active = 0u;
    columns[column].unshot += columns[column].total;
    columns[column].total = uint64_t(0u);
  }
  columns[column].waited = columns[column].total;
  columns[column].lowest = take_off(stack_of_layers(pass), column, retired);
  columns[column].lowest_zone = take_off(stack_of_receivers(pass), column, retired);
}

void main() {
  if (is_at_rest()) return;
  if (gl_LocalInvocationID.x == 0u) paused_packets = 0u;
  for (uint column = gl_LocalInvocationID.x; column < pass.columns; column += round_group_size) load_column(column);
}
