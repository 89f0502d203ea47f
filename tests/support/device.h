#pragma once
// Provides a Vulkan device for tests. Without a device they are skipped and say so, or fail if SUNFLECK_REQUIRE_DEVICE=1 is
// set. SUNFLECK_TEST_DEVICE chooses a device by a part of its name; by default it is the software device, or hardware if there
// is none. SUNFLECK_THOROUGH_VALIDATION=1 adds the checks of Validation::thorough.

#include <gtest/gtest.h>

#include <cstdlib>
#include <memory>
#include <string>

#include "devices/gpu/context.h"

namespace sunfleck {

// Runs with validation wherever the layer is installed; a validation message fails the test that caused it.
class DeviceTest : public testing::Test {
 protected:
  void SetUp() override {
    if (!list_devices().empty()) {
      const Validation wanted = is_set("SUNFLECK_THOROUGH_VALIDATION") ? Validation::thorough : Validation::on;
      context_ = std::make_unique<GpuContext>(selector(), validation_installed() ? wanted : Validation::off);
    } else if (is_set("SUNFLECK_REQUIRE_DEVICE")) {
      FAIL() << "no Vulkan device, and SUNFLECK_REQUIRE_DEVICE=1 asks for one";
    } else {
      GTEST_SKIP() << "no Vulkan device on this machine";
    }
  }

  void TearDown() override {
    if (!context_) return;
    for (const auto& message : context_->validation_messages()) ADD_FAILURE() << message;
  }

  [[nodiscard]] const GpuContext& context() const { return *context_; }

 private:
  static bool is_set(const char* variable) {
    const char* value = std::getenv(variable);
    return value != nullptr && std::string(value) == "1";
  }

  static DeviceSelector selector() {
    DeviceSelector result;
    if (const char* name = std::getenv("SUNFLECK_TEST_DEVICE")) {
      result.kind = DeviceSelector::Kind::name;
      result.name = name;
      return result;
    }
    for (const auto& device : list_devices()) {
      if (device.software) result.kind = DeviceSelector::Kind::software;
    }
    return result;
  }

  std::unique_ptr<GpuContext> context_;
};

}  // namespace sunfleck
