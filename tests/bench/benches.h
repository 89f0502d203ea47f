#pragma once
// The groups of measurements; main.cpp tells what they are. `context`: none leaves out what needs a Vulkan device, and must
// outlive the run.

#include "gpu/context.h"

namespace sunfleck::bench {

void register_tracing(const GpuContext* context);
void register_growth(const GpuContext* context);
void register_builds();
void register_safeguards(const GpuContext* context);
void register_features(const GpuContext* context);
void register_device(const GpuContext* context);

}  // namespace sunfleck::bench
