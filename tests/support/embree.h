#pragma once
// Runs Embree, the independent reference for hits and speed, on the same triangles as our tree.

#include "physics/bvh/bvh.h"
#include "shared/beam.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <array>

namespace sunfleck::test {

// Attaches the references of one period to the scene, in the order of the tree's leaves; the caller commits the scene.
inline void attach_references(RTCDevice device, RTCScene scene, const Bvh& bvh) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                               3 * sizeof(float), 3 * bvh.triangles.size()));
  auto* numbers = static_cast<unsigned*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                                 3 * sizeof(unsigned), bvh.triangles.size()));
  for (const BvhTriangle& triangle : bvh.triangles) {
    for (const auto& at : {triangle.a, triangle.b, triangle.c}) vertices = std::copy(at.begin(), at.end(), vertices);
  }
  for (unsigned k = 0; k < 3 * bvh.triangles.size(); ++k) numbers[k] = k;
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene, geometry);
  rtcReleaseGeometry(geometry);
}

inline RTCRay ray_of(const shared::Ray& ray, float limit) {
  return {ray.origin.x,
          ray.origin.y,
          ray.origin.z,
          0.0F,
          ray.direction.x,
          ray.direction.y,
          ray.direction.z,
          0.0F,
          limit,
          ~0U,
          0,
          0};
}

}  // namespace sunfleck::test
