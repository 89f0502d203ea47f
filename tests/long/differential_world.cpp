#include "long/differential_world.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <limits>
#include <map>
#include <stdexcept>

namespace sunfleck::test::differential {
namespace {

constexpr double endless = std::numeric_limits<double>::infinity();
constexpr std::int64_t most_cells = 1'000'000;

using Corner = std::array<float, 3>;

std::array<Corner, 3> sorted_corners(const Triangle& corners) {
  std::array<Corner, 3> sorted;
  for (std::size_t k = 0; k < 3; ++k) sorted[k] = {corners[k].x, corners[k].y, corners[k].z};
  std::sort(sorted.begin(), sorted.end());
  return sorted;
}

}  // namespace

World::World(const RadiationModel& model) : model_(model), device_(rtcNewDevice("threads=1")), scene_(rtcNewScene(device_)) {
  if (model.canopy.origin_m != glm::dvec3(0.0)) throw std::invalid_argument("scenes far from zero are not for this tracer");
  const std::vector<Triangle> elements = model.canopy.corners.all();
  std::map<std::array<Corner, 3>, std::size_t> first_of;
  elements_lo_m_ = glm::dvec3(endless);
  elements_hi_m_ = glm::dvec3(-endless);
  for (std::size_t e = 0; e < elements.size(); ++e) {
    const glm::dvec3 a(elements[e][0]);
    normals_.push_back(glm::normalize(glm::cross(glm::dvec3(elements[e][1]) - a, glm::dvec3(elements[e][2]) - a)));
    is_copy_.push_back(!first_of.try_emplace(sorted_corners(elements[e]), e).second);
    if (!is_copy_[e]) element_of_.push_back(e);
    for (const glm::vec3& corner : elements[e]) {
      elements_lo_m_ = glm::min(elements_lo_m_, glm::dvec3(corner));
      elements_hi_m_ = glm::max(elements_hi_m_, glm::dvec3(corner));
    }
  }
  ground_y_m_ = model.soil ? 0.0 : std::min(0.0, elements_lo_m_.y);
  lo_m_ = glm::min(elements_lo_m_, glm::dvec3(0.0, ground_y_m_, 0.0));
  hi_m_ = glm::max(elements_hi_m_, glm::dvec3(model.plot.size_x_m, 0.0, model.plot.size_z_m));
  const double extent_m = std::max({hi_m_.x - lo_m_.x, hi_m_.y - lo_m_.y, hi_m_.z - lo_m_.z});
  offset_m_ = 2e-6 * extent_m;
  depth_m_ = 2.0 * offset_m_;

  rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
  RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                               3 * sizeof(float), 3 * element_of_.size()));
  auto* numbers = static_cast<unsigned*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned), element_of_.size()));
  for (const std::size_t e : element_of_) {
    for (const glm::vec3& corner : elements[e]) {
      for (int axis = 0; axis < 3; ++axis) *vertices++ = corner[axis];
    }
  }
  for (unsigned k = 0; k < 3 * element_of_.size(); ++k) numbers[k] = k;
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene_, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene_);
  if (rtcGetDeviceError(device_) != RTC_ERROR_NONE) throw std::runtime_error("Embree takes no triangles");
}

World::~World() {
  rtcReleaseScene(scene_);
  rtcReleaseDevice(device_);
}

Landing World::follow(const glm::dvec3& origin_m, const glm::dvec3& direction) const {
  return model_.plot.periodic ? follow_in_endless_plot(origin_m, direction) : follow_in_isolated_plot(origin_m, direction);
}

// Finds the triangle met at its own place.
std::optional<World::Meeting> World::meet(const glm::dvec3& origin_m, const glm::dvec3& direction, double limit) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  const glm::vec3 from(origin_m);
  const glm::vec3 along(direction);
  RTCRayHit query{};
  query.ray = {from.x, from.y, from.z, 0.0F, along.x, along.y, along.z, 0.0F, static_cast<float>(limit), ~0U, 0, 0};
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(scene_, &context, &query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  const std::size_t element = element_of_[query.hit.primID];
  const Triangle& corners = model_.canopy.corners[element];
  const glm::dvec3 a(corners[0]);
  const glm::dvec3 point_m =
      a + (glm::dvec3(corners[1]) - a) * double{query.hit.u} + (glm::dvec3(corners[2]) - a) * double{query.hit.v};
  return Meeting{query.ray.tfar, element, point_m};
}

// Finds the nearest copy of a triangle that reaches into a cell, starting from a point in the cell.
std::optional<World::Meeting> World::meet_copies(const glm::dvec3& at_m, const glm::dvec3& direction, double limit,
                                                 std::int64_t cell_x, std::int64_t cell_z) const {
  const glm::dvec2 period_m = model_.canopy.period_m;
  const auto back = [](double reach_m, double period) {
    return static_cast<std::int64_t>(std::floor(reach_m / period + 1e-9));
  };
  const glm::dvec3 margin_m(depth_m_);
  std::optional<Meeting> nearest;
  const std::int64_t first_x = cell_x - back(elements_hi_m_.x, period_m.x);
  const std::int64_t last_x = cell_x + back(-elements_lo_m_.x, period_m.x) + 1;
  const std::int64_t first_z = cell_z - back(elements_hi_m_.z, period_m.y);
  const std::int64_t last_z = cell_z + back(-elements_lo_m_.z, period_m.y) + 1;
  for (std::int64_t x = first_x; x <= last_x; ++x) {
    for (std::int64_t z = first_z; z <= last_z; ++z) {
      const glm::dvec3 away_m(static_cast<double>(x) * period_m.x, 0.0, static_cast<double>(z) * period_m.y);
      const glm::dvec3 from_m = at_m - away_m;
      const glm::dvec3 to_m = from_m + direction * limit;
      if (glm::any(glm::lessThan(glm::max(from_m, to_m), elements_lo_m_ - margin_m))) continue;
      if (glm::any(glm::greaterThan(glm::min(from_m, to_m), elements_hi_m_ + margin_m))) continue;
      const auto meeting = meet(from_m, direction, nearest ? nearest->t : limit);
      if (!meeting || (nearest && meeting->t >= nearest->t)) continue;
      nearest = meeting;
      nearest->point_m += away_m;
    }
  }
  return nearest;
}

Landing World::land(const Meeting& meeting, const glm::dvec3& direction) const {
  const bool upper = glm::dot(normals_[meeting.element], direction) < 0.0;
  return {Landing::On::element, meeting.element, upper ? std::size_t{0} : std::size_t{1}, meeting.point_m, false};
}

Landing World::follow_in_endless_plot(const glm::dvec3& origin_m, const glm::dvec3& direction) const {
  const bool down = direction.y < 0.0;
  const double end = std::max(0.0, ((down ? ground_y_m_ : top_y_m()) - origin_m.y) / direction.y);
  const double last_limit = down ? end - depth_m_ / direction.y : end;
  const glm::dvec2 period_m = model_.canopy.period_m;
  auto cell_x = static_cast<std::int64_t>(std::floor(origin_m.x / period_m.x));
  auto cell_z = static_cast<std::int64_t>(std::floor(origin_m.z / period_m.y));
  const auto border = [](double origin, double along, double period, std::int64_t cell) {
    if (along == 0.0) return endless;
    return (static_cast<double>(cell + (along > 0.0 ? 1 : 0)) * period - origin) / along;
  };
  const double margin = 1e-6 * std::max(period_m.x, period_m.y);
  double t = 0.0;
  for (std::int64_t cells = 0; cells < most_cells; ++cells) {
    const double to_x = border(origin_m.x, direction.x, period_m.x, cell_x);
    const double to_z = border(origin_m.z, direction.z, period_m.y, cell_z);
    const double leave = std::max(t, std::min(to_x, to_z));
    const double limit = std::min(leave + margin, last_limit) - t;
    if (limit >= 0.0) {
      const auto meeting = meet_copies(origin_m + direction * t, direction, limit, cell_x, cell_z);
      if (meeting) return land(*meeting, direction);
    }
    if (end <= leave) {
      if (!down) return {Landing::On::sky};
      if (!model_.soil) return {Landing::On::below};
      glm::dvec3 point_m = origin_m + direction * end;
      point_m.y = ground_y_m_;
      return {Landing::On::soil_plane, 0, 0, point_m, false};
    }
    t = leave;
    if (to_x <= to_z) cell_x += direction.x > 0.0 ? 1 : -1;
    if (to_z <= to_x) cell_z += direction.z > 0.0 ? 1 : -1;
  }
  return {Landing::On::nowhere};
}

// The ground stops light only from above. Light that starts slightly below it, from the lower face of an element that lies in
// it, counts as coming from above.
Landing World::follow_in_isolated_plot(const glm::dvec3& origin_m, const glm::dvec3& direction) const {
  const bool down = direction.y < 0.0;
  const double to_ground = std::max(0.0, (ground_y_m_ - origin_m.y) / direction.y);
  glm::dvec3 on_ground_m = origin_m + direction * to_ground;
  on_ground_m.y = ground_y_m_;
  const bool through_plot = down && origin_m.y >= ground_y_m_ - 2.0 * depth_m_ && on_ground_m.x >= 0.0 &&
                            on_ground_m.x <= model_.plot.size_x_m && on_ground_m.z >= 0.0 &&
                            on_ground_m.z <= model_.plot.size_z_m;
  const double limit = through_plot ? to_ground - depth_m_ / direction.y : endless;
  if (const auto meeting = meet(origin_m, direction, limit)) return land(*meeting, direction);
  if (!down) return {Landing::On::sky};
  if (through_plot && model_.soil) return {Landing::On::soil_plane, 0, 0, on_ground_m, false};
  return {Landing::On::below, 0, 0, {}, !through_plot};
}

}  // namespace sunfleck::test::differential
