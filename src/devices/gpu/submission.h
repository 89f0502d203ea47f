#pragma once
// Work that is given to a device together.

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "devices/gpu/buffer.h"
#include "devices/gpu/compute.h"
#include "devices/gpu/context.h"

namespace sunfleck {

// Copies, fills and dispatches, each of which sees what those before it wrote. They are submitted together by finish(), or
// earlier where the staging memory is full.
// A context has at most one submission at a time. All buffers and pipelines must live until finish() returns; one that is not
// finished is dropped.
class Submission {
 public:
  // The context must outlive the submission.
  explicit Submission(const GpuContext& context) : context_(context) {}
  ~Submission();
  Submission(const Submission&) = delete;
  Submission& operator=(const Submission&) = delete;

  // While it lives, commands need not wait for each other, but only for those before it: none may write what another one reads
  // or writes. So small dispatches share a device that each of them would leave idle.
  class SideBySide {
   public:
    explicit SideBySide(Submission& submission);
    ~SideBySide();
    SideBySide(const SideBySide&) = delete;
    SideBySide& operator=(const SideBySide&) = delete;

   private:
    Submission& submission_;
  };

  // Copies data to a buffer; they may change as soon as this returns. offset + size <= bytes.
  void upload(const GpuBuffer& buffer, std::span<const std::byte> data, std::size_t offset = 0);

  // Sets every 32-bit word of a buffer to `word`.
  void fill(const GpuBuffer& buffer, std::uint32_t word);

  // Runs at least `threads` invocations, as ComputePipeline::run() does.
  void run(ComputePipeline& pipeline, std::uint64_t threads, std::span<const std::byte> push,
           std::span<const GpuBuffer* const> buffers);

  // Does the same with as many groups as three words of a buffer say from an offset in bytes on, a multiple of 4: their numbers
  // along x, y and z, as earlier commands leave them. Along x they may have max_threads() at most.
  void run(ComputePipeline& pipeline, const GpuBuffer& groups, std::size_t offset, std::span<const std::byte> push,
           std::span<const GpuBuffer* const> buffers);

  // Copies a buffer to `data`, which must live until finish() returns and are complete then. offset + size <= bytes.
  void download(const GpuBuffer& buffer, std::span<std::byte> data, std::size_t offset = 0);

  // Submits what is left and waits. Throws Error (failure) if the device is lost.
  void finish();

 private:
  struct Delivery {
    std::span<std::byte> to;
    std::size_t staged_at;
  };

  // Checks what a pipeline needs and returns the number under which it is bound.
  std::size_t bind(ComputePipeline& pipeline, std::uint64_t threads, std::span<const std::byte> push,
                   std::span<const GpuBuffer* const> buffers);
  // Begins the next command, which sees what those before it wrote, but for those to its side.
  void begin_command();
  // Returns where the next bytes of at most `wanted` are staged, and how many of them.
  std::span<std::byte> stage(std::size_t wanted);
  [[nodiscard]] std::size_t staged_at(std::span<const std::byte> piece) const;

  const GpuContext& context_;
  bool begun_ = false;
  bool is_side_by_side_ = false;
  bool has_waited_ = false;  // the first one of several side by side has waited for those before
  std::size_t staged_ = 0;   // bytes of the staging memory in use
  std::vector<Delivery> deliveries_;
  // The pipelines that run in the commands so far, each with the buffers of its bindings.
  std::map<const ComputePipeline*, std::vector<std::vector<const GpuBuffer*>>> pipelines_;
};

}  // namespace sunfleck
