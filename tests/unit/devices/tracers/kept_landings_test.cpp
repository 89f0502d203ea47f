// Tests the pool of buffers for landings that a device keeps.
#include "devices/tracers/kept_landings.h"
#include "shared/layout.h"
#include "support/device.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <vector>

namespace sunfleck {
namespace {

class LandingBuffersTest : public DeviceTest {};

TEST_F(LandingBuffersTest, AreUsedAgain) {
  LandingBuffers pool(context());
  auto first = pool.take(100);
  ASSERT_NE(first, nullptr);
  EXPECT_GE(first->buffer().bytes, 100 * sizeof(shared::Landing));
  const auto* const handles = first->buffer().handles.get();
  const auto second = pool.take(50);
  EXPECT_NE(second->buffer().handles.get(), handles) << "the first one is in use";
  first.reset();
  first = pool.take(80);
  EXPECT_EQ(first->buffer().handles.get(), handles);
  EXPECT_FALSE(pool.free_unused()) << "both are in use";
  first.reset();
  EXPECT_TRUE(pool.free_unused());
}

TEST_F(LandingBuffersTest, TakeAnEighthOfTheMemoryAtMost) {
  const DeviceLimits& limits = context().limits();
  LandingBuffers pool(context());
  EXPECT_EQ(pool.take(limits.max_storage_buffer_bytes / sizeof(shared::Landing) + 1), nullptr);
  const std::size_t most = limits.heap_bytes / 8;
  const std::size_t rays = std::min<std::size_t>(limits.max_storage_buffer_bytes, most) / sizeof(shared::Landing);
  const std::size_t fit = most / (rays * sizeof(shared::Landing));
  std::vector<std::shared_ptr<const LandingsOnDevice>> taken;
  for (std::size_t k = 0; k < fit && k < 4; ++k) {
    taken.push_back(pool.take(rays));
    EXPECT_NE(taken.back(), nullptr) << k;
  }
  if (fit <= 4) {  // other devices have more memory than a test should fill
    EXPECT_EQ(pool.take(rays), nullptr);
  }
  taken.clear();
  EXPECT_NE(pool.take(rays), nullptr);
}

// A replicate may end on any thread, and after its tracer.
TEST_F(LandingBuffersTest, MayOutliveThePool) {
  std::shared_ptr<const LandingsOnDevice> taken;
  {
    LandingBuffers pool(context());
    taken = pool.take(10);
  }
  EXPECT_NE(taken->buffer().handles, nullptr);
}

}  // namespace
}  // namespace sunfleck
