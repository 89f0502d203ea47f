// Returns the sum of what all earlier threads of the group have. All threads of the group call it.
shared uint64_t of_threads[round_group_size];

uint64_t sum_of_earlier_threads(uint64_t own) {
  of_threads[gl_LocalInvocationID.x] = own;
  barrier();
  uint64_t before = uint64_t(0u);
  for (uint k = 0u; k < gl_LocalInvocationID.x; ++k) before += of_threads[k];
  return before;
}
