#include "devices/tracers/kept_landings.h"

#include "base/error.h"
#include "shared/layout.h"

#include <algorithm>
#include <utility>

namespace sunfleck {
namespace {

constexpr std::uint64_t heap_parts = 8;  // one of them may hold landings

}  // namespace

LandingBuffers::LandingBuffers(const GpuContext& context) : context_(context), spare_(std::make_shared<Spare>()) {}

std::shared_ptr<const LandingsOnDevice> LandingBuffers::take(std::size_t rays) {
  const DeviceLimits& limits = context_.limits();
  const std::size_t bytes = rays * sizeof(shared::Landing);
  if (bytes > limits.max_storage_buffer_bytes || bytes > limits.max_allocation_bytes) return nullptr;
  const std::lock_guard lock(spare_->mutex);
  std::vector<GpuBuffer>& buffers = spare_->buffers;
  const auto fits = std::find_if(buffers.begin(), buffers.end(), [&](const GpuBuffer& one) { return one.bytes >= bytes; });
  if (fits != buffers.end()) {
    GpuBuffer found = std::move(*fits);
    buffers.erase(fits);
    return std::make_shared<LandingsOnDevice>(std::move(found), spare_);
  }
  for (const GpuBuffer& too_small : buffers) spare_->bytes -= too_small.bytes;
  buffers.clear();
  if (spare_->bytes + bytes > limits.heap_bytes / heap_parts) return nullptr;
  try {
    GpuBuffer created = create_buffer(context_, BufferUse::storage, bytes, "landings of beam rays");
    spare_->bytes += created.bytes;
    return std::make_shared<LandingsOnDevice>(std::move(created), spare_);
  } catch (const Error&) {  // the host can keep them, or have some rays traced again
    return nullptr;
  }
}

LandingsOnDevice::LandingsOnDevice(GpuBuffer buffer, std::shared_ptr<LandingBuffers::Spare> spare)
    : buffer_(std::move(buffer)), spare_(std::move(spare)) {}

LandingsOnDevice::~LandingsOnDevice() {
  const std::lock_guard lock(spare_->mutex);
  spare_->buffers.push_back(std::move(buffer_));
}

}  // namespace sunfleck
