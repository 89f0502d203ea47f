#include "devices/gpu/submission.h"

#include "devices/gpu/handles.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "base/check.h"
#include "base/in_blocks.h"

namespace sunfleck {

Submission::~Submission() {
  if (begun_) drop_commands(context_);
}

Submission::SideBySide::SideBySide(Submission& submission) : submission_(submission) {
  EXPECT(submission_.is_side_by_side_, ==, false);
  submission_.is_side_by_side_ = true;
  submission_.has_waited_ = false;
}

Submission::SideBySide::~SideBySide() {
  submission_.is_side_by_side_ = false;
}

void Submission::begin_command() {
  if (!begun_) {
    begin_commands(context_);
  } else if (!is_side_by_side_ || !has_waited_) {
    let_later_commands_see(context_);
  }
  begun_ = true;
  has_waited_ = true;
}

std::span<std::byte> Submission::stage(std::size_t wanted) {
  constexpr std::size_t alignment = 256;
  staged_ = rounded_up(staged_, alignment);
  if (staged_ >= Staging::bytes) finish();
  const std::span<std::byte> piece(context_.handles().staging.data + staged_, std::min(wanted, Staging::bytes - staged_));
  staged_ += piece.size();
  return piece;
}

std::size_t Submission::staged_at(std::span<const std::byte> piece) const {
  return static_cast<std::size_t>(piece.data() - context_.handles().staging.data);
}

void Submission::upload(const GpuBuffer& buffer, std::span<const std::byte> data, std::size_t offset) {
  EXPECT(offset, <=, buffer.bytes);
  EXPECT(data.size(), <=, buffer.bytes - offset);
  while (!data.empty()) {
    const std::span<std::byte> piece = stage(data.size());
    std::memcpy(piece.data(), data.data(), piece.size());
    begin_command();
    const GpuContext::Handles& handles = context_.handles();
    handles.traffic.uploaded_bytes += piece.size();
    handles.commands.copyBuffer(*handles.staging.buffer, *buffer.handles->buffer,
                                vk::BufferCopy(staged_at(piece), offset, piece.size()));
    offset += piece.size();
    data = data.subspan(piece.size());
  }
}

void Submission::fill(const GpuBuffer& buffer, std::uint32_t word) {
  begin_command();
  context_.handles().commands.fillBuffer(*buffer.handles->buffer, 0, VK_WHOLE_SIZE, word);
}

std::size_t Submission::bind(ComputePipeline& pipeline, std::uint64_t threads, std::span<const std::byte> push,
                             std::span<const GpuBuffer* const> buffers) {
  pipeline.check(threads, push, buffers);
  std::vector<std::vector<const GpuBuffer*>>& bindings = pipelines_[&pipeline];
  std::vector<const GpuBuffer*> bound(buffers.begin(), buffers.end());
  const auto earlier = std::find(bindings.begin(), bindings.end(), bound);
  const auto number = static_cast<std::size_t>(earlier - bindings.begin());
  if (earlier != bindings.end()) return number;
  pipeline.bind(number, buffers);
  bindings.push_back(std::move(bound));
  return number;
}

void Submission::run(ComputePipeline& pipeline, std::uint64_t threads, std::span<const std::byte> push,
                     std::span<const GpuBuffer* const> buffers) {
  const std::size_t binding = bind(pipeline, threads, push, buffers);
  if (threads == 0) return;
  begin_command();
  pipeline.record(binding, threads, push);
}

void Submission::run(ComputePipeline& pipeline, const GpuBuffer& groups, std::size_t offset, std::span<const std::byte> push,
                     std::span<const GpuBuffer* const> buffers) {
  const std::size_t binding = bind(pipeline, 0, push, buffers);
  begin_command();
  pipeline.record(binding, groups, offset, push);
}

void Submission::download(const GpuBuffer& buffer, std::span<std::byte> data, std::size_t offset) {
  EXPECT(offset, <=, buffer.bytes);
  EXPECT(data.size(), <=, buffer.bytes - offset);
  while (!data.empty()) {
    const std::span<std::byte> piece = stage(data.size());
    begin_command();
    const GpuContext::Handles& handles = context_.handles();
    handles.traffic.downloaded_bytes += piece.size();
    handles.commands.copyBuffer(*buffer.handles->buffer, *handles.staging.buffer,
                                vk::BufferCopy(offset, staged_at(piece), piece.size()));
    deliveries_.push_back({data.first(piece.size()), staged_at(piece)});
    offset += piece.size();
    data = data.subspan(piece.size());
  }
}

void Submission::finish() {
  if (begun_) {
    begun_ = false;
    ++context_.handles().traffic.submissions;
    submit_and_wait(context_);
  }
  const std::byte* const staging = context_.handles().staging.data;
  each_at_once(deliveries_.size(), [&](std::size_t k) {
    std::memcpy(deliveries_[k].to.data(), staging + deliveries_[k].staged_at, deliveries_[k].to.size());
  });
  deliveries_.clear();
  pipelines_.clear();
  staged_ = 0;
}

}  // namespace sunfleck
