#pragma once
// Adds up one batch of the independent tracer in double precision, and computes the figures from it.

#include "long/differential_figures.h"
#include "long/differential_light.h"
#include "long/differential_world.h"
#include "physics/transport/model/model.h"

#include <limits>
#include <span>
#include <vector>

namespace sunfleck::test::differential {

// Everything that follows from the scene alone: roles and areas of elements, rows of the profile.
class Survey {
 public:
  Survey(const RadiationModel& model, const World& world, const Light& light);

  [[nodiscard]] bool is_soil(std::size_t element) const { return soil_[element]; }
  [[nodiscard]] bool is_structure(std::size_t element) const { return structure_[element]; }  // or a lamp
  [[nodiscard]] bool is_foliage(std::size_t element) const { return foliage_[element]; }
  [[nodiscard]] bool has_beam() const { return has_beam_; }

  // Returns the area of a leaf that is lit by a square metre of the beam, measured on level ground; 0 if the beam cannot hit
  // it.
  [[nodiscard]] double lit_per_ground(std::size_t element) const { return lit_per_ground_[element]; }

  // Returns the row of the profile that holds a height.
  [[nodiscard]] std::size_t row_at(double y_m) const;

  [[nodiscard]] const std::vector<double>& element_m2() const { return element_m2_; }
  [[nodiscard]] const std::vector<double>& organ_m2() const { return organ_m2_; }
  [[nodiscard]] const std::vector<double>& organ_facing_m2() const { return organ_facing_m2_; }  // that the beam can hit
  [[nodiscard]] const std::vector<double>& row_facing_m2() const { return row_facing_m2_; }      // of foliage

 private:
  void find_roles(const RadiationModel& model);
  void find_facing(const RadiationModel& model, const World& world, const Light& light);
  void measure(const RadiationModel& model);

  bool has_beam_;
  double height_m_ = 0.0;  // of all rows
  std::size_t rows_;
  std::vector<bool> soil_, structure_, foliage_;  // [element]
  std::vector<double> lit_per_ground_, element_m2_;
  std::vector<double> organ_m2_, organ_facing_m2_, row_facing_m2_;
};

// Where a straight path begins or ends, as far as planes are concerned: soil and everything below it count as lowest.
struct Height {
  static constexpr double lowest = -std::numeric_limits<double>::infinity();
  double y_m = lowest;
  int row = -1;  // row of the profile; the number of rows for a place above all of them
};

// The light on a straight path: the sun's beam, light from the sky before its first landing, or light sent by lamps and
// surfaces.
enum class Carried { beam, sky, sent };

class Tally {
 public:
  Tally(const RadiationModel& model, const Survey& survey);

  // Adds a ray of the beam that represents this area of level ground to the shares in direct sun.
  void add_sunlight(const Ray& ray, const Landing& landing, double ground_m2);

  // Adds flux by band, on its path and at its landing. Light that passes beside an isolated plot before any landing
  // counts only for planes.
  void add(const Ray& ray, const Height& from, const Landing& landing, std::span<const double> flux_w, Carried carried);

  [[nodiscard]] Height height_of(const Landing& landing) const;
  [[nodiscard]] Height height_of_lamp(std::size_t element, const glm::dvec3& point_m) const;
  [[nodiscard]] Height above_all() const;

  [[nodiscard]] double value(const Figure& figure) const;

 private:
  void land_on_element(const Landing& landing, std::span<const double> flux_w, Carried carried);
  void pass_profile(const Height& from, const Height& to, std::span<const double> flux_w);
  void pass_planes(const Ray& ray, const Height& from, const Height& to, std::span<const double> flux_w);
  [[nodiscard]] bool crosses_plot(const Ray& ray, double y_m) const;
  [[nodiscard]] double absorbed_by_element_w(std::size_t element, std::size_t band) const;
  [[nodiscard]] double organ_value(const Figure& figure) const;
  [[nodiscard]] double row_value(const Figure& figure) const;

  const RadiationModel& model_;
  const Survey& survey_;
  std::size_t bands_;
  std::vector<double> vegetation_w_, structure_w_, soil_w_, reflected_w_, transmitted_w_;  // [band]
  std::vector<double> side_beam_w_, side_other_w_;                                         // [side * bands + band]
  std::vector<double> row_down_w_, row_up_w_;                 // [row * bands + band], last the top plane
  std::vector<double> row_absorbed_w_, row_structure_w_;      // [row * bands + band]
  std::vector<double> plane_down_w_;                          // [plane * bands + band]
  std::vector<double> plane_reached_m2_, plane_crossing_m2_;  // [plane]
  std::vector<double> organ_lit_m2_, row_lit_m2_;
  std::vector<double> row_below_m2_;  // [row], level ground of the beam that lands below the row's lower edge
  double met_m2_ = 0.0, ground_m2_ = 0.0, foliage_lit_m2_ = 0.0;
};

}  // namespace sunfleck::test::differential
