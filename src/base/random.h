#pragma once
// A stream of random numbers that is the same on every machine and with every standard library.

#include <cstdint>
#include <glm/vec2.hpp>

namespace sunfleck {

// SplitMix64 (Steele, Lea & Flood 2014, OOPSLA, fig. 13).
class RandomStream {
 public:
  // Streams with different numbers are independent.
  RandomStream(std::uint64_t seed, std::uint64_t stream) : state_(mixed(mixed(seed) + stream)) {}

  std::uint64_t word() { return mixed(state_ += increment); }

  // Returns a number that is uniform over [0, 1), with 53 bits.
  double unit() { return static_cast<double>(word() >> 11) * 0x1p-53; }

 private:
  static constexpr std::uint64_t increment = 0x9e3779b97f4a7c15;

  static std::uint64_t mixed(std::uint64_t z) {
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
    z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
    return z ^ (z >> 31);
  }

  std::uint64_t state_;
};

// Returns the key of the shared text's random numbers (shaders/shared/random.h) that a random word makes.
[[nodiscard]] inline glm::uvec2 key_of(std::uint64_t word) {
  return {static_cast<std::uint32_t>(word), static_cast<std::uint32_t>(word >> 32U)};
}

}  // namespace sunfleck
