// Replays the fuzzers' corpus: inputs that once stopped a fuzzer, and the smallest files that together reach the same code.

#include "base/log.h"
#include "fuzz/targets.h"
#include "support/content.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

namespace sunfleck::fuzz {
namespace {

class Corpus : public ::testing::TestWithParam<Target> {};

TEST_P(Corpus, IsReadOrRefused) {
  start_log(Verbosity::quiet);
  const std::filesystem::path folder = std::filesystem::path(SUNFLECK_FUZZ_CORPUS) / GetParam().name;
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  EXPECT_FALSE(files.empty());
  for (const std::filesystem::path& file : files) {
    SCOPED_TRACE(file);
    EXPECT_NO_THROW(GetParam().feed(test::content(file)));
  }
}

INSTANTIATE_TEST_SUITE_P(Fuzz, Corpus, ::testing::ValuesIn(targets().begin(), targets().end()),
                         [](const auto& target) { return std::string(target.param.name); });

}  // namespace
}  // namespace sunfleck::fuzz
