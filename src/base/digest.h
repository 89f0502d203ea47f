#pragma once
// A short fingerprint of data.

#include <fmt/format.h>

#include <cstdint>
#include <string>
#include <string_view>

namespace sunfleck {

// The 64-bit FNV-1a hash (Fowler, Noll and Vo).
class Digest {
 public:
  void add(std::string_view bytes) {
    for (const char c : bytes) state_ = (state_ ^ static_cast<unsigned char>(c)) * 0x100000001b3ULL;
  }
  // Returns 16 hexadecimal digits.
  [[nodiscard]] std::string text() const { return fmt::format("{:016x}", state_); }

 private:
  std::uint64_t state_ = 0xcbf29ce484222325ULL;
};

}  // namespace sunfleck
