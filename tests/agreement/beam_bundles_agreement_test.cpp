// Tests that the CPU path, which follows beam rays in bundles, counts the same landings, word for word, as its walk for single
// rays and as a test of every element.

#include "agreement/scenes.h"
#include "shared/beam.h"
#include "support/copies.h"

#include <gtest/gtest.h>

#include <vector>

namespace sunfleck::test {
namespace {

using Counters = std::vector<std::uint32_t>;

Counters one_by_one(const CpuTracer& tracer, const shared::BeamBlock& beam, const CounterLayout& layout) {
  Counters counters(layout.words());
  for (std::uint32_t ray = 0; ray < beam.columns * beam.rows; ++ray) {
    tracer.finish_ray(beam, {shared::beam_origin(beam, ray), 0, ray, 0}, counters, {});
  }
  return counters;
}

// Also counts `doubted_rays` rays by testing every element.
void expect_agreement(const RadiationModel& model, double rays, double doubted_rays) {
  const Prepared prepared(model);
  const auto count = [&](CpuTracer& tracer, const shared::BeamBlock& beam) {
    Counters counters(prepared.layout.words());
    EXPECT_TRUE(tracer.count_beam(beam, counters, {}) == TraceOutcome::finished);
    return counters;
  };
  CpuTracer tracer(prepared.bvh, tracer_scene(model));
  const shared::BeamBlock beam = make_beam_block(model, prepared.layout, rays, 1, 0);
  EXPECT_TRUE(count(tracer, beam) == one_by_one(tracer, beam, prepared.layout));
  CpuTracer doubter(prepared.bvh, tracer_scene(model), CpuWalk::every_element);
  const shared::BeamBlock few = make_beam_block(model, prepared.layout, doubted_rays, 2, 0);
  EXPECT_TRUE(count(tracer, few) == count(doubter, few));
}

TEST(BeamBundlesAgreement, OnMaize) {
  expect_agreement(maize_model({1, 2, 0.6, 0.6, 3}, beijing_sun()), 60'000, 1'000);
  expect_agreement(black_model(make_maize({1, 1, 0.6, 0.6, 5}), {0.6, 0.6, false}, beijing_sun()), 60'000, 1'000);
}

TEST(BeamBundlesAgreement, OnRandomLeavesUnderAnySun) {
  const Mesh leaves = random_leaves(300, 0.1, 1);
  for (const double elevation : {90.0, 81.0, 53.0, 25.0, 10.0, 2.0}) {
    for (const double azimuth : {0.0, 45.0, 120.0, 180.0, 250.0, 270.0}) {
      expect_agreement(black_model(leaves, unit_plot, sun_at(elevation, azimuth)), 6'000, 500);
      expect_agreement(black_model(leaves, unit_stand, sun_at(elevation, azimuth)), 6'000, 500);
    }
  }
}

TEST(BeamBundlesAgreement, WithoutSoilOrElements) {
  for (const Plot& plot : {unit_plot, unit_stand}) {
    expect_agreement(without_soil(black_model(random_leaves(60, 0.1, 2), plot, beijing_sun())), 20'000, 2'000);
    expect_agreement(black_model({}, plot, beijing_sun()), 5'000, 5'000);
  }
}

TEST(BeamBundlesAgreement, AlongTheAxesOfAGriddedPlate) {
  for (const Plot& plot : {unit_plot, unit_stand}) {
    expect_agreement(black_model(gridded_plate(16), plot, sun_at(90, 0)), 20'000, 4'000);
    for (const double azimuth : {0.0, 90.0, 180.0, 270.0}) {
      expect_agreement(black_model(gridded_plate(8), plot, sun_at(20, azimuth)), 10'000, 2'000);
    }
  }
}

TEST(BeamBundlesAgreement, OnDuplicatesAndCoplanarLeaves) {
  for (const SunPosition& sun : {sun_at(90, 0), sun_at(40, 77)}) {
    expect_agreement(black_model(coplanar_leaves(), unit_plot, sun), 20'000, 5'000);
  }
}

TEST(BeamBundlesAgreement, OnCopiesThatShareATree) {
  for (const Plot& plot : {unit_plot, unit_stand, Plot{0.3, 0.7, true}}) {
    for (const bool of_all_sizes : {false, true}) {
      expect_agreement(stand_of_copies({plot, 12, of_all_sizes, 3}, true), 40'000, 2'000);
    }
  }
}

TEST(BeamBundlesAgreement, OnALeafLargerThanThePlot) {
  MeshMaker maker;
  maker.triangle({-1.3, 0.2, -0.4}, {2.1, 0.9, 0.3}, {0.2, 0.5, 3.7});
  maker.triangle({-2.0, 1.5, 0.5}, {4.0, 1.6, 0.5}, {-2.0, 1.4, 0.55});
  for (const SunPosition& sun : {sun_at(70, 10), sun_at(15, 200)}) {
    expect_agreement(black_model(maker.mesh(), unit_plot, sun), 20'000, 5'000);
  }
}

TEST(BeamBundlesAgreement, WithALowSunOverATinyPlot) {
  MeshMaker maker;
  maker.level(0.01, 0.02, 0.01, 0.02, 12.0);
  add_slivers(maker, 60, 0.05, 6.0, 1e-5, 4);
  maker.level(0.01, 0.04, 0.01, 0.04, 0.01);
  expect_agreement(black_model(maker.mesh(), {0.05, 0.05, true}, sun_at(0.5, 33)), 300, 30);
}

}  // namespace
}  // namespace sunfleck::test
