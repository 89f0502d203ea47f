#version 460
#extension GL_GOOGLE_include_directive : require
// Divides the expectation of each packet's side among its columns, and sets the packet's number to 2 * place + side. Each thread
// takes a packet.

#include "pass.glsl"

bool is_from(uint packet, uint side) { return drawn_before(side) <= uint64_t(packet) && uint64_t(packet) < drawn_before(side + 1u); }

// Returns the side from which a packet is drawn. A side with very many packets has numbered only the first ones.
uint find_side(uint packet) {
  uint number = numbers[packet];
  if (number < side_count() && is_from(packet, number)) return number;
  uint low = 0u;
  uint high = side_count() - 1u;
  while (low < high) {
    uint middle = low + (high - low) / 2u;
    if (drawn_before(middle + 1u) <= uint64_t(packet)) {
      low = middle + 1u;
    } else {
      high = middle;
    }
  }
  return low;
}

void main() {
  if (gl_GlobalInvocationID.x >= state.packets) return;
  uint packet = gl_GlobalInvocationID.x;
  uint number = find_side(packet);
  Side side = side_of(number);
  numbers[packet] = side.place * 2u + side.side;
  Sent sent = sent_from(side);
  Sharing sharing = sharing_of(sums[number] - sum_before(number), pass.stand.radius > 0.0 ? least_aim_bits : 0u);
  uint copy = own_copy();
  for (uint c = 0u; c < pass.columns; ++c) {
    uint64_t landed = quanta[side.place * pass.columns + c];
    uint weight = share_of(scaled(quanta_sent(landed, sent, c), columns[c].wanted), sharing);
    weights[packet * pass.columns + c] = weight;
    if (weight != 0u) add_to_row(copy, sum_weights, c, uint64_t(weight));
  }
}
