#include "bench/measure.h"

#include "bench/ours.h"
#include "bench/peer.h"

#include <cstdint>
#include <vector>

namespace sunfleck::bench {
namespace {

constexpr double beam_rays = 1U << 20U;
constexpr double packets_of_pass = 1U << 18U;

void finish(benchmark::State& state, const Stand& stand, std::size_t rays) {
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(rays));
  state.counters["triangles"] = static_cast<double>(stand.triangles());
}

std::vector<shared::Packet> rays_of(const Stand& stand, Rays rays) {
  if (rays == Rays::beam) return as_packets(beam_of(stand, beam_rays));
  return packets_of(stand, packets_of_pass, rays == Rays::leaf ? Order::leaf : Order::random);
}

void measure_peer(benchmark::State& state, Rays rays, const Stand& stand, Who who) {
  const std::vector<shared::Packet> all = rays_of(stand, rays);
  const shared::PacketBlock scene = make_packet_block(stand.model, stand.prepared.layout);
  Peer peer(stand);
  peer.build();
  std::uint64_t met = 0;
  for (auto _ : state) met = who == Who::embree_single ? peer.follow_each(scene, all) : peer.follow_eight(scene, all);
  state.counters["met"] = static_cast<double>(met) / static_cast<double>(all.size());
  finish(state, stand, all.size());
}

void measure_beam(benchmark::State& state, const Stand& stand, Tracer& tracer) {
  const shared::BeamBlock beam = beam_of(stand, beam_rays);
  std::vector<std::uint32_t> counters(stand.prepared.layout.words());
  for (auto _ : state) (void)tracer.count_beam(beam, counters, {});
  finish(state, stand, std::size_t{beam.columns} * beam.rows);
}

void measure_packets(benchmark::State& state, Rays rays, const Stand& stand, Tracer& tracer) {
  const std::vector<shared::Packet> all = rays_of(stand, rays);
  const shared::PacketBlock scene = make_packet_block(stand.model, stand.prepared.layout);
  std::vector<shared::Landing> landings(all.size());
  for (auto _ : state) (void)tracer.trace(scene, all, landings, {});
  std::size_t met = 0;
  for (const shared::Landing& landing : landings) met += landing.surface < shared::landed_on_ground ? 1 : 0;
  state.counters["met"] = static_cast<double>(met) / static_cast<double>(all.size());
  finish(state, stand, all.size());
}

}  // namespace

const char* name_of(Rays rays) {
  return rays == Rays::beam ? "beam" : (rays == Rays::leaf ? "leaf" : "random");
}

void measure(benchmark::State& state, Rays rays, const Stand& stand, const Way& way) {
  if (way.who != Who::ours) return measure_peer(state, rays, stand, way.who);
  Ours ours(stand, way.context);
  measure_ours(state, rays, stand, ours.tracer());
}

void measure_ours(benchmark::State& state, Rays rays, const Stand& stand, Tracer& tracer) {
  if (rays == Rays::beam) return measure_beam(state, stand, tracer);
  measure_packets(state, rays, stand, tracer);
}

}  // namespace sunfleck::bench
