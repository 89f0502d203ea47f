#pragma once
// A compute shader that is dispatched by number of threads.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "devices/gpu/buffer.h"
#include "devices/gpu/context.h"

namespace sunfleck {

// A shader as embedded in the program: SPIR-V words and the shape of its interface, against which every run is checked.
// Bindings are in set 0, numbered 0..bindings.size()-1.
struct ShaderCode {
  const char* name = "";
  std::span<const std::uint32_t> spirv;
  std::vector<BufferUse> bindings;  // [binding], at least one
  std::uint32_t push_bytes = 0;     // <= 128, a multiple of 4
  std::uint32_t group_size = 64;    // threads per group, <= 128
};

// Values of the specialisation constants 0..n-1, 32 bits each.
using Specialisation = std::vector<std::uint32_t>;

class ComputePipeline {
 public:
  // `context` must outlive the pipeline. Throws Error (failure) naming the shader if the driver cannot build it.
  ComputePipeline(const GpuContext& context, const ShaderCode& code, const Specialisation& constants);

  // Runs at least `threads` invocations (rounded up to whole groups; the shader must discard the surplus) and waits. The
  // buffers are in binding order and must have the uses that the shader declares; `push` must have its size. Writes of earlier
  // dispatches, uploads and fills are visible. `threads` may be 0 and may not exceed max_threads().
  void run(std::uint64_t threads, std::span<const std::byte> push, std::span<const GpuBuffer* const> buffers);

  // Returns the largest number of threads of one run: the device's limit, and no more than gl_GlobalInvocationID.x can number.
  [[nodiscard]] std::uint64_t max_threads() const;

 private:
  friend class Submission;
  struct Handles;  // devices/gpu/handles.h
  struct Destroy {
    void operator()(Handles* handles) const noexcept;
  };

  void create_layouts();
  void create_pipeline(const Specialisation& constants);
  // Checks the arguments of a run.
  void check(std::uint64_t threads, std::span<const std::byte> push, std::span<const GpuBuffer* const> buffers) const;
  void add_binding();
  // Binds the buffers of runs under a number, at most the number of bindings so far; none of the commands recorded so far may
  // use it.
  void bind(std::size_t binding, std::span<const GpuBuffer* const> buffers);
  // Record a dispatch of at least one thread, or of groups that a buffer holds.
  void record(std::size_t binding, std::uint64_t threads, std::span<const std::byte> push) const;
  void record(std::size_t binding, const GpuBuffer& groups, std::size_t offset, std::span<const std::byte> push) const;
  void record_binding(std::size_t binding, std::span<const std::byte> push) const;

  const GpuContext& context_;
  ShaderCode code_;
  std::unique_ptr<Handles, Destroy> handles_;
};

}  // namespace sunfleck
