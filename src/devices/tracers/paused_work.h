#pragma once
// Rays or packets on the device that may need several dispatches.

#include "base/stopwatch.h"
#include "devices/gpu/buffer.h"
#include "devices/gpu/compute.h"
#include "devices/gpu/context.h"
#include "devices/gpu/submission.h"
#include "devices/tracers/dispatch_budget.h"
#include "devices/tracers/gpu_tree.h"
#include "devices/tracers/trace_domain.h"
#include "devices/tracers/vulkan_choices.h"
#include "physics/transport/model/tracer.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace sunfleck {

// A shader with two variants; its bindings are the tree, `buffers` storage buffers, and the paused rays before and after.
struct WorkShader {
  const char* name = "";
  std::span<const std::uint32_t> with_texel_buffers, with_storage_buffers;
  std::size_t buffers = 0;
};

// Rays that do not end within the steps of a dispatch pause, and the next dispatch resumes them. `Paused` describes such a ray
// or packet, and `Push` what a dispatch has to do.
template <class Paused, class Push>
class PausedWork {
 public:
  // Context and tree must outlive the object; the choices are complete. `what` names the paused rays in messages.
  PausedWork(const GpuContext& context, const GpuTree& tree, TraceDomain domain, const VulkanChoices& choices,
             const WorkShader& shader, const char* what)
      : context_(context),
        tree_(tree),
        budget_(choices.rays_per_dispatch, choices.seconds_per_dispatch),
        inbox_(create_buffer(context, BufferUse::storage, outbox_bytes(choices.rays_per_dispatch), what)),
        outbox_(create_buffer(context, BufferUse::storage, inbox_.bytes, what)),
        pipeline_(context, code_of(shader, tree, choices.group_size),
                  {domain.periodic ? 1U : 0U, domain.has_soil ? 1U : 0U, choices.group_size, tree.has_copies ? 1U : 0U}) {}

  // Returns how many rays fit one dispatch at the moment.
  [[nodiscard]] std::uint32_t rays_per_dispatch() const { return budget_.rays(); }

  // Traces the rays that `push` describes to their end; `buffers` are those of the shader. before(submission) brings the device
  // what the rays need. after(submission, outbox) takes from it what they left, each time that rays paused anew; the last time
  // counts. Those that took too many steps in one period are handed to finish_on_cpu(paused); the others continue in the next
  // dispatch.
  template <class Before, class After, class Finish>
  TraceOutcome run(Push push, const std::vector<const GpuBuffer*>& buffers, const StopQuestion& stop, const Before& before,
                   const After& after, const Finish& finish_on_cpu) {
    while (push.count > 0) {
      if (stop && stop()) return TraceOutcome::stopped;
      const Stopwatch watch;
      Submission submission(context_);
      if (push.from_inbox == 0) before(submission);
      const std::uint32_t paused = dispatch(push, buffers, submission, after);
      budget_.record_duration(push.count, watch.seconds());
      push.first = 0;
      push.count = paused == 0 ? 0 : take_out_stuck(outbox_, paused, finish_on_cpu);
      push.from_inbox = 1;
      std::swap(inbox_, outbox_);
    }
    return TraceOutcome::finished;
  }

  // Records a dispatch of as many groups as a buffer says. Rays that pause stay in `outbox`, which must be empty, for resume().
  void record(Submission& submission, const Push& push, const GpuBuffer& groups, std::size_t offset,
              const std::vector<const GpuBuffer*>& buffers, const GpuBuffer& outbox) {
    submission.run(pipeline_, groups, offset, bytes_of(push), bound(buffers, outbox));
  }
  // Brings rays that paused in a recorded dispatch to their end, as run() does, and empties their outbox.
  template <class After, class Finish>
  TraceOutcome resume(const GpuBuffer& outbox, const std::vector<const GpuBuffer*>& buffers, const StopQuestion& stop,
                      const After& after, const Finish& finish_on_cpu) {
    std::uint32_t paused = 0;
    download(context_, outbox, writable_bytes_of(paused));
    Push push{};
    push.count = take_out_stuck(outbox, paused, finish_on_cpu);
    push.from_inbox = 1;
    std::swap(inbox_, outbox_);
    constexpr std::uint32_t none = 0;
    upload(context_, outbox, bytes_of(none));
    return run(
        push, buffers, stop, [](Submission&) {}, after, finish_on_cpu);
  }

  // Returns the size of an outbox for a number of rays.
  [[nodiscard]] static std::size_t outbox_bytes(std::size_t rays) { return head_bytes + rays * sizeof(Paused); }
  [[nodiscard]] std::uint64_t max_threads() const { return pipeline_.max_threads(); }

 private:
  static constexpr std::size_t head_bytes = sizeof(std::uint32_t);

  static ShaderCode code_of(const WorkShader& shader, const GpuTree& tree, std::uint32_t group_size) {
    std::vector<BufferUse> bindings{tree.use, tree.use};
    bindings.resize(bindings.size() + shader.buffers + 2, BufferUse::storage);
    return {shader.name, tree.variant(shader.with_texel_buffers, shader.with_storage_buffers), bindings, sizeof(Push),
            group_size};
  }

  [[nodiscard]] std::vector<const GpuBuffer*> bound(const std::vector<const GpuBuffer*>& buffers,
                                                    const GpuBuffer& outbox) const {
    std::vector<const GpuBuffer*> all{&tree_.nodes, &tree_.triangles};
    all.insert(all.end(), buffers.begin(), buffers.end());
    all.insert(all.end(), {&inbox_, &outbox});
    return all;
  }

  // Returns the number of rays that paused.
  template <class After>
  std::uint32_t dispatch(const Push& push, const std::vector<const GpuBuffer*>& buffers, Submission& submission,
                         const After& after) {
    std::uint32_t paused = 0;
    submission.upload(outbox_, bytes_of(paused));
    submission.run(pipeline_, push.count, bytes_of(push), bound(buffers, outbox_));
    submission.download(outbox_, writable_bytes_of(paused));
    after(submission, outbox_);
    submission.finish();
    return paused;
  }

  // Leaves the rays of an outbox that continue in outbox_, and returns their number.
  template <class Finish>
  std::uint32_t take_out_stuck(const GpuBuffer& outbox, std::uint32_t count, const Finish& finish_on_cpu) {
    std::vector<Paused> paused(count);
    download(context_, outbox, std::as_writable_bytes(std::span(paused)), head_bytes);
    const auto stuck = std::partition(paused.begin(), paused.end(), [](const Paused& each) { return each.stuck == 0; });
    if (stuck == paused.end() && &outbox == &outbox_) return count;
    std::for_each(stuck, paused.end(), finish_on_cpu);
    paused.erase(stuck, paused.end());
    upload(context_, outbox_, std::as_bytes(std::span(paused)), head_bytes);
    return static_cast<std::uint32_t>(paused.size());
  }

  const GpuContext& context_;
  const GpuTree& tree_;
  DispatchBudget budget_;
  GpuBuffer inbox_, outbox_;
  ComputePipeline pipeline_;
};

}  // namespace sunfleck
