#pragma once
// Comparison of what the shared text gives on a device and in C++.

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace sunfleck {

// Counts the words in which results differ, and reports the first ones.
class WordComparison {
 public:
  // `batch` and `input` say where the results belong.
  template <class Result>
  void add(const Result& ours, const Result& theirs, int batch, std::size_t input) {
    using Words = std::array<std::uint32_t, sizeof(Result) / sizeof(std::uint32_t)>;
    const auto our_words = std::bit_cast<Words>(ours);
    const auto their_words = std::bit_cast<Words>(theirs);
    for (std::size_t word = 0; word < our_words.size(); ++word) {
      if (our_words[word] == their_words[word]) continue;
      if (++differences_ <= most_reported)
        ADD_FAILURE() << "input " << input << " of batch " << batch << ", word " << word << ": " << our_words[word] << " and "
                      << their_words[word];
    }
  }

  [[nodiscard]] std::size_t differences() const { return differences_; }

 private:
  static constexpr std::size_t most_reported = 5;

  std::size_t differences_ = 0;
};

}  // namespace sunfleck
