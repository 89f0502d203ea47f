#pragma once
// Registers the groups of measurements, which main.cpp describes. Without `context`, which must outlive the run, measurements
// that need a Vulkan device are left out.

#include "devices/gpu/context.h"

namespace sunfleck::bench {

void register_tracing(const GpuContext* context);
void register_growth(const GpuContext* context);
void register_copies(const GpuContext* context);
void register_builds();
void register_safeguards(const GpuContext* context);
void register_features(const GpuContext* context);
void register_device(const GpuContext* context);
void register_rounds(const GpuContext* context);

}  // namespace sunfleck::bench
