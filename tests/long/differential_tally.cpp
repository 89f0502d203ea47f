#include "long/differential_tally.h"

#include <algorithm>
#include <numeric>

namespace sunfleck::test::differential {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

double share(double part, double whole) {
  return whole > 0.0 ? part / whole : none;
}

// Returns true if a place lies above a plane of that height. Everything but soil lies above a plane at the ground.
bool is_above(const Height& height, double plane_y_m) {
  return height.y_m > Height::lowest && (plane_y_m <= 0.0 || height.y_m >= plane_y_m);
}

}  // namespace

Tally::Tally(const RadiationModel& model, const Survey& survey)
    : model_(model), survey_(survey), bands_(model.bands.size()), vegetation_w_(bands_) {
  structure_w_ = soil_w_ = reflected_w_ = transmitted_w_ = vegetation_w_;
  side_beam_w_.resize(2 * model.canopy.size() * bands_);
  side_other_w_ = side_beam_w_;
  const auto rows = static_cast<std::size_t>(model.layers);
  row_down_w_.resize((rows + 1) * bands_);
  row_up_w_ = row_down_w_;
  row_absorbed_w_.resize(rows * bands_);
  row_structure_w_ = row_absorbed_w_;
  plane_down_w_.resize(model.planes.size() * bands_);
  plane_reached_m2_.resize(model.planes.size());
  plane_crossing_m2_.resize(model.planes.size());
  organ_lit_m2_.resize(model.canopy.organs.size());
  row_lit_m2_.resize(rows);
  row_below_m2_.resize(rows + 1);
}

Height Tally::above_all() const {
  return {std::numeric_limits<double>::infinity(), model_.layers};
}

Height Tally::height_of(const Landing& landing) const {
  if (landing.on == Landing::On::sky) return above_all();
  if (landing.on != Landing::On::element) return {};
  return height_of_lamp(landing.element, landing.point_m);
}

Height Tally::height_of_lamp(std::size_t element, const glm::dvec3& point_m) const {
  if (survey_.is_soil(element)) return {};
  return {point_m.y, static_cast<int>(survey_.row_at(point_m.y))};
}

bool Tally::crosses_plot(const Ray& ray, double y_m) const {
  if (model_.plot.periodic) return true;
  const glm::dvec3 at_m = ray.origin_m + ray.direction * ((y_m - ray.origin_m.y) / ray.direction.y);
  return at_m.x >= 0.0 && at_m.x < model_.plot.size_x_m && at_m.z >= 0.0 && at_m.z < model_.plot.size_z_m;
}

void Tally::add_sunlight(const Ray& ray, const Landing& landing, double ground_m2) {
  const Height height = height_of(landing);
  for (std::size_t p = 0; p < model_.planes.size(); ++p) {
    if (!crosses_plot(ray, model_.planes[p].height_m)) continue;
    plane_crossing_m2_[p] += ground_m2;
    if (!is_above(height, model_.planes[p].height_m)) plane_reached_m2_[p] += ground_m2;
  }
  if (landing.beside_plot) return;
  met_m2_ += ground_m2;
  for (std::size_t row = 0; row < row_below_m2_.size(); ++row) {
    if (height.row < static_cast<int>(row)) row_below_m2_[row] += ground_m2;
  }
  if (height.row < 0) ground_m2_ += ground_m2;
  if (landing.on != Landing::On::element) return;
  const double lit_m2 = ground_m2 * survey_.lit_per_ground(landing.element);
  organ_lit_m2_[model_.canopy.organ_of[landing.element]] += lit_m2;
  if (!survey_.is_foliage(landing.element)) return;
  foliage_lit_m2_ += lit_m2;
  row_lit_m2_[static_cast<std::size_t>(height.row)] += lit_m2;
}

void Tally::add(const Ray& ray, const Height& from, const Landing& landing, std::span<const double> flux_w, Carried carried) {
  if (landing.on == Landing::On::nowhere) return;
  const Height to = height_of(landing);
  pass_planes(ray, from, to, flux_w);
  if (landing.beside_plot && carried != Carried::sent) return;
  pass_profile(from, to, flux_w);
  if (landing.on == Landing::On::element) land_on_element(landing, flux_w, carried);
  for (std::size_t b = 0; b < bands_; ++b) {
    if (landing.on == Landing::On::sky) reflected_w_[b] += flux_w[b];
    if (landing.on == Landing::On::below) transmitted_w_[b] += flux_w[b];
    if (landing.on == Landing::On::soil_plane) soil_w_[b] += flux_w[b] * (1.0 - model_.soil->reflectance[b]);
  }
}

void Tally::land_on_element(const Landing& landing, std::span<const double> flux_w, Carried carried) {
  std::vector<double>& side_w = carried == Carried::beam ? side_beam_w_ : side_other_w_;
  const SurfaceOptics& optics = model_.optics[model_.canopy.optics_of[landing.element]];
  const std::vector<FaceOptics>& face = landing.side == 0 ? optics.upper : optics.lower;
  const bool soil = survey_.is_soil(landing.element);
  const bool structure = survey_.is_structure(landing.element);
  const std::size_t row = soil ? 0 : survey_.row_at(landing.point_m.y);
  for (std::size_t b = 0; b < bands_; ++b) {
    side_w[(2 * landing.element + landing.side) * bands_ + b] += flux_w[b];
    const double absorbed_w = flux_w[b] * (1.0 - face[b].reflectance - face[b].transmittance);
    (soil ? soil_w_ : structure ? structure_w_ : vegetation_w_)[b] += absorbed_w;
    if (!soil) (structure ? row_structure_w_ : row_absorbed_w_)[row * bands_ + b] += absorbed_w;
  }
}

void Tally::pass_profile(const Height& from, const Height& to, std::span<const double> flux_w) {
  std::vector<double>& passed_w = from.row > to.row ? row_down_w_ : row_up_w_;
  for (int row = std::min(from.row, to.row); row < std::max(from.row, to.row); ++row) {
    const int upper_edge = row + 1;
    const std::size_t edge = static_cast<std::size_t>(upper_edge) * bands_;
    for (std::size_t b = 0; b < bands_; ++b) passed_w[edge + b] += flux_w[b];
  }
}

void Tally::pass_planes(const Ray& ray, const Height& from, const Height& to, std::span<const double> flux_w) {
  for (std::size_t p = 0; p < model_.planes.size(); ++p) {
    const double y_m = model_.planes[p].height_m;
    if (!is_above(from, y_m) || is_above(to, y_m) || !crosses_plot(ray, y_m)) continue;
    for (std::size_t b = 0; b < bands_; ++b) plane_down_w_[p * bands_ + b] += flux_w[b];
  }
}

double Tally::absorbed_by_element_w(std::size_t element, std::size_t band) const {
  const SurfaceOptics& optics = model_.optics[model_.canopy.optics_of[element]];
  double absorbed_w = 0.0;
  for (std::size_t side = 0; side < 2; ++side) {
    const FaceOptics& face = (side == 0 ? optics.upper : optics.lower)[band];
    const std::size_t place = (2 * element + side) * bands_ + band;
    absorbed_w += (side_beam_w_[place] + side_other_w_[place]) * (1.0 - face.reflectance - face.transmittance);
  }
  return absorbed_w;
}

double Tally::organ_value(const Figure& figure) const {
  if (figure.of == Of::organ_sunlit) return share(organ_lit_m2_[figure.place], survey_.organ_facing_m2()[figure.place]);
  double sum_w = 0.0;
  for (std::size_t e = 0; e < model_.canopy.size(); ++e) {
    if (model_.canopy.organ_of[e] != figure.place) continue;
    if (figure.of == Of::organ_absorbed) sum_w += absorbed_by_element_w(e, figure.band);
    const std::vector<double>& side_w = figure.of == Of::organ_direct ? side_beam_w_ : side_other_w_;
    for (std::size_t side = 0; side < 2 && figure.of != Of::organ_absorbed; ++side) {
      sum_w += side_w[(2 * e + side) * bands_ + figure.band];
    }
  }
  return sum_w / survey_.organ_m2()[figure.place];
}

double Tally::row_value(const Figure& figure) const {
  const std::size_t place = figure.place * bands_ + figure.band;
  if (figure.of == Of::row_ratio) return survey_.has_beam() ? share(row_below_m2_[figure.place], met_m2_) : none;
  if (figure.of == Of::row_sunlit) return share(row_lit_m2_[figure.place], survey_.row_facing_m2()[figure.place]);
  if (figure.of == Of::row_down) return row_down_w_[place] / model_.plot.area_m2();
  if (figure.of == Of::row_up) return row_up_w_[place] / model_.plot.area_m2();
  return (figure.of == Of::row_structure ? row_structure_w_ : row_absorbed_w_)[place] / model_.plot.area_m2();
}

double Tally::value(const Figure& figure) const {
  const double plot_m2 = model_.plot.area_m2();
  const std::vector<double>& facing_m2 = survey_.row_facing_m2();
  const std::size_t place = figure.place * bands_ + figure.band;
  switch (figure.of) {
    case Of::absorbed_vegetation:
      return vegetation_w_[figure.band] / plot_m2;
    case Of::absorbed_structure:
      return structure_w_[figure.band] / plot_m2;
    case Of::absorbed_soil:
      return soil_w_[figure.band] / plot_m2;
    case Of::reflected:
      return reflected_w_[figure.band] / plot_m2;
    case Of::transmitted:
      return transmitted_w_[figure.band] / plot_m2;
    case Of::sunlit_leaves:
      return share(foliage_lit_m2_, std::accumulate(facing_m2.begin(), facing_m2.end(), 0.0));
    case Of::sunlit_ground:
      return survey_.has_beam() ? share(ground_m2_, met_m2_) : none;
    case Of::organ_sunlit:
    case Of::organ_direct:
    case Of::organ_indirect:
    case Of::organ_absorbed:
      return organ_value(figure);
    case Of::element_absorbed:
      return absorbed_by_element_w(figure.place, figure.band) / survey_.element_m2()[figure.place];
    case Of::side:
      return (side_beam_w_[place] + side_other_w_[place]) / survey_.element_m2()[figure.place / 2];
    case Of::row_ratio:
    case Of::row_sunlit:
    case Of::row_down:
    case Of::row_up:
    case Of::row_absorbed:
    case Of::row_structure:
      return row_value(figure);
    case Of::plane_ratio:
      return share(plane_reached_m2_[figure.place], plane_crossing_m2_[figure.place]);
    case Of::plane_down:
      return plane_down_w_[place] / plot_m2;
    case Of::sensor_direct:
    case Of::sensor_sky:
    case Of::sensor_scattered:
      break;  // computed by Paths::read
  }
  return none;
}

}  // namespace sunfleck::test::differential
