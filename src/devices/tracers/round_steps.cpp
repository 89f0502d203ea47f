#include "devices/tracers/round_steps.h"

#include "base/error.h"
#include "rounds_begin.spirv.h"
#include "rounds_book.spirv.h"
#include "rounds_collect.spirv.h"
#include "rounds_count.spirv.h"
#include "rounds_emit.spirv.h"
#include "rounds_expect.spirv.h"
#include "rounds_load.spirv.h"
#include "rounds_order.spirv.h"
#include "rounds_plan.spirv.h"
#include "rounds_sort.spirv.h"
#include "rounds_sum_blocks.spirv.h"
#include "rounds_sum_spine.spirv.h"
#include "rounds_sum_up.spirv.h"
#include "rounds_take.spirv.h"
#include "rounds_weigh.spirv.h"

#include <vector>

namespace sunfleck {
namespace {

ComputePipeline make_shader(const GpuContext& context, const char* name, std::span<const std::uint32_t> spirv) {
  const std::vector<BufferUse> bindings(round_buffer_count + 1, BufferUse::storage);
  return {context, ShaderCode{name, spirv, bindings, sizeof(shared::RoundPush), shared::round_group_size}, {}};
}

}  // namespace

RoundSteps::Shaders::Shaders(const GpuContext& context)
    : collect(make_shader(context, "collect", rounds_collect_spirv)),
      begin(make_shader(context, "begin", rounds_begin_spirv)),
      count(make_shader(context, "count", rounds_count_spirv)),
      sum_blocks(make_shader(context, "sum_blocks", rounds_sum_blocks_spirv)),
      sum_spine(make_shader(context, "sum_spine", rounds_sum_spine_spirv)),
      sum_up(make_shader(context, "sum_up", rounds_sum_up_spirv)),
      sort(make_shader(context, "sort", rounds_sort_spirv)),
      expect(make_shader(context, "expect", rounds_expect_spirv)),
      plan(make_shader(context, "plan", rounds_plan_spirv)),
      take(make_shader(context, "take", rounds_take_spirv)),
      weigh(make_shader(context, "weigh", rounds_weigh_spirv)),
      load(make_shader(context, "load", rounds_load_spirv)),
      emit(make_shader(context, "emit", rounds_emit_spirv)),
      order(make_shader(context, "order", rounds_order_spirv)),
      book(make_shader(context, "book", rounds_book_spirv)) {}

bool RoundSteps::work_on(const DeviceLimits& limits) {
  return limits.int64 && limits.int64_atomics && limits.max_storage_buffers > round_buffer_count;
}

RoundSteps::RoundSteps(const GpuContext& context, const shared::RoundChoices& choices, std::size_t packets_at_a_time)
    : context_(context),
      choices_(choices),
      packets_at_a_time_(packets_at_a_time),
      buffers_(context),
      nothing_(create_buffer(context, BufferUse::storage, sizeof(std::uint32_t), "an empty outbox")),
      shaders_(context) {
  ::sunfleck::fill(context, nothing_, 0);
}

bool RoundSteps::make_room(const RoundsOrder& order) {
  const RoundSizes sizes(order, packets_at_a_time_, choices_);
  if (sizes.places >= refused_places_ || !sizes.fit(context_, shaders_.take.max_threads())) return false;
  try {
    buffers_.make_room(sizes);
  } catch (const Error&) {  // the memory is short; the host can go on, which needs some of it
    buffers_.free();
    scene_number_ = 0;
    refused_places_ = sizes.places;
    return false;
  }
  sizes_ = sizes;
  return true;
}

void RoundSteps::give(Submission& submission, const RoundsOrder& order) {
  give_scene(submission, order.scene);
  shared::PassBlock block = order.block;
  block.choices = choices_;
  block.most_packets = static_cast<std::uint32_t>(sizes_.packets);
  shared::RoundState state{};
  state.places = static_cast<std::uint32_t>(order.places.size());
  state.end_of_elements = order.places.end_of_elements();
  state.end_of_cells = order.places.end_of_cells();
  upload(submission, RoundBuffer::pass, std::span<const shared::PassBlock>(&block, 1));
  upload(submission, RoundBuffer::state, std::span<const shared::RoundState>(&state, 1));
  upload(submission, RoundBuffer::columns, std::span(order.columns));
  upload(submission, RoundBuffer::totals, std::span(order.totals));
  upload(submission, RoundBuffer::faces, std::span(order.faces));
  upload(submission, RoundBuffer::next_places, order.places.places());
  upload(submission, RoundBuffer::next_quanta, order.places.rows());
  for (const RoundBuffer sums : {RoundBuffer::copies, RoundBuffer::side_landed, RoundBuffer::element_hits,
                                 RoundBuffer::cell_landed, RoundBuffer::surface_landed}) {
    submission.fill(buffers_[sums], 0);
  }
}

void RoundSteps::give_scene(Submission& submission, const IndirectScene& scene) {
  if (scene.number == scene_number_) return;
  upload(submission, RoundBuffer::elements, std::span<const shared::RoundElement>(round_elements(scene)));
  upload(submission, RoundBuffer::corners, scene.model.canopy.corners.own());
  scene_number_ = scene.number;
}

std::vector<const GpuBuffer*> RoundSteps::bound() const {
  return buffers_.with(outbox_ != nullptr ? *outbox_ : nothing_);
}

void RoundSteps::run(Submission& submission, ComputePipeline& shader, std::uint64_t threads, shared::RoundPush push) {
  submission.run(shader, threads, std::as_bytes(std::span(&push, 1)), bound());
}

void RoundSteps::run_groups(Submission& submission, ComputePipeline& shader, std::uint32_t kind, shared::RoundPush push) {
  submission.run(shader, buffers_[RoundBuffer::groups], RoundBuffers::offset_of_groups(kind),
                 std::as_bytes(std::span(&push, 1)), bound());
}

void RoundSteps::sum(Submission& submission, std::uint32_t kind, std::uint32_t groups) {
  run_groups(submission, shaders_.sum_blocks, groups, {kind, 0});
  run(submission, shaders_.sum_spine, shared::round_group_size, {kind, 0});
  run_groups(submission, shaders_.sum_up, groups, {kind, 0});
}

void RoundSteps::begin(Submission& submission) {
  run(submission, shaders_.collect, sizes_.small_words, {0, static_cast<std::uint32_t>(sizes_.small_words)});
  run(submission, shaders_.begin, shared::round_group_size);
}

void RoundSteps::sort(Submission& submission) {
  run_groups(submission, shaders_.count, shared::groups_of_places);
  sum(submission, shared::sums_of_runs, shared::groups_of_run_sums);
  run_groups(submission, shaders_.sort, shared::groups_of_places);
}

void RoundSteps::draw(Submission& submission) {
  run_groups(submission, shaders_.expect, shared::groups_of_sides);
  sum(submission, shared::sums_of_sides, shared::groups_of_side_sums);
  run(submission, shaders_.plan, 1);
  run_groups(submission, shaders_.take, shared::groups_of_sides);
}

void RoundSteps::weigh(Submission& submission) {
  const auto columns = static_cast<std::uint32_t>(sizes_.columns);
  run_groups(submission, shaders_.weigh, shared::groups_of_packets);
  run(submission, shaders_.collect, columns, {shared::sum_weights * columns, columns});
  run(submission, shaders_.load, shared::round_group_size);
}

void RoundSteps::start(Submission& submission, shared::RoundPush packets) {
  if (packets.count == shared::all_packets) {
    run_groups(submission, shaders_.emit, shared::groups_of_packets, packets);
    return run_groups(submission, shaders_.order, shared::groups_of_packets, packets);
  }
  run(submission, shaders_.emit, packets.count, packets);
  run(submission, shaders_.order, packets.count, packets);
}

void RoundSteps::book(Submission& submission, shared::RoundPush packets) {
  if (packets.count == shared::all_packets) return run_groups(submission, shaders_.book, shared::groups_of_packets, packets);
  run(submission, shaders_.book, packets.count, packets);
}

void RoundSteps::fetch(Submission& submission, shared::RoundState& state) const {
  submission.download(buffers_[RoundBuffer::state], std::as_writable_bytes(std::span(&state, 1)));
}

void RoundSteps::fetch(RoundsSums& sums) const {
  shared::RoundState state{};
  Submission submission(context_);
  const auto download = [&](RoundBuffer buffer, auto& values) {
    values.resize(sizes_.bytes(buffer) / sizeof(values[0]));
    submission.download(buffers_[buffer], std::as_writable_bytes(std::span(values)));
  };
  download(RoundBuffer::columns, sums.columns);
  download(RoundBuffer::totals, sums.totals);
  download(RoundBuffer::side_landed, sums.side_landed);
  download(RoundBuffer::element_hits, sums.element_hits);
  download(RoundBuffer::cell_landed, sums.cell_landed);
  download(RoundBuffer::surface_landed, sums.surface_landed);
  fetch(submission, state);
  submission.finish();
  sums.packets = state.all_packets;
  sums.rounds = state.rounds;
  sums.most_places = state.most_places;
}

}  // namespace sunfleck
