#pragma once
// The readers of users' files, each as a function that accepts any bytes. libFuzzer and the test that replays the corpus call
// them.

#include <span>
#include <string_view>

namespace sunfleck::fuzz {

struct Target {
  std::string_view name;  // name of its folder in the corpus
  // Reads the bytes as a file of this kind. Returns if they are accepted, or refused with one line in three parts; accepted
  // data must keep the reader's promises. Anything else ends the process or escapes as an exception.
  void (*feed)(std::string_view bytes);
};

[[nodiscard]] std::span<const Target> targets();

}  // namespace sunfleck::fuzz
