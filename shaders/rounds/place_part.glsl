// Returns the part to which a place belongs; see WaitingFlux::take_sorted.
uint part_of_place(uint order) {
  if (order < ground_order) return place_part(order, state.parts_of_elements);
  return element_parts + place_part(order - ground_order, state.parts_of_ground);
}
