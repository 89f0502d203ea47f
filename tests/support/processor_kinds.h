#pragma once
// Runs code as on each kind of processor, from the plainest to this machine's, for which the walks of the CPU path were compiled.

#include <gtest/gtest.h>

#include <hwy/highway.h>
#include <hwy/targets.h>
#include <cstdint>

namespace sunfleck::test {

// While it exists, code that is compiled for several kinds of processor runs as on `target`, one of Highway's bits.
class AsOnProcessor {
 public:
  explicit AsOnProcessor(std::int64_t target) { choose(target); }
  ~AsOnProcessor() { choose(0); }
  AsOnProcessor(const AsOnProcessor&) = delete;
  AsOnProcessor& operator=(const AsOnProcessor&) = delete;

 private:
  // Zero stands for what the machine has.
  static void choose(std::int64_t target) {
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  }
};

// Calls `test` once for each kind that this machine can be.
template <class Test>
void for_each_processor_kind(const Test& test) {
  const auto kinds = hwy::SupportedAndGeneratedTargets();
#if HWY_ARCH_X86
  EXPECT_GT(kinds.size(), 1U) << "x86-64 processors have had SSSE3 since 2006";
#endif
  for (const std::int64_t kind : kinds) {
    const testing::ScopedTrace trace(__FILE__, __LINE__, hwy::TargetName(kind));
    const AsOnProcessor as_on(kind);
    ASSERT_EQ(hwy::SupportedTargets(), kind);
    test();
  }
}

}  // namespace sunfleck::test
