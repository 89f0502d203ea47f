#version 460
#extension GL_GOOGLE_include_directive : require
// Ends the round before: what no packet took along stays. Retires faint columns, and begins a round if any column is left. Each
// thread of one group takes some columns.

#include "pass.glsl"

#include "shared/random.h"

shared uint any_active;
shared uint any_least;

// Counts what packets took along from a stack.
uint64_t count_taken(PlaneStack stack, uint column) {
  uint64_t taken = uint64_t(0u);
  for (uint place = 0u; place < stack.places; ++place) {
    uint word = word_of_place(stack, place_taken, place, column);
    taken += totals[word];
    totals[moved_word(stack, place, column)] += totals[word];
    totals[word] = uint64_t(0u);
  }
  return taken;
}

// Lets what packets did not take along wait at a place.
void keep(PlaneStack stack, uint column, uint place, uint64_t kept) {
  totals[word_of_place(stack, place_waiting, place, column)] += kept;
  totals[moved_word(stack, place, column)] += kept;
}

void end_round(uint column) {
  uint64_t kept = columns[column].waited - count_taken(stack_of_layers(pass), column);
  keep(stack_of_layers(pass), column, columns[column].lowest, kept);
  if (pass.planes == 0u) return;
  count_taken(stack_of_receivers(pass), column);
  keep(stack_of_receivers(pass), column, columns[column].lowest_zone, kept);
}

uint64_t waiting_of(uint column) {
  PlaneStack layers = stack_of_layers(pass);
  uint64_t sum = uint64_t(0u);
  for (uint place = 0u; place < layers.places; ++place) sum += totals[word_of_place(layers, place_waiting, place, column)];
  return sum;
}

void drop_waiting(PlaneStack stack, uint column) {
  for (uint place = 0u; place < stack.places; ++place) totals[word_of_place(stack, place_waiting, place, column)] = uint64_t(0u);
}

uint64_t larger_of(uint64_t a, uint64_t b) { return a > b ? a : b; }

// Returns whether too little waits to matter.
bool is_faint(uint column, uint64_t waiting) {
  uint64_t vegetation = larger_of(columns[column].least_of_vegetation, totals[sum_vegetation * pass.columns + column]);
  uint64_t least = part_of(columns[column].incident, pass.least_judged, 0u);
  uint64_t soil = larger_of(least, totals[sum_soil * pass.columns + column]);
  return waiting == uint64_t(0u) || waiting < part_of(vegetation < soil ? vegetation : soil, pass.unshot_part, 0u);
}

void set_scales(uint column, uint64_t total) {
  uint64_t all = larger_of(columns[column].start, total);
  uint64_t wanted = long_quotient(product_high(pass.each, total), pass.each * total, all);
  columns[column].wanted = scale_of(wanted, total);
  columns[column].least = Scale(0u, 0u);
  if (wanted >= least_of_column) return;
  columns[column].least = scale_of(least_of_column, total);
  any_least = 1u;
}

void begin_column(uint column) {
  if (state.rounds > 0u) end_round(column);
  uint64_t waiting = waiting_of(column);
  if (columns[column].is_active != 0u && is_faint(column, waiting)) {
    columns[column].is_active = 0u;
    columns[column].unshot += waiting;
    drop_waiting(stack_of_layers(pass), column);
    drop_waiting(stack_of_receivers(pass), column);
    waiting = uint64_t(0u);
  }
  columns[column].total = waiting;
  columns[column].wanted = Scale(0u, 0u);
  columns[column].least = Scale(0u, 0u);
  if (waiting > uint64_t(0u)) set_scales(column, waiting);
  if (columns[column].is_active != 0u) any_active = 1u;
}

uint64_t parts_each(uint parts, uint count) { return (uint64_t(parts) << 32u) / uint64_t(count > 0u ? count : 1u); }

void set_groups_of_places() {
  set_groups(groups_of_places, state.places, round_group_size);
  set_groups(groups_of_run_sums, run_count() * place_parts, numbers_per_block);
  set_groups(groups_of_sides, side_count(), round_group_size);
  set_groups(groups_of_side_sums, side_count(), numbers_per_block);
}

void begin_round() {
  uint kept_word = small_rows(pass) * pass.columns;
  uint kept = uint(totals[kept_word]);
  totals[kept_word] = uint64_t(0u);
  if (state.rounds == 0u) state.first_places = kept;
  if (state.rounds > 0u && kept > state.most_places) state.most_places = kept;
  state.done = any_active != 0u && state.rounds < pass.most_rounds ? 0u : 1u;
  if (state.rounds > 0u) state.places = state.packets;
  state.packets = 0u;
  if (state.done != 0u) return;
  ++state.rounds;
  set_groups_of_places();
  uvec4 words = random_words(pass.key, word_of_offset, state.rounds);
  state.offset = uint64_t(words.y) << 32u | uint64_t(words.x);
  state.parts_of_elements = parts_each(element_parts, state.end_of_elements);
  state.parts_of_ground = parts_each(ground_parts, state.end_of_cells);
  state.end_of_elements = 0u;
  state.end_of_cells = 0u;
  state.any_least = any_least;
}

void main() {
  uint thread = gl_LocalInvocationID.x;
  if (thread == 0u) {
    any_active = 0u;
    any_least = 0u;
    state.has_to_wait = paused_packets > 0u ? 1u : 0u;  // has_to_wait may not be visible to the other threads yet
    for (uint kind = 0u; kind < kinds_of_groups; ++kind) {
      groups[kind * 3u] = 0u;
      groups[kind * 3u + 1u] = 1u;
      groups[kind * 3u + 2u] = 1u;
    }
  }
  barrier();
  if (paused_packets > 0u || state.done != 0u) return;
  for (uint column = thread; column < pass.columns; column += round_group_size) begin_column(column);
  barrier();
  if (thread == 0u) begin_round();
}
