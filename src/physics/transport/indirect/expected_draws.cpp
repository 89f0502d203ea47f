#include "physics/transport/indirect/expected_draws.h"

#include <limits>

namespace sunfleck {
namespace {

// Rounds are scaled up to at least this many packets.
constexpr double least_packets = 256;

}  // namespace

ExpectedDraws::ExpectedDraws(const IndirectScene& scene, const LightFromAbove& light, double packets,
                             const std::vector<double>& start)
    : scene_(scene), light_(light) {
  double lit = 0.0;
  for (const double flux : start) {
    lit += flux > 0.0 ? 1.0 : 0.0;
    start_or_infinity_.push_back(flux > 0.0 ? flux : std::numeric_limits<double>::infinity());
  }
  packets_per_part_ = packets / lit;
}

void ExpectedDraws::set_parts(const Candidates& candidates, std::size_t first, std::size_t count, std::vector<double>& parts) {
  rows_.clear();
  for (std::size_t k = first; k < first + count; ++k) rows_.push_back(candidates.quanta(k));
  columns::sum_ratios(rows_, start_or_infinity_, std::span(parts).subspan(first, count));
}

void ExpectedDraws::scale(const Candidates& candidates, std::vector<double>& parts) {
  double total = 0.0;
  for (double& part : parts) {
    part *= packets_per_part_;
    total += part;
  }
  if (light_.aim != nullptr) total = aim(candidates, parts, total);
  first_round_ = false;
  if (total < least_packets && total > 0.0) {
    for (double& part : parts) part *= least_packets / total;
  }
}

// Draws more packets near the stand and fewer far away, as many as before in the first round. Returns the new total.
double ExpectedDraws::aim(const Candidates& candidates, std::vector<double>& expected, double before) {
  double after = 0.0;
  for (std::size_t k = 0; k < expected.size(); ++k) {
    expected[k] *= packets_per_flux(candidates.place(k)) * aimed_draws_;
    after += expected[k];
  }
  if (!first_round_ || after == 0.0) return after;
  aimed_draws_ = before / after;
  for (double& e : expected) e *= aimed_draws_;
  return before;
}

double ExpectedDraws::packets_per_flux(const EmissionPoint& place) const {
  if (place.surface == shared::landed_on_ground)
    return light_.aim->packets_per_flux({place.a, scene_.frame.ground_y_m, place.b});
  const std::uint32_t element = place.surface / 2;
  if (!scene_.surfaces.at(element).soil()) return 1.0;
  const Triangle corners = scene_.model.canopy.corners[element];
  const double b = place.a == anywhere ? 1.0 / 3.0 : place.a;
  const double c = place.a == anywhere ? 1.0 / 3.0 : place.b;
  const glm::dvec3 corner(corners[0]);
  return light_.aim->packets_per_flux(corner + (glm::dvec3(corners[1]) - corner) * b + (glm::dvec3(corners[2]) - corner) * c);
}

}  // namespace sunfleck
