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

class LandingsOnDevice;

// A pool of buffers: a replicate takes one for its beam, and gives it back for a later replicate. Any thread may give one back;
// only the thread that uses the device may call the functions.
class LandingBuffers {
 public:
  // The context must outlive the pool and all that is taken from it.
  explicit LandingBuffers(const GpuContext& context);

  // Returns room for where this many rays landed; null if it is larger than the device allows, or if memory is short. All buffers
  // together take at most an eighth of the device's memory.
  [[nodiscard]] std::shared_ptr<const LandingsOnDevice> take(std::size_t rays);

  // Frees the buffers that nobody uses. Returns whether there were any.
  bool free_unused();

 private:
  friend class LandingsOnDevice;
  struct Pool {
    std::mutex mutex;
    std::vector<GpuBuffer> unused;
    std::size_t buffers = 0, bytes = 0;  // of all, in use or not

    bool free_unused();  // the mutex must be locked
  };

  const GpuContext& context_;
  std::shared_ptr<Pool> pool_;
};

class LandingsOnDevice final : public KeptLandings {
 public:
  LandingsOnDevice(GpuBuffer buffer, std::shared_ptr<LandingBuffers::Pool> pool);
  ~LandingsOnDevice() override;  // gives the buffer back

  [[nodiscard]] const GpuBuffer& buffer() const { return buffer_; }  // shared::Landing, [ray]

 private:
  GpuBuffer buffer_;
  std::shared_ptr<LandingBuffers::Pool> pool_;
};

}  // namespace sunfleck
