#pragma once
// Where the rays of beams landed, in buffers of a device.

#include "devices/gpu/buffer.h"
#include "devices/gpu/context.h"
#include "physics/transport/model/tracer.h"

#include <cstddef>
#include <memory>
#include <mutex>
#include <vector>

namespace sunfleck {

// Buffers that are used again: a replicate takes one for its beam, and another takes it afterwards. Any thread may let go of one.
class LandingBuffers {
 public:
  // The context must outlive the object and all that it gives.
  explicit LandingBuffers(const GpuContext& context);

  // Returns room for where so many rays landed; null if it is larger than the device allows, or memory is short. All together take an
  // eighth of the device's memory at most. Only the thread that uses the device may call this.
  [[nodiscard]] std::shared_ptr<const class LandingsOnDevice> take(std::size_t rays);

 private:
  friend class LandingsOnDevice;
  struct Spare {
    std::mutex mutex;
    std::vector<GpuBuffer> buffers;  // that nobody uses
    std::size_t bytes = 0;           // of all buffers, in use or not
  };

  const GpuContext& context_;
  std::shared_ptr<Spare> spare_;
};

class LandingsOnDevice final : public KeptLandings {
 public:
  LandingsOnDevice(GpuBuffer buffer, std::shared_ptr<LandingBuffers::Spare> spare);
  ~LandingsOnDevice() override;  // gives the buffer back

  [[nodiscard]] const GpuBuffer& buffer() const { return buffer_; }  // shared::Landing, [ray]

 private:
  GpuBuffer buffer_;
  std::shared_ptr<LandingBuffers::Spare> spare_;
};

}  // namespace sunfleck
