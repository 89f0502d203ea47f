#pragma once
// A scene as the independent tracer sees it: Embree holds the triangles of one period, and a separate walk leads through the
// copies of an endless plot, cell by cell, with positions in double precision.

#include "physics/transport/model/model.h"

#include <embree3/rtcore.h>

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

namespace sunfleck::test::differential {

// The end of a ray.
struct Landing {
  enum class On { element, soil_plane, sky, below, nowhere };
  On on = On::nowhere;      // nowhere: it crossed too many cells
  std::size_t element = 0;  // of an element
  std::size_t side = 0;     // 0: the upper face
  glm::dvec3 point_m{0.0};  // on an element or the soil plane
  // For a ray that ends below an isolated plot: true if it passed beside the plot, not through it.
  bool beside_plot = false;
};

class World {
 public:
  explicit World(const RadiationModel& model);
  ~World();
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  // Follows a ray to its end. The direction is a unit vector.
  [[nodiscard]] Landing follow(const glm::dvec3& origin_m, const glm::dvec3& direction) const;

  // Returns the start of light that leaves a point of a surface on the side to which `normal` points.
  [[nodiscard]] glm::dvec3 start(const glm::dvec3& point_m, const glm::dvec3& normal) const {
    return point_m + normal * offset_m_;
  }

  [[nodiscard]] const glm::dvec3& lo_m() const { return lo_m_; }  // of all elements and the plot
  [[nodiscard]] const glm::dvec3& hi_m() const { return hi_m_; }
  [[nodiscard]] double ground_y_m() const { return ground_y_m_; }
  [[nodiscard]] double top_y_m() const { return hi_m_.y + 0.01; }
  [[nodiscard]] const glm::dvec3& normal(std::size_t element) const { return normals_[element]; }
  // Returns whether an element coincides with an earlier one; it then neither receives nor emits light.
  [[nodiscard]] bool is_copy(std::size_t element) const { return is_copy_[element]; }

 private:
  struct Meeting {
    double t = 0.0;
    std::size_t element = 0;
    glm::dvec3 point_m{0.0};
  };
  [[nodiscard]] std::optional<Meeting> meet(const glm::dvec3& origin_m, const glm::dvec3& direction, double limit) const;
  [[nodiscard]] std::optional<Meeting> meet_copies(const glm::dvec3& at_m, const glm::dvec3& direction, double limit,
                                                   std::int64_t cell_x, std::int64_t cell_z) const;
  [[nodiscard]] Landing land(const Meeting& meeting, const glm::dvec3& direction) const;
  [[nodiscard]] Landing follow_in_endless_plot(const glm::dvec3& origin_m, const glm::dvec3& direction) const;
  [[nodiscard]] Landing follow_in_isolated_plot(const glm::dvec3& origin_m, const glm::dvec3& direction) const;

  const RadiationModel& model_;
  RTCDevice device_;
  RTCScene scene_;
  std::vector<std::size_t> element_of_;  // [primitive]: copies of earlier triangles are left out
  std::vector<bool> is_copy_;            // [element]
  std::vector<glm::dvec3> normals_;      // [element], of the upper face
  glm::dvec3 lo_m_{0.0}, hi_m_{0.0};
  glm::dvec3 elements_lo_m_{0.0}, elements_hi_m_{0.0};
  double ground_y_m_ = 0.0;
  double offset_m_ = 0.0;
  double depth_m_ = 0.0;  // elements down to this depth below the ground take precedence over it
};

}  // namespace sunfleck::test::differential
