// Passes libFuzzer's inputs to the target SUNFLECK_FUZZ_TARGET.

#include "base/log.h"
#include "fuzz/targets.h"

#include <cstddef>
#include <cstdint>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const auto* target = [] {
    sunfleck::start_log(sunfleck::Verbosity::quiet);
    const sunfleck::fuzz::Target* found = nullptr;
    for (const sunfleck::fuzz::Target& each : sunfleck::fuzz::targets())
      if (each.name == SUNFLECK_FUZZ_TARGET) found = &each;
    return found;
  }();
  target->feed({reinterpret_cast<const char*>(data), size});
  return 0;
}
