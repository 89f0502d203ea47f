// Tests the sparse maize plot under the paper's sun: no ray differs between CPU path and device, neither in ten million
// landings nor ray by ray on their ways from period to period.

#include "agreement/scenes.h"
#include "agreement/shared_text.h"
#include "devices/tracers/vulkan_tracer.h"
#include "support/device.h"
#include "tree_walk.spirv.h"

#include <gtest/gtest.h>

#include <bit>
#include <cstdlib>
#include <vector>

namespace sunfleck::test {
namespace {

const RadiationModel& sparse_plot() {
  static const RadiationModel model = maize_model({}, beijing_sun());
  return model;
}

const Prepared& prepared_plot() {
  static const Prepared prepared(sparse_plot());
  return prepared;
}

using SparsePlot = DeviceTest;

TEST_F(SparsePlot, TenMillionLandingsAreTheSame) {
  const RadiationModel& model = sparse_plot();
  const Prepared& prepared = prepared_plot();
  const GpuTree tree(context(), prepared.bvh, preferred_use(context(), prepared.bvh));
  VulkanTracer device(context(), prepared.bvh, tree, tracer_scene(model), prepared.layout.words());
  CpuTracer cpu(prepared.bvh, tracer_scene(model));
  std::uint64_t rays = 0;
  std::uint64_t apart = 0;
  for (std::uint64_t replicate = 0; rays < 10'000'000; ++replicate) {
    const shared::BeamBlock beam = make_beam_block(model, prepared.layout, 250'000, 1, replicate);
    std::vector<std::uint32_t> theirs(prepared.layout.words());
    std::vector<std::uint32_t> ours(prepared.layout.words());
    ASSERT_TRUE(device.count_beam(beam, theirs, {}) == TraceOutcome::finished);
    ASSERT_TRUE(cpu.count_beam(beam, ours, {}) == TraceOutcome::finished);
    for (std::size_t word = 0; word < ours.size(); ++word) {
      apart += static_cast<std::uint64_t>(std::abs(std::int64_t{ours[word]} - std::int64_t{theirs[word]}));
    }
    rays += std::uint64_t{beam.columns} * beam.rows;
  }
  EXPECT_EQ(apart, 0U) << "landings moved, two words a ray, of " << rays << " rays";
  RecordProperty("rays", std::to_string(rays));
}

class WalkOnDevice {
 public:
  WalkOnDevice(const GpuContext& context, const Bvh& bvh)
      : context_(context),
        tree_(context, bvh, preferred_use(context, bvh)),
        pipeline_(context,
                  {"tree_walk",
                   tree_walk_spirv,
                   {tree_.use, tree_.use, BufferUse::storage, BufferUse::storage},
                   sizeof(shared::TextPush),
                   shared::group_size},
                  {}) {}

  std::vector<shared::WalkedHit> walk(std::span<const shared::WalkedRay> rays, glm::vec3 direction) {
    const GpuBuffer given = create_buffer(context_, BufferUse::storage, rays.size_bytes(), "rays");
    upload(context_, given, std::as_bytes(rays));
    const GpuBuffer found = create_buffer(context_, BufferUse::storage, rays.size() * sizeof(shared::WalkedHit), "hits");
    const GpuBuffer* const buffers[] = {&tree_.nodes, &tree_.triangles, &given, &found};
    const shared::TextPush push{direction, static_cast<std::uint32_t>(rays.size())};
    pipeline_.run(rays.size(), bytes_of(push), buffers);
    std::vector<shared::WalkedHit> hits(rays.size());
    download(context_, found, std::as_writable_bytes(std::span(hits)));
    return hits;
  }

 private:
  const GpuContext& context_;
  GpuTree tree_;
  ComputePipeline pipeline_;
};

bool same_bits(const shared::WalkedHit& theirs, const CpuHit& ours) {
  if (theirs.found != (ours.found ? 1U : 0U)) return false;
  return !ours.found || (theirs.element == ours.element && theirs.lower == ours.lower &&
                         std::bit_cast<std::uint32_t>(theirs.t) == std::bit_cast<std::uint32_t>(ours.t) &&
                         std::bit_cast<std::uint32_t>(theirs.weight_b) == std::bit_cast<std::uint32_t>(ours.weight_b) &&
                         std::bit_cast<std::uint32_t>(theirs.weight_c) == std::bit_cast<std::uint32_t>(ours.weight_c));
}

float limit_of(const shared::BeamBlock& beam, const shared::Ray& ray) {
  const float ground = shared::meet_ground(ray, beam.ground).limit;
  const float border = shared::next_crossing(ray, beam.period, beam.overlap).limit;
  return ground < border ? ground : border;
}

TEST_F(SparsePlot, AMillionRaysMeetTheSameOnTheirWholeWay) {
  const RadiationModel& model = sparse_plot();
  const Prepared& prepared = prepared_plot();
  const shared::BeamBlock beam = make_beam_block(model, prepared.layout, 1'000'000, 3, 0);
  std::vector<shared::WalkedRay> rays;
  for (std::uint32_t ray = 0; ray < beam.columns * beam.rows; ++ray) {
    const glm::vec3 origin = shared::beam_origin(beam, ray);
    rays.push_back({origin, limit_of(beam, shared::make_ray(origin, beam.direction))});
  }
  WalkOnDevice device(context(), prepared.bvh);
  std::size_t apart = 0;
  std::size_t walks = 0;
  while (!rays.empty()) {
    const std::vector<shared::WalkedHit> theirs = device.walk(rays, beam.direction);
    std::vector<shared::WalkedRay> onwards;
    for (std::size_t k = 0; k < rays.size(); ++k) {
      shared::Ray ray = shared::make_ray(rays[k].origin, beam.direction);
      const CpuHit ours = nearest_hit(prepared.bvh, ray, rays[k].limit);
      apart += same_bits(theirs[k], ours) ? 0 : 1;
      const shared::Crossing crossing = shared::next_crossing(ray, beam.period, beam.overlap);
      if (ours.found || shared::meet_ground(ray, beam.ground).t <= crossing.t) continue;
      ray.origin = shared::enter_next_period(ray, crossing, beam.period);
      onwards.push_back({ray.origin, limit_of(beam, ray)});
    }
    walks += rays.size();
    rays = std::move(onwards);
  }
  EXPECT_EQ(apart, 0U) << "of " << walks << " walks";
  RecordProperty("walks", std::to_string(walks));
}

}  // namespace
}  // namespace sunfleck::test
