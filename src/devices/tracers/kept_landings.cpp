#include "devices/tracers/kept_landings.h"

#include "base/error.h"
#include "shared/layout.h"

#include <algorithm>
#include <utility>

namespace sunfleck {
namespace {

constexpr std::uint64_t heap_parts = 8;  // landings may take one of these

}  // namespace

LandingBuffers::LandingBuffers(const GpuContext& context) : context_(context), pool_(std::make_shared<Pool>()) {}

std::shared_ptr<const LandingsOnDevice> LandingBuffers::take(std::size_t rays) {
  const DeviceLimits& limits = context_.limits();
  const std::size_t bytes = rays * sizeof(shared::Landing);
  if (bytes > limits.max_storage_buffer_bytes || bytes > limits.max_allocation_bytes) return nullptr;
  const std::lock_guard lock(pool_->mutex);
  std::vector<GpuBuffer>& unused = pool_->unused;
  const auto fits = std::find_if(unused.begin(), unused.end(), [&](const GpuBuffer& one) { return one.bytes >= bytes; });
  if (fits != unused.end()) {
    GpuBuffer found = std::move(*fits);
    unused.erase(fits);
    return std::make_shared<LandingsOnDevice>(std::move(found), pool_);
  }
  pool_->free_unused();  // they are too small
  if (pool_->bytes + bytes > limits.heap_bytes / heap_parts) return nullptr;
  try {
    GpuBuffer created = create_buffer(context_, BufferUse::storage, bytes, "landings of beam rays");
    unused.reserve(++pool_->buffers);  // so that giving back cannot fail
    pool_->bytes += created.bytes;
    return std::make_shared<LandingsOnDevice>(std::move(created), pool_);
  } catch (const Error&) {  // the host can keep the landings, or have some rays traced again
    return nullptr;
  }
}

bool LandingBuffers::free_unused() {
  const std::lock_guard lock(pool_->mutex);
  return pool_->free_unused();
}

bool LandingBuffers::Pool::free_unused() {
  const bool any = !unused.empty();
  for (const GpuBuffer& buffer : unused) bytes -= buffer.bytes;
  buffers -= unused.size();
  unused.clear();
  return any;
}

LandingsOnDevice::LandingsOnDevice(GpuBuffer buffer, std::shared_ptr<LandingBuffers::Pool> pool)
    : buffer_(std::move(buffer)), pool_(std::move(pool)) {}

LandingsOnDevice::~LandingsOnDevice() {
  const std::lock_guard lock(pool_->mutex);
  pool_->unused.push_back(std::move(buffer_));
}

}  // namespace sunfleck
