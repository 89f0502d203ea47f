// The corners of elements, which copies of a mesh share; see ElementCorners.

ElementRun run_of(uint element) {
  uint low = 0u;
  uint high = pass.runs - 1u;
  while (low < high) {
    uint middle = high - (high - low) / 2u;
    if (runs[middle].first_element <= element) {
      low = middle;
    } else {
      high = middle - 1u;
    }
  }
  return runs[low];
}

Corners corners_of(uint element) {
  if (pass.runs == 0u) return all_corners[element];
  ElementRun run = run_of(element);
  Corners own = all_corners[run.first_corners + (element - run.first_element)];
  if (run.is_copy == 0u) return own;
  return Corners(placed_point(run.turn, own.a), placed_point(run.turn, own.b), placed_point(run.turn, own.c));
}
