// Tests that packets of one direction that are followed in bundles land where single packets do.
#include "devices/tracers/packet_bundles.h"

#include "devices/tracers/cpu_tracer.h"
#include "physics/light/sun.h"
#include "physics/transport/receivers/sensor_rays.h"
#include "support/copies.h"
#include "support/landings.h"
#include "support/models.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace sunfleck::test {
namespace {

constexpr float any_size = 1e12F;
constexpr float no_size = 0.0F;

std::size_t on_elements(const Landings& landings) {
  return static_cast<std::size_t>(std::count_if(landings.begin(), landings.end(), [](const shared::Landing& landing) {
    return landing.surface < shared::landed_on_ground;
  }));
}

struct PacketCase {
  explicit PacketCase(RadiationModel of) : model(std::move(of)), prepared(model) {}

  // Returns packets that leave each element from some of its points. They start a little before it, on the wrong side, so that they
  // pass the element that they ignore.
  [[nodiscard]] std::vector<shared::Packet> from_elements(const glm::dvec3& direction, int points) const {
    const SensorRays rays(model, prepared.layout);
    Random random(5);
    std::vector<shared::Packet> packets;
    for (std::uint32_t e = 0; e < model.canopy.size(); ++e) {
      const Triangle corners = model.canopy.corners[e];
      MetSurface at;
      at.element = e;
      at.normal = unit_normal(corners);
      for (int k = 0; k < points; ++k) {
        const glm::dvec3 corner(corners[0]);
        at.point_m = corner + random.uniform(0.0, 0.5) * (glm::dvec3(corners[1]) - corner) +
                     random.uniform(0.0, 0.5) * (glm::dvec3(corners[2]) - corner);
        packets.push_back(rays.from(at, direction));
        packets.back().origin -= 1e-3F * packets.back().direction;
      }
    }
    return packets;
  }

  [[nodiscard]] Landings one_by_one(const std::vector<shared::Packet>& packets) const {
    const CpuTracer tracer(prepared.bvh, tracer_scene(model));
    Landings landings;
    for (const shared::Packet& packet : packets) landings.push_back(tracer.follow_packet(scene, packet, 0));
    return landings;
  }

  [[nodiscard]] bool in_bundles(const std::vector<shared::Packet>& packets, float size_squared, Landings& landings) const {
    landings.resize(packets.size());
    return trace_in_bundles(prepared.bvh, scene, tracer_scene(model), size_squared, packets, landings);
  }

  // Expects it of packets that go up and down; returns how many land on elements.
  [[nodiscard]] std::size_t expect_landings_of_single_packets(double height_deg) const {
    std::size_t landed = 0;
    const glm::dvec3 to_sun = direction_to_sun(sun_at(height_deg, 130));
    for (const glm::dvec3& direction : {to_sun, -to_sun}) {
      const std::vector<shared::Packet> packets = from_elements(direction, 5);
      const Landings expected = one_by_one(packets);
      Landings found;
      EXPECT_TRUE(in_bundles(packets, any_size, found));
      EXPECT_EQ(landings_apart(found, expected), 0U);
      landed += on_elements(found);
      CpuTracer tracer(prepared.bvh, tracer_scene(model));
      EXPECT_EQ(landings_apart(follow(tracer, scene, packets), expected), 0U);
    }
    return landed;
  }

  RadiationModel model;
  Prepared prepared;
  shared::PacketBlock scene = make_packet_block(model, prepared.layout);
};

RadiationModel crossing_leaves(const Plot& plot) {
  return black_model(random_leaves(200, 0.1, plot, 0.8, 3), plot, sun_at(40, 130));
}

TEST(PacketBundles, LandWhereSinglePacketsDo) {
  for (const Plot& plot : {unit_plot, unit_stand}) {
    const PacketCase test(crossing_leaves(plot));
    EXPECT_GT(test.expect_landings_of_single_packets(40), 100U);
  }
}

// Packets from low in the sky cross many periods of a plot narrower than a bundle, and leave it by both borders.
TEST(PacketBundles, PassManySmallPeriods) {
  const PacketCase test(crossing_leaves({0.05, 0.08, true}));
  EXPECT_GT(test.expect_landings_of_single_packets(4), 100U);
}

TEST(PacketBundles, MeetCopiesThatShareATree) {
  for (const Plot& plot : {unit_plot, unit_stand}) {
    const PacketCase test(stand_of_copies({plot, 8, true, 2}, true));
    EXPECT_GT(test.expect_landings_of_single_packets(35), 100U);
  }
}

TEST(PacketBundles, AreForNeighboursOfOneDirection) {
  const PacketCase test(crossing_leaves(unit_plot));
  std::vector<shared::Packet> packets = test.from_elements({0.0, 1.0, 0.0}, 2);
  Landings landings;
  EXPECT_FALSE(test.in_bundles(packets, no_size, landings)) << "packets far from each other, compared with the triangles";
  EXPECT_TRUE(test.in_bundles(packets, any_size, landings));
  packets.back().direction.y = 0.5F;
  EXPECT_FALSE(test.in_bundles(packets, any_size, landings));
  EXPECT_FALSE(have_one_direction(packets));
  EXPECT_TRUE(test.in_bundles({packets.front()}, any_size, landings)) << "a single packet";
  EXPECT_TRUE(test.in_bundles({}, any_size, landings));
}

// Many packets leave a large leaf one after the other, close to each other: the tracer takes bundles, and the landings are the same.
TEST(PacketBundles, AreTakenWhereTheyPay) {
  const PacketCase test(crossing_leaves(unit_plot));
  const glm::dvec3 to_sun = direction_to_sun(sun_at(40, 130));
  std::vector<shared::Packet> packets;
  for (const shared::Packet& packet : test.from_elements(to_sun, 1)) {
    for (int k = 0; k < 40; ++k) {
      packets.push_back(packet);
      packets.back().origin.y += 1e-4F * static_cast<float>(k);
    }
  }
  Landings found;
  EXPECT_TRUE(test.in_bundles(packets, triangle_size_squared(test.prepared.bvh), found));
  EXPECT_EQ(landings_apart(found, test.one_by_one(packets)), 0U);
  EXPECT_GT(on_elements(found), 1000U);
}

TEST(PacketBundles, KnowTheSizeOfATypicalTriangle) {
  MeshMaker maker;
  for (int k = 0; k < 9; ++k) maker.level(0.1 * k, 0.1 * k + 0.02, 0.3, 0.35, 0.5);
  maker.level(0.0, 1.0, 0.0, 1.0, 0.1);
  const PacketCase test(black_model(maker.mesh(), unit_stand, sun_at(40, 130)));
  EXPECT_NEAR(triangle_size_squared(test.prepared.bvh), 0.02F * 0.05F, 1e-6F);
  EXPECT_EQ(triangle_size_squared(PacketCase(black_model({}, unit_plot, sun_at(40, 130))).prepared.bvh), 0.0F);
}

}  // namespace
}  // namespace sunfleck::test
