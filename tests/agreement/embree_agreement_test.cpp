// Compares our walk with Embree, the independent reference: both meet the same element, except where a ray passes an edge, or
// where two surfaces meet, closer than single precision can distinguish.

#include "agreement/scenes.h"
#include "physics/bvh/build.h"
#include "shared/beam.h"
#include "support/embree.h"

#include <gtest/gtest.h>

#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace sunfleck::test {
namespace {

glm::dvec3 corner_m(const std::array<float, 3>& at) {
  return {at[0], at[1], at[2]};
}

struct JudgedHit {
  bool found = false;
  float t = 0.0F;
  std::uint32_t triangle = 0;
};

// Holds the references of one period in Embree, in the order of the tree's leaves.
class Judge {
 public:
  explicit Judge(const Bvh& bvh) : device_(rtcNewDevice("threads=1")), scene_(rtcNewScene(device_)) {
    rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
    attach_references(device_, scene_, bvh);
    rtcCommitScene(scene_);
  }
  ~Judge() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }
  Judge(const Judge&) = delete;
  Judge& operator=(const Judge&) = delete;

  [[nodiscard]] RTCError error() const { return rtcGetDeviceError(device_); }

  [[nodiscard]] JudgedHit nearest(const shared::Ray& ray, float limit) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRayHit query{ray_of(ray, limit), {}};
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(scene_, &context, &query);
    return {query.hit.geomID != RTC_INVALID_GEOMETRY_ID, query.ray.tfar, query.hit.primID};
  }

 private:
  RTCDevice device_;
  RTCScene scene_;
};

// A ray and a triangle in double precision, seen along the ray.
struct Aim {
  double length_m = 0.0;  // distance from the ray's origin to the farthest corner
  double edge_m = 0.0;    // sideways distance from the ray to the nearest edge
  double t = 0.0;         // distance to the triangle's plane
  double slant = 0.0;     // |cosine| between ray and normal
};

Aim aim_at(const BvhTriangle& triangle, const shared::Ray& ray) {
  const glm::dvec3 along = glm::normalize(glm::dvec3(ray.direction));
  const glm::dvec3 origin(ray.origin);
  const glm::dvec3 corners[3] = {corner_m(triangle.a) - origin, corner_m(triangle.b) - origin, corner_m(triangle.c) - origin};
  Aim aim;
  aim.edge_m = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; ++k) {
    aim.length_m = std::max(aim.length_m, glm::length(corners[k]));
    const glm::dvec3 from = corners[k] - along * glm::dot(corners[k], along);
    const glm::dvec3 to = corners[(k + 1) % 3] - along * glm::dot(corners[(k + 1) % 3], along);
    const glm::dvec3 edge = to - from;
    const double place = std::clamp(-glm::dot(from, edge) / std::max(glm::dot(edge, edge), 1e-300), 0.0, 1.0);
    aim.edge_m = std::min(aim.edge_m, glm::length(from + place * edge));
  }
  const glm::dvec3 normal = glm::normalize(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
  aim.slant = std::abs(glm::dot(normal, along));
  aim.t = glm::dot(normal, corners[0]) / glm::dot(normal, glm::dvec3(ray.direction));
  return aim;
}

// Returns the tolerance of both tests, which shift a corner sideways by a few roundings of its distance L from the origin: ours
// by one for the difference, one for the sum, and 2^-22 for shear (reciprocal and product), together below 2^-21 L on each of
// two axes; Embree's Pluecker coordinates by about as much.
double tolerance_m(const Aim& aim) {
  return std::ldexp(aim.length_m, -20);
}
double tolerance_t(const Aim& aim, const shared::Ray& ray) {
  return tolerance_m(aim) / aim.slant / glm::length(glm::dvec3(ray.direction));
}

bool explained(const Bvh& bvh, const shared::Ray& ray, float limit, const CpuHit& ours, const JudgedHit& theirs) {
  std::vector<Aim> aims;
  if (ours.found) aims.push_back(aim_at(bvh.triangles[ours.triangle], ray));
  if (theirs.found) aims.push_back(aim_at(bvh.triangles[theirs.triangle], ray));
  const Aim& nearer = aims.size() == 2 && aims[1].t < aims[0].t ? aims[1] : aims[0];
  if (nearer.edge_m <= tolerance_m(nearer)) return true;
  if (aims.size() == 1) return std::abs(nearer.t - limit) <= tolerance_t(nearer, ray);
  return std::abs(aims[0].t - aims[1].t) <= tolerance_t(aims[0], ray) + tolerance_t(aims[1], ray);
}

// Counts where our walk and Embree differ, and checks the reason for each difference.
class Comparison {
 public:
  explicit Comparison(const Bvh& bvh) : bvh_(bvh), judge_(bvh) { EXPECT_EQ(judge_.error(), RTC_ERROR_NONE); }

  // Returns our hit.
  CpuHit compare(const shared::Ray& ray, float limit) {
    const CpuHit ours = nearest_hit(bvh_, ray, limit);
    const JudgedHit theirs = judge_.nearest(ray, limit);
    ++rays_;
    hits_ += ours.found ? 1 : 0;
    if (ours.found == theirs.found && (!ours.found || ours.element == bvh_.triangles[theirs.triangle].element)) return ours;
    ++apart_;
    if (explained(bvh_, ray, limit, ours, theirs)) return ours;
    ADD_FAILURE() << "ray " << rays_ << ": element " << (ours.found ? std::to_string(ours.element) : "none") << " at " << ours.t
                  << ", Embree's "
                  << (theirs.found ? std::to_string(bvh_.triangles[theirs.triangle].element) : std::string("none")) << " at "
                  << theirs.t;
    return ours;
  }

  void expect_few() const {
    EXPECT_LE(apart_ * 10'000, rays_) << apart_ << " of " << rays_;
    EXPECT_GE(hits_ * 10, rays_);
    testing::Test::RecordProperty("rays", std::to_string(rays_));
    testing::Test::RecordProperty("apart", std::to_string(apart_));
  }

 private:
  const Bvh& bvh_;
  Judge judge_;
  std::size_t rays_ = 0;
  std::size_t hits_ = 0;
  std::size_t apart_ = 0;
};

TEST(EmbreeAgreement, OnTheSparsePlotsBeam) {
  const RadiationModel model = maize_model({}, beijing_sun());
  const Prepared prepared(model);
  const shared::BeamBlock beam = make_beam_block(model, prepared.layout, 2'000'000, 1, 0);
  Comparison comparison(prepared.bvh);
  for (std::uint32_t number = 0; number < beam.columns * beam.rows; ++number) {
    shared::Ray ray = shared::make_ray(shared::beam_origin(beam, number), beam.direction);
    while (true) {
      const shared::Ground ground = shared::meet_ground(ray, beam.ground);
      const shared::Crossing crossing = shared::next_crossing(ray, beam.period, beam.overlap);
      const CpuHit hit = comparison.compare(ray, std::min(ground.limit, crossing.limit));
      if (hit.found || ground.t <= crossing.t) break;
      ray.origin = shared::enter_next_period(ray, crossing, beam.period);
    }
  }
  comparison.expect_few();
}

TEST(EmbreeAgreement, OnRandomTrianglesFromAllSides) {
  const Canopy canopy = testing_bvh::isolated(testing_bvh::scattered(20'000, 1.0, 0.05, 3));
  const Bvh bvh = build_bvh(canopy, 0x1p-18F);  // 2^-19 of the extent, 2 m
  Comparison comparison(bvh);
  testing_bvh::Random random(4);
  for (int k = 0; k < 200'000; ++k) {
    const glm::vec3 origin = testing_bvh::point(random, 1.0);
    glm::vec3 direction = testing_bvh::point(random, 1.0);
    if (k % 10 == 0) direction[k / 10 % 3] = 0.0F;
    if (k % 30 == 0) direction[(k / 30 + 1) % 3] = -0.0F;
    static_cast<void>(comparison.compare(shared::make_ray(origin, direction), 1e30F));
  }
  comparison.expect_few();
}

}  // namespace
}  // namespace sunfleck::test
