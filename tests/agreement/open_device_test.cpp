// Tests which device a name on the command line stands for. It is no unit test: drivers leak in the sanitizers' eyes.
#include "devices/tracers/engine.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace sunfleck {
namespace {

TEST(OpenDevice, AutoIsAGpuOrTheCpuPathAndNeverSoftwareVulkan) {
  const auto devices = list_devices();
  const bool any_gpu = std::any_of(devices.begin(), devices.end(),
                                   [](const auto& device) { return !device.software && device.unusable.empty(); });
  const auto context = open_device({"auto"});
  ASSERT_EQ(context != nullptr, any_gpu);
  if (context) {
    EXPECT_FALSE(context->description().software);
  }
}

TEST(OpenDevice, CpuIsNoVulkanDevice) {
  EXPECT_EQ(open_device({"cpu"}), nullptr);
}

TEST(OpenDevice, SoftwareVulkanIsOpenedByKindNameAndNumber) {
  const auto devices = list_devices();
  const auto software = std::find_if(devices.begin(), devices.end(),
                                     [](const auto& device) { return device.software && device.unusable.empty(); });
  if (software == devices.end()) GTEST_SKIP() << "no software Vulkan device on this machine";
  for (const std::string& name : {std::string("lavapipe"), software->name, std::to_string(software - devices.begin())}) {
    const auto context = open_device({name});
    ASSERT_NE(context, nullptr) << name;
    EXPECT_TRUE(context->description().software) << name;
    EXPECT_EQ(context->description().name, software->name);
  }
}

}  // namespace
}  // namespace sunfleck
