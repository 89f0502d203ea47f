#include "programs/validate/device_cases.h"

#include "base/random.h"
#include "devices/tracers/cpu_tracer.h"
#include "physics/transport/model/beam_block.h"
#include "programs/validate/known/case_scenes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numeric>

namespace sunfleck {
namespace {

using Counters = std::vector<std::uint32_t>;
using Landings = std::vector<shared::Landing>;

Counters count_beam(const CaseBench& bench, Tracer& tracer, const shared::BeamBlock& beam, const SceneTree& tree) {
  Counters counters(tree.layout.words());
  if (tracer.count_beam(beam, counters, bench.stop()) == TraceOutcome::stopped) throw CaseInterrupted();
  return counters;
}

Landings follow(const CaseBench& bench, Tracer& tracer, const shared::PacketBlock& scene,
                const std::vector<shared::Packet>& packets) {
  Landings landings(packets.size());
  if (tracer.trace(scene, packets, landings, bench.stop()) == TraceOutcome::stopped) throw CaseInterrupted();
  return landings;
}

double words_apart(const Counters& a, const Counters& b) {
  std::size_t apart = 0;
  for (std::size_t word = 0; word < a.size(); ++word) apart += a[word] == b[word] ? 0 : 1;
  return static_cast<double>(apart);
}

double landings_apart(const Landings& a, const Landings& b) {
  std::size_t apart = 0;
  for (std::size_t k = 0; k < a.size(); ++k) apart += std::memcmp(&a[k], &b[k], sizeof a[k]) == 0 ? 0 : 1;
  return static_cast<double>(apart);
}

// Creates packets that start from points on the elements, in any direction.
std::vector<shared::Packet> packets_from_elements(const SceneTree& tree, std::size_t count) {
  RandomStream random(17, 0);
  std::vector<shared::Packet> packets(count);
  for (shared::Packet& packet : packets) {
    const auto place = static_cast<std::size_t>(random.unit() * static_cast<double>(tree.bvh.triangles.size()));
    const BvhTriangle& start = tree.bvh.triangles[place];
    const auto b = static_cast<float>(0.5 * random.unit());
    const auto c = static_cast<float>(0.5 * random.unit());
    for (std::size_t axis = 0; axis < 3; ++axis) {
      packet.origin[static_cast<int>(axis)] =
          start.a[axis] + b * (start.b[axis] - start.a[axis]) + c * (start.c[axis] - start.a[axis]);
    }
    packet.origin.x = std::clamp(packet.origin.x, 0.0F, 1.0F);
    packet.origin.z = std::clamp(packet.origin.z, 0.0F, 1.0F);
    packet.element = start.element;
    packet.image = start.image;
    const double slope = 2.0 * random.unit() - 1.0;
    const double angle = 2.0 * std::numbers::pi * random.unit();
    const double level = std::sqrt(1.0 - slope * slope);
    packet.direction = glm::vec3(level * std::cos(angle), slope, level * std::sin(angle));
  }
  return packets;
}

// Returns every integer of a result.
std::vector<std::int64_t> integers_of(const RadiationResult& result) {
  std::vector<std::int64_t> all;
  const auto append = [&](const auto& values) {
    for (const auto value : values) all.push_back(static_cast<std::int64_t>(value));
  };
  for (const BandResult& band : result.bands) {
    const FluxLedger& ledger = band.ledger;
    append(std::array{ledger.incident, ledger.absorbed_vegetation, ledger.absorbed_structure, ledger.absorbed_soil,
                      ledger.reflected, ledger.transmitted, ledger.unshot});
  }
  for (const BeamLandings& element : result.elements) append(std::array{element.upper, element.lower});
  append(result.soil_cells);
  append(result.side_indirect);
  append(result.cell_indirect);
  append(result.side_sky);
  append(result.cell_sky);
  append(std::array{result.direct.rays, result.indirect.sky_rays, result.indirect.packets, result.indirect.rounds});
  return all;
}

// Builds a plot of random leaves in PAR and NIR, in sun and sky.
RadiationModel leaves_in_sun_and_sky(const Plot& plot) {
  RadiationModel model =
      leaf_model(random_leaf_mesh(150, 0.02, plot, 1.0, 5), plot, beijing_sun(), std::array{par_band, nir_band});
  model.sky = SkyModel{.kind = SkyKind::overcast};
  for (Waveband& band : model.bands) band.diffuse_w_m2 = 0.4;
  return model;
}

void compare_with_cpu_path(CaseBench& bench, const char* name, const RadiationModel& model, const SceneTree& tree) {
  constexpr double rays = 2e5;
  CpuTracer cpu(tree.bvh, trace_domain(model));
  const std::unique_ptr<Tracer> device = bench.tracer(model, tree);
  const shared::BeamBlock beam = make_beam_block(model, tree.layout, rays, 1, 0);
  bench.equal(fmt::format("{}, counters unlike the CPU path's", name),
              words_apart(count_beam(bench, *device, beam, tree), count_beam(bench, cpu, beam, tree)), 0.0, 0.0);
  const shared::PacketBlock scene = make_packet_block(model, tree.layout);
  const std::vector<shared::Packet> packets = packets_from_elements(tree, 100'000);
  bench.equal(fmt::format("{}, packets that land elsewhere than on the CPU path", name),
              landings_apart(follow(bench, *device, scene, packets), follow(bench, cpu, scene, packets)), 0.0, 0.0);
  const SolveSettings settings = case_work(model, 8e4, 4096, 8);
  const auto theirs = integers_of(bench.simulate(model, settings));
  const RadiationResult on_cpu = solve(model, tree.layout, cpu, settings, {{}, bench.stop()});
  if (on_cpu.stop == StopReason::interrupted) throw CaseInterrupted();
  const auto ours = integers_of(on_cpu);
  std::size_t apart = theirs.size() == ours.size() ? 0 : ours.size();
  for (std::size_t k = 0; k < std::min(theirs.size(), ours.size()); ++k) apart += theirs[k] == ours[k] ? 0 : 1;
  bench.equal(fmt::format("{}, integers of a whole run unlike the CPU path's", name), static_cast<double>(apart), 0.0, 0.0);
}

// Rays of one replicate beyond 2^24, where a single-precision counter would stop counting.
constexpr double many_rays = 4097.0 * 4097.0;

double counted(const CaseBench& bench, const RadiationModel& model, std::uint32_t& rays, bool on_elements) {
  const SceneTree tree(model);
  const shared::BeamBlock beam = make_beam_block(model, tree.layout, many_rays, 1, 0);
  rays = beam.columns * beam.rows;
  const Counters counters = count_beam(bench, *bench.tracer(model, tree), beam, tree);
  if (!on_elements) return counters[shared::counter_first_cell];
  return static_cast<double>(*std::max_element(counters.begin() + tree.layout.first_bin_word, counters.end()));
}

}  // namespace

void device_cases(CaseBench& bench) {
  for (const bool periodic : {true, false}) {
    const RadiationModel model = leaves_in_sun_and_sky({1.0, 1.0, periodic});
    const SceneTree tree(model);
    const char* name = periodic ? "endless plot" : "stand alone";
    CpuTracer walk(tree.bvh, trace_domain(model));
    CpuTracer doubter(tree.bvh, trace_domain(model), CpuWalk::every_element);
    const shared::BeamBlock beam = make_beam_block(model, tree.layout, 10'000, 2, 0);
    bench.equal(fmt::format("{}, counters unlike those without a tree", name),
                words_apart(count_beam(bench, walk, beam, tree), count_beam(bench, doubter, beam, tree)), 0.0, 0.0);
    const shared::PacketBlock scene = make_packet_block(model, tree.layout);
    const std::vector<shared::Packet> packets = packets_from_elements(tree, 4000);
    bench.equal(fmt::format("{}, packets that land elsewhere than without a tree", name),
                landings_apart(follow(bench, walk, scene, packets), follow(bench, doubter, scene, packets)), 0.0, 0.0);
    if (!bench.cpu_path()) compare_with_cpu_path(bench, name, model, tree);
  }
}

void counter_cases(CaseBench& bench) {
  std::uint32_t rays = 0;
  RadiationModel bare = black_model({}, {1.0, 1.0, true}, beijing_sun());
  bare.soil->patch_m = 1.0;
  const double on_soil = counted(bench, bare, rays, false);
  bench.equal("2^24 and more rays on one cell of the soil", on_soil, rays, 0.0);
  // One horizontal triangle that covers the plot together with its copies.
  MeshMaker mesh;
  mesh.triangle({-0.5, 0.5, -0.5}, {-0.5, 0.5, 3.0}, {3.0, 0.5, -0.5});
  RadiationModel covered = black_model(mesh.mesh(), {1.0, 1.0, true}, beijing_sun());
  covered.layers = 1;
  const double on_leaf = counted(bench, covered, rays, true);
  bench.equal("2^24 and more rays on one leaf", on_leaf, rays, 0.0);
}

namespace {

// Compares the ledger of black surfaces with the tallies by side and by cell of the soil's map.
void black_tallies(CaseBench& bench) {
  const Plot plot{1.0, 1.0, true};
  RadiationModel model = black_model(random_leaf_mesh(150, 0.02, plot, 1.0, 5), plot, beijing_sun());
  const RadiationResult sun = bench.simulate(model, case_work(model, 3e5, 0.0, 8));
  std::uint64_t landed = std::accumulate(sun.soil_cells.begin(), sun.soil_cells.end(), std::uint64_t{0});
  for (const BeamLandings& element : sun.elements) landed += element.upper + element.lower;
  bench.equal("rays of the beam less their landings", static_cast<double>(sun.direct.rays) - static_cast<double>(landed), 0.0,
              0.0);
  shine_from_sky(model, {.kind = SkyKind::overcast});
  const RadiationResult sky = bench.simulate(model, case_work(model, 1.0, 32768, 8));
  const auto sum = [](const std::vector<std::int64_t>& quanta) { return std::accumulate(quanta.begin(), quanta.end(), 0LL); };
  const FluxLedger& ledger = sky.bands[0].ledger;
  bench.equal("quanta absorbed by leaves less those on their sides",
              static_cast<double>(ledger.absorbed_vegetation - sum(sky.side_indirect)), 0.0, 0.0);
  bench.equal("quanta absorbed by soil less those on its cells",
              static_cast<double>(ledger.absorbed_soil - sum(sky.cell_indirect)), 0.0, 0.0);
}

// With leaves and soil that absorb nothing, all light must come back out, to the quantum.
void nothing_absorbed(CaseBench& bench) {
  const Plot plot{1.0, 1.0, true};
  constexpr std::array bands = {LeafBand{"even", 0.5, 0.5, 1.0}, LeafBand{"uneven", 0.7, 0.3, 1.0},
                                LeafBand{"through", 0.1, 0.9, 1.0}};
  const RadiationModel model = leaf_model(random_leaf_mesh(60, 0.02, plot, 1.0, 7), plot, beijing_sun(), bands);
  const RadiationResult result = bench.simulate(model, case_work(model, 3e4, 4096, 8));
  for (const BandResult& band : result.bands) {
    const FluxLedger& ledger = band.ledger;
    bench.equal(fmt::format("leaves that absorb nothing over white soil, {}, quanta absorbed", band.name),
                static_cast<double>(ledger.absorbed_vegetation + ledger.absorbed_soil), 0.0, 0.0);
    bench.equal(fmt::format("leaves that absorb nothing over white soil, {}, reflected and unshot", band.name),
                static_cast<double>(ledger.reflected + ledger.unshot) / static_cast<double>(ledger.incident), 1.0, 0.0);
  }
}

}  // namespace

void ledger_cases(CaseBench& bench) {
  for (const bool periodic : {true, false}) {
    for (const bool has_soil : {true, false}) {
      RadiationModel model = leaves_in_sun_and_sky({1.0, 1.0, periodic});
      if (!has_soil) model.soil.reset();
      const RadiationResult result = bench.simulate(model, case_work(model, 1e5, 4096, 8));
      const std::string name =
          fmt::format("{} {} soil, ", periodic ? "endless plot" : "stand alone", has_soil ? "with" : "without");
      std::int64_t missing = 0;
      for (const BandResult& band : result.bands) missing += std::abs(band.ledger.residual());
      bench.equal(name + "quanta missing", static_cast<double>(missing), 0.0, 0.0);
      bench.equal(name + "rays lost", static_cast<double>(result.lost_rays), 0.0, 0.0);
      if (periodic) bench.equal(name + "incident", result.bands[1].incident.value, 1.4);
    }
  }
  black_tallies(bench);
  nothing_absorbed(bench);
}

}  // namespace sunfleck
