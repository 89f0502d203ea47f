#pragma once
// The readers of users' files, each as a function that is fed any bytes: by libFuzzer, and by the test that replays the corpus.

#include <span>
#include <string_view>

namespace sunfleck::fuzz {

struct Target {
  std::string_view name;  // of its folder in the corpus
  // Reads the bytes as such a file. Returns if they are read, or refused with one line in three parts; what was read must keep
  // the reader's promises. Anything else ends the process or leaves as an exception.
  void (*feed)(std::string_view bytes);
};

[[nodiscard]] std::span<const Target> targets();

}  // namespace sunfleck::fuzz
