// Measures the cost of precautions: padded boxes, leaving out the element that a packet starts from, edges that no ray slips
// through.

#include "bench/benches.h"
#include "bench/measure.h"
#include "bench/ours.h"
#include "bench/rays.h"
#include "physics/bvh/build.h"
#include "shared/beam.h"
#include "shared/intersect.h"

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <cstddef>
#include <cstdint>
#include <glm/geometric.hpp>
#include <string>
#include <vector>

namespace sunfleck::bench {
namespace {

enum class Precaution { taken, left_out };

void with_padding(benchmark::State& state, const GpuContext* context, Precaution precaution) {
  const Stand& stand = stand_of(paper_plants);
  const float padding_m = precaution == Precaution::taken ? box_padding_m(stand.model) : 0.0F;
  Bvh bvh = build_bvh(stand.model.canopy, padding_m);
  number_counters(stand.prepared.layout, stand.model.canopy, bvh);
  const shared::BeamBlock beam = beam_of(stand, 1U << 20U);
  std::vector<std::uint32_t> counters(stand.prepared.layout.words());
  Ours ours(stand, bvh, context);
  for (auto _ : state) (void)ours.tracer().count_beam(beam, counters, {});
}

void with_own_element(benchmark::State& state, const GpuContext* context, Precaution precaution) {
  const Stand& stand = stand_of(paper_plants);
  std::vector<shared::Packet> packets = packets_of(stand, 1U << 18U, Order::leaf);
  if (precaution == Precaution::left_out) {
    for (shared::Packet& packet : packets) packet.element = shared::no_element;
  }
  const shared::PacketBlock scene = make_packet_block(stand.model, stand.prepared.layout);
  std::vector<shared::Landing> landings(packets.size());
  Ours ours(stand, context);
  for (auto _ : state) (void)ours.tracer().trace(scene, packets, landings, {});
}

// Returns the distance by Moeller and Trumbore 1997, "Fast, minimum storage ray/triangle intersection": the tests of two
// triangles at a common edge share no arithmetic, so a ray may pass between them.
float plain_distance(const shared::Ray& ray, const BvhTriangle& triangle) {
  const glm::vec3 a(triangle.a[0], triangle.a[1], triangle.a[2]);
  const glm::vec3 to_b = glm::vec3(triangle.b[0], triangle.b[1], triangle.b[2]) - a;
  const glm::vec3 to_c = glm::vec3(triangle.c[0], triangle.c[1], triangle.c[2]) - a;
  const glm::vec3 p = glm::cross(ray.direction, to_c);
  const float determinant = glm::dot(to_b, p);
  const float inverse = 1.0F / determinant;
  const glm::vec3 from_a = ray.origin - a;
  const float u = glm::dot(from_a, p) * inverse;
  if (!(u >= 0.0F && u <= 1.0F)) return 0.0F;
  const glm::vec3 q = glm::cross(from_a, to_b);
  const float v = glm::dot(ray.direction, q) * inverse;
  return v >= 0.0F && u + v <= 1.0F ? glm::dot(to_c, q) * inverse : 0.0F;
}

float watertight_distance(const shared::Ray& ray, const BvhTriangle& triangle) {
  const auto corner = [](const auto& words) { return glm::vec3(words[0], words[1], words[2]); };
  const shared::TriangleHit hit = shared::meet_triangle(ray, corner(triangle.a), corner(triangle.b), corner(triangle.c));
  return hit.met ? hit.t : 0.0F;
}

// Tests one ray against as many triangles as it meets on its way: neighbours in the tree.
void with_watertight_edges(benchmark::State& state, const GpuContext*, Precaution precaution) {
  const Stand& stand = stand_of(paper_plants);
  const shared::BeamBlock beam = beam_of(stand, 1U << 14U);
  const std::vector<BvhTriangle>& triangles = stand.prepared.bvh.triangles;
  constexpr std::size_t tests_a_ray = 16;
  for (auto _ : state) {
    float sum = 0.0F;
    for (std::uint32_t number = 0; number < beam.columns * beam.rows; ++number) {
      const shared::Ray ray = shared::make_ray(shared::beam_origin(beam, number), beam.direction);
      const std::size_t first = (std::size_t{number} * 7919) % (triangles.size() - tests_a_ray);
      for (std::size_t k = first; k < first + tests_a_ray; ++k)
        sum += precaution == Precaution::taken ? watertight_distance(ray, triangles[k]) : plain_distance(ray, triangles[k]);
    }
    benchmark::DoNotOptimize(sum);
  }
}

template <class Measure>
void add(const std::string& name, const GpuContext* context, const Measure& measure) {
  for (const auto& [with, precaution] : {std::pair("with", Precaution::taken), std::pair("without", Precaution::left_out)}) {
    add_benchmark(fmt::format("safeguard/{}/{}/{}", name, context == nullptr ? "cpu" : "device", with), measure, context,
                  precaution);
  }
}

}  // namespace

void register_safeguards(const GpuContext* context) {
  add("padding", nullptr, with_padding);
  add("own_element", nullptr, with_own_element);
  add("watertight", nullptr, with_watertight_edges);
  if (context == nullptr) return;
  add("padding", context, with_padding);
  add("own_element", context, with_own_element);
}

}  // namespace sunfleck::bench
