#include "devices/tracers/round_steps.h"

#include "base/in_blocks.h"
#include "rounds_begin.spirv.h"
#include "rounds_book.spirv.h"
#include "rounds_collect.spirv.h"
#include "rounds_count.spirv.h"
#include "rounds_emit.spirv.h"
#include "rounds_expect.spirv.h"
#include "rounds_first_load.spirv.h"
#include "rounds_first_sum.spirv.h"
#include "rounds_first_wait.spirv.h"
#include "rounds_load.spirv.h"
#include "rounds_order.spirv.h"
#include "rounds_plan.spirv.h"
#include "rounds_sort.spirv.h"
#include "rounds_sum_blocks.spirv.h"
#include "rounds_sum_spine.spirv.h"
#include "rounds_sum_up.spirv.h"
#include "rounds_take.spirv.h"
#include "rounds_weigh.spirv.h"

#include <algorithm>
#include <vector>

namespace sunfleck {
namespace {

ComputePipeline make_shader(const GpuContext& context, const char* name, std::span<const std::uint32_t> spirv) {
  const std::vector<BufferUse> bindings(round_buffer_count, BufferUse::storage);
  return {context, ShaderCode{name, spirv, bindings, sizeof(shared::RoundPush), shared::round_group_size}, {}};
}

}  // namespace

RoundSteps::Shaders::Shaders(const GpuContext& context)
    : first_sum(make_shader(context, "first_sum", rounds_first_sum_spirv)),
      first_load(make_shader(context, "first_load", rounds_first_load_spirv)),
      first_wait(make_shader(context, "first_wait", rounds_first_wait_spirv)),
      collect(make_shader(context, "collect", rounds_collect_spirv)),
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
  return limits.int64 && limits.int64_atomics && limits.max_storage_buffers >= round_buffer_count;
}

RoundSteps::RoundSteps(const GpuContext& context, const shared::RoundChoices& choices, std::size_t packets_at_a_time)
    : context_(context),
      choices_(choices),
      packets_at_a_time_(packets_at_a_time),
      landings_(context),
      buffers_(context),
      shaders_(context) {}

std::size_t RoundSteps::make_room(std::span<const RoundsPass> passes) {
  const RoundSizes sizes(passes, packets_at_a_time_, choices_);
  if (sizes.places >= refused_places_) return 0;
  std::size_t lanes = std::min({sizes.most_lanes(context_, shaders_.take.max_threads()), passes.size(), most_lanes_});
  while (lanes > 0 && !buffers_.make_room(sizes, lanes)) {
    scene_number_ = 0;
    if (landings_.free_unused()) continue;
    if (lanes == 1) refused_places_ = sizes.places;
    lanes /= 2;
    most_lanes_ = std::max<std::size_t>(1, lanes);
  }
  sizes_ = sizes;
  return lanes;
}

void RoundSteps::give(Submission& submission, std::span<const RoundsPass> passes) {
  lanes_ = passes.size();
  {
    const Submission::SideBySide side_by_side(submission);
    give_scene(submission, passes.front().order->scene);
    for (std::size_t lane = 0; lane < lanes_; ++lane) give(submission, lane, *passes[lane].order);
  }
  const auto has_landings = [](const RoundsPass& pass) { return pass.order->landings != nullptr; };
  if (std::any_of(passes.begin(), passes.end(), has_landings)) add_landings(submission, passes);
}

void RoundSteps::give(Submission& submission, std::size_t lane, const RoundsOrder& order) {
  shared::PassBlock block = order.block;
  block.choices = choices_;
  block.most_packets = static_cast<std::uint32_t>(sizes_.packets);
  shared::RoundState state{};
  state.places = static_cast<std::uint32_t>(order.first_places());
  state.pace = std::uint64_t{1} << 32U;
  state.end_of_elements = order.places.end_of_elements();
  state.end_of_cells = order.places.end_of_cells();
  upload(submission, lane, RoundBuffer::pass, std::span<const shared::PassBlock>(&block, 1));
  upload(submission, lane, RoundBuffer::state, std::span<const shared::RoundState>(&state, 1));
  upload(submission, lane, RoundBuffer::columns, std::span(order.columns));
  upload(submission, lane, RoundBuffer::totals, std::span(order.totals));
  upload(submission, lane, RoundBuffer::faces, std::span(order.faces));
  upload(submission, lane, RoundBuffer::next_places, order.places.places());
  upload(submission, lane, RoundBuffer::next_quanta, order.places.rows());
  constexpr std::uint32_t none = 0;
  upload(submission, lane, RoundBuffer::outbox, std::span(&none, 1));
  for (const RoundBuffer sums : {RoundBuffer::copies, RoundBuffer::side_landed, RoundBuffer::element_hits,
                                 RoundBuffer::cell_landed, RoundBuffer::surface_landed, RoundBuffer::plane_cells}) {
    submission.fill(buffer(sums, lane), 0);
  }
}

void RoundSteps::give_scene(Submission& submission, const IndirectScene& scene) {
  if (scene.number == scene_number_) return;
  upload(submission, 0, RoundBuffer::elements, std::span<const shared::RoundElement>(round_elements(scene)));
  const ElementCorners& corners = scene.model.canopy.corners;
  std::size_t offset = 0;
  for (const std::span<const Triangle> array : corner_arrays(corners)) {
    submission.upload(buffer(RoundBuffer::corners), std::as_bytes(array), offset);
    offset += array.size_bytes();
  }
  if (scene.receivers != nullptr) upload(submission, 0, RoundBuffer::planes, scene.receivers->planes());
  upload(submission, 0, RoundBuffer::runs, std::span<const shared::ElementRun>(element_runs(corners)));
  scene_number_ = scene.number;
}

void RoundSteps::run(Submission& submission, Lanes lanes, ComputePipeline& shader, std::uint64_t threads,
                     shared::RoundPush push, const OtherBuffer& instead) {
  const Submission::SideBySide side_by_side(submission);
  for (std::size_t lane = lanes.first; lane < lanes.end; ++lane) {
    submission.run(shader, threads, bytes_of(push), buffers_.of(lane, instead));
  }
}

void RoundSteps::run_sampled(Submission& submission, std::span<const RoundsPass> passes, ComputePipeline& shader) {
  const Submission::SideBySide side_by_side(submission);
  for (std::size_t lane = 0; lane < lanes_; ++lane) {
    const RoundsOrder& order = *passes[lane].order;
    if (order.landings == nullptr) continue;
    const GpuBuffer& landings = dynamic_cast<const LandingsOnDevice&>(*order.landings).buffer();
    constexpr shared::RoundPush push{};
    submission.run(shader, order.block.sampled.count, bytes_of(push), buffers_.of(lane, {RoundBuffer::landings, &landings}));
  }
}

void RoundSteps::add_landings(Submission& submission, std::span<const RoundsPass> passes) {
  const auto columns = static_cast<std::uint32_t>(sizes_.columns);
  run_sampled(submission, passes, shaders_.first_sum);
  run(submission, all_lanes(), shaders_.collect, columns, {shared::sum_weights * columns, columns});
  run(submission, all_lanes(), shaders_.first_load, shared::round_group_size);
  run_sampled(submission, passes, shaders_.first_wait);
}

void RoundSteps::run_groups(Submission& submission, ComputePipeline& shader, std::uint32_t kind, shared::RoundPush push) {
  const Submission::SideBySide side_by_side(submission);
  for (std::size_t lane = 0; lane < lanes_; ++lane) {
    submission.run(shader, buffer(RoundBuffer::groups, lane), RoundBuffers::offset_of_groups(kind), bytes_of(push),
                   buffers_.of(lane));
  }
}

void RoundSteps::sum(Submission& submission, std::uint32_t kind, std::uint32_t groups) {
  run_groups(submission, shaders_.sum_blocks, groups, {kind, 0});
  run(submission, all_lanes(), shaders_.sum_spine, shared::round_group_size, {kind, 0});
  run_groups(submission, shaders_.sum_up, groups, {kind, 0});
}

void RoundSteps::begin(Submission& submission) {
  begin(submission, all_lanes());
}

void RoundSteps::begin(Submission& submission, std::size_t lane) {
  begin(submission, Lanes{lane, lane + 1});
}

void RoundSteps::begin(Submission& submission, Lanes lanes) {
  run(submission, lanes, shaders_.collect, sizes_.small_words, {0, static_cast<std::uint32_t>(sizes_.small_words)});
  run(submission, lanes, shaders_.begin, shared::round_group_size);
}

void RoundSteps::sort(Submission& submission) {
  run_groups(submission, shaders_.count, shared::groups_of_places);
  sum(submission, shared::sums_of_runs, shared::groups_of_run_sums);
  run_groups(submission, shaders_.sort, shared::groups_of_places);
}

void RoundSteps::draw(Submission& submission) {
  run_groups(submission, shaders_.expect, shared::groups_of_sides);
  sum(submission, shared::sums_of_sides, shared::groups_of_side_sums);
  run(submission, all_lanes(), shaders_.plan, 1);
  run_groups(submission, shaders_.take, shared::groups_of_sides);
}

void RoundSteps::weigh(Submission& submission) {
  const auto columns = static_cast<std::uint32_t>(sizes_.columns);
  run_groups(submission, shaders_.weigh, shared::groups_of_packets);
  run(submission, all_lanes(), shaders_.collect, columns, {shared::sum_weights * columns, columns});
  run(submission, all_lanes(), shaders_.load, shared::round_group_size);
}

void RoundSteps::run_packets(Submission& submission, ComputePipeline& shader, shared::RoundPush packets) {
  if (packets.count == shared::all_packets) return run_groups(submission, shader, shared::groups_of_packets, packets);
  run(submission, all_lanes(), shader, packets.count, packets);
}

void RoundSteps::start(Submission& submission, shared::RoundPush packets) {
  run_packets(submission, shaders_.emit, packets);
  run_packets(submission, shaders_.order, packets);
}

void RoundSteps::book(Submission& submission, shared::RoundPush packets) {
  run_packets(submission, shaders_.book, packets);
}

void RoundSteps::book(Submission& submission, std::size_t lane, shared::RoundPush packets, const GpuBuffer* outbox) {
  run(submission, {lane, lane + 1}, shaders_.book, packets.count, packets, {RoundBuffer::outbox, outbox});
}

void RoundSteps::fetch(Submission& submission, std::span<shared::RoundState> states) const {
  const Submission::SideBySide side_by_side(submission);
  for (std::size_t lane = 0; lane < states.size(); ++lane) {
    submission.download(buffer(RoundBuffer::state, lane), std::as_writable_bytes(states.subspan(lane, 1)));
  }
}

void RoundSteps::fetch(std::span<const RoundsPass> passes) const {
  const auto each_sum = [](RoundsSums& sums, const auto& take) {
    take(RoundBuffer::columns, sums.columns);
    take(RoundBuffer::totals, sums.totals);
    take(RoundBuffer::side_landed, sums.side_landed);
    take(RoundBuffer::element_hits, sums.element_hits);
    take(RoundBuffer::cell_landed, sums.cell_landed);
    take(RoundBuffer::surface_landed, sums.surface_landed);
    take(RoundBuffer::plane_cells, sums.plane_cells);
  };
  each_at_once(passes.size(), [&](std::size_t lane) {
    each_sum(*passes[lane].sums,
             [&](RoundBuffer which, auto& values) { values.resize(sizes_.bytes(which) / sizeof(values[0])); });
  });
  std::vector<shared::RoundState> states(passes.size());
  Submission submission(context_);
  {
    const Submission::SideBySide no_order(submission);
    for (std::size_t lane = 0; lane < passes.size(); ++lane) {
      each_sum(*passes[lane].sums, [&](RoundBuffer which, auto& values) {
        submission.download(buffer(which, lane), std::as_writable_bytes(std::span(values)));
      });
    }
  }
  fetch(submission, states);
  submission.finish();
  for (std::size_t lane = 0; lane < passes.size(); ++lane) {
    passes[lane].sums->packets = states[lane].all_packets;
    passes[lane].sums->rounds = states[lane].rounds;
    passes[lane].sums->first_places = passes[lane].order->places.size() + states[lane].first_places;
    passes[lane].sums->most_places = states[lane].most_places;
  }
}

}  // namespace sunfleck
