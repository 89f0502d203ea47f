#include "devices/gpu/compute.h"

#include "devices/gpu/handles.h"
#include "devices/gpu/submission.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/check.h"
#include "base/rounding.h"

namespace sunfleck {

namespace {

vk::DescriptorType descriptor_type(BufferUse use) {
  return use == BufferUse::storage ? vk::DescriptorType::eStorageBuffer : vk::DescriptorType::eUniformTexelBuffer;
}

}  // namespace

void ComputePipeline::Destroy::operator()(Handles* handles) const noexcept {
  delete handles;
}

ComputePipeline::ComputePipeline(const GpuContext& context, const ShaderCode& code, const Specialisation& constants)
    : context_(context), code_(code), handles_(new Handles) {
  // Every device guarantees these limits (Vulkan specification, table "Required Limits").
  EXPECT(code.push_bytes, <=, 128u);
  EXPECT(code.push_bytes % 4, ==, 0u);
  EXPECT(code.group_size, >=, 1u);
  EXPECT(code.group_size, <=, 128u);
  EXPECT(code.bindings.size(), >=, 1u);
  try {
    create_layouts();
    create_pipeline(constants);
  } catch (const vk::SystemError& error) {
    throw_call_failed(context, fmt::format("shader {}", code.name), error);
  }
}

void ComputePipeline::create_layouts() {
  const auto& device = context_.handles().device;
  std::vector<vk::DescriptorSetLayoutBinding> bindings;
  for (const BufferUse use : code_.bindings) {
    const auto number = static_cast<std::uint32_t>(bindings.size());
    bindings.emplace_back(number, descriptor_type(use), 1, vk::ShaderStageFlagBits::eCompute);
  }
  handles_->set_layout = device.createDescriptorSetLayout({{}, bindings});
  add_binding();
  const vk::DescriptorSetLayout set_layout = *handles_->set_layout;
  const vk::PushConstantRange push(vk::ShaderStageFlagBits::eCompute, 0, code_.push_bytes);
  vk::PipelineLayoutCreateInfo info({}, set_layout);
  if (code_.push_bytes > 0) info.setPushConstantRanges(push);
  handles_->layout = device.createPipelineLayout(info);
}

void ComputePipeline::create_pipeline(const Specialisation& constants) {
  const auto& device = context_.handles().device;
  std::vector<vk::SpecializationMapEntry> entries;
  for (std::uint32_t i = 0; i < constants.size(); ++i) entries.emplace_back(i, 4 * i, 4);
  const vk::SpecializationInfo specialisation(static_cast<std::uint32_t>(entries.size()), entries.data(), 4 * constants.size(),
                                              constants.data());
  const vk::raii::ShaderModule module = device.createShaderModule({{}, code_.spirv.size_bytes(), code_.spirv.data()});
  const vk::PipelineShaderStageCreateInfo stage({}, vk::ShaderStageFlagBits::eCompute, *module, "main", &specialisation);
  handles_->pipeline = device.createComputePipeline(nullptr, {{}, stage, *handles_->layout});
}

void ComputePipeline::add_binding() {
  const auto& device = context_.handles().device;
  std::vector<vk::DescriptorPoolSize> sizes;
  for (const BufferUse use : code_.bindings) sizes.emplace_back(descriptor_type(use), 1);
  Handles::Binding binding;
  binding.pool = device.createDescriptorPool({vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet, 1, sizes});
  const vk::DescriptorSetLayout set_layout = *handles_->set_layout;
  binding.set = std::move(device.allocateDescriptorSets({*binding.pool, set_layout}).front());
  handles_->bindings.push_back(std::move(binding));
}

void ComputePipeline::check(std::uint64_t threads, std::span<const std::byte> push,
                            std::span<const GpuBuffer* const> buffers) const {
  EXPECT(threads, <=, max_threads());
  EXPECT(push.size(), ==, code_.push_bytes);
  EXPECT(buffers.size(), ==, code_.bindings.size());
}

// Binds the buffers anew in every submission. A handle alone does not show whether a buffer is still the one that was bound,
// since a new buffer may get the handle of a destroyed one.
void ComputePipeline::bind(std::size_t binding, std::span<const GpuBuffer* const> buffers) {
  try {
    if (binding == handles_->bindings.size()) add_binding();
  } catch (const vk::SystemError& error) {
    throw_call_failed(context_, fmt::format("shader {}", code_.name), error);
  }
  std::vector<vk::DescriptorBufferInfo> infos(buffers.size());
  std::vector<vk::WriteDescriptorSet> writes(buffers.size());
  for (std::uint32_t i = 0; i < buffers.size(); ++i) {
    const GpuBuffer& buffer = *buffers[i];
    EXPECT(static_cast<int>(buffer.use), ==, static_cast<int>(code_.bindings[i]));
    infos[i] = vk::DescriptorBufferInfo(*buffer.handles->buffer, 0, VK_WHOLE_SIZE);
    writes[i] = vk::WriteDescriptorSet(*handles_->bindings[binding].set, i, 0, 1, descriptor_type(buffer.use), nullptr,
                                       &infos[i], &*buffer.handles->view);
  }
  context_.handles().device.updateDescriptorSets(writes, {});
}

void ComputePipeline::record_binding(std::size_t binding, std::span<const std::byte> push) const {
  const auto& commands = context_.handles().commands;
  commands.bindPipeline(vk::PipelineBindPoint::eCompute, *handles_->pipeline);
  commands.bindDescriptorSets(vk::PipelineBindPoint::eCompute, *handles_->layout, 0, *handles_->bindings[binding].set, {});
  if (!push.empty()) commands.pushConstants<std::byte>(*handles_->layout, vk::ShaderStageFlagBits::eCompute, 0, push);
}

void ComputePipeline::record(std::size_t binding, std::uint64_t threads, std::span<const std::byte> push) const {
  record_binding(binding, push);
  const std::uint64_t groups = block_count(threads, code_.group_size);
  context_.handles().commands.dispatch(static_cast<std::uint32_t>(groups), 1, 1);
}

void ComputePipeline::record(std::size_t binding, const GpuBuffer& groups, std::size_t offset,
                             std::span<const std::byte> push) const {
  record_binding(binding, push);
  context_.handles().commands.dispatchIndirect(*groups.handles->buffer, offset);
}

void ComputePipeline::run(std::uint64_t threads, std::span<const std::byte> push, std::span<const GpuBuffer* const> buffers) {
  Submission submission(context_);
  submission.run(*this, threads, push, buffers);
  submission.finish();
}

std::uint64_t ComputePipeline::max_threads() const {
  const std::uint64_t numbered_groups = (std::uint64_t{1} << 32) / code_.group_size;
  return std::min(context_.limits().max_groups_per_dispatch, numbered_groups) * code_.group_size;
}

}  // namespace sunfleck
