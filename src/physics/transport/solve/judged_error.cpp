#include "physics/transport/solve/judged_error.h"

#include "base/units.h"
#include "physics/transport/model/accuracy.h"

#include <algorithm>
#include <cmath>

namespace sunfleck {
namespace {

// Returns the largest relative half-width of the organs' beam landings, or of their absorption of all other light.
JudgedError organ_error(const RunSums& sums, double quantile, bool indirect) {
  const Conversion& conversion = sums.conversion;
  std::vector<bool> other(sums.organs.size());  // holds something that is no vegetation
  for (const Surface& surface : conversion.surfaces.of) {
    if (!is_vegetation(surface.role)) other[surface.organ] = true;
  }
  JudgedError largest;
  for (std::size_t b = 0; b < (indirect ? sums.bands.size() : 1); ++b) {
    const auto mean_of = [&](std::size_t o) -> const ReplicateMean& {
      return indirect ? sums.organs[o].indirect_absorbed[b] : sums.organs[o].landed;
    };
    double sum = 0.0;
    double count = 0.0;
    for (std::size_t o = 0; o < sums.organs.size(); ++o) {
      if (other[o]) continue;
      sum += mean_of(o).mean() * conversion.areas.organ_m2[o];
      count += 1.0;
    }
    for (std::size_t o = 0; o < sums.organs.size(); ++o) {
      const double flux = mean_of(o).mean() * conversion.areas.organ_m2[o];
      if (other[o] || flux <= 0.0 || flux < least_judged_organ * sum / count) continue;
      const double error = quantile * mean_of(o).standard_error() / mean_of(o).mean();
      JudgedFigure figure{.of = JudgedFigure::Of::organ, .organ = o};
      if (indirect) figure.band = b;
      largest.raise({error + (indirect ? sums.unshot_share_of_scattered(b) : 0.0), figure});
    }
  }
  return largest;
}

// Returns the root-mean-square half-width relative to the mean. `spreads` are those of the elements' landings or of their W
// m-2, one per element from `first` on; the latter are multiplied by the element's area.
double element_rms_error(const RunSums& sums, double quantile, const std::vector<Spread>& spreads, std::size_t first) {
  if (spreads.empty()) return no_value;
  const bool landings = &spreads == &sums.direct_spread;
  const Conversion& conversion = sums.conversion;
  double area = 0.0;
  double flux = 0.0;
  double squares = 0.0;
  for (std::size_t e = 0; e < sums.elements.size(); ++e) {
    const double element_m2 = area_m2(conversion.model.canopy.corners[e]);
    if (!is_vegetation(conversion.surfaces.at(e).role) || element_m2 <= 0.0) continue;
    const double to_flux = landings ? 1.0 : element_m2;
    const double half = spreads[first + e].half_width(quantile, sums.replicates) * to_flux;
    area += element_m2;
    flux += spreads[first + e].sum * to_flux / static_cast<double>(sums.replicates);
    squares += half * half / element_m2;
  }
  return flux > 0.0 ? std::sqrt(squares / area) * area / flux : 0.0;
}

}  // namespace

void JudgedError::raise(const JudgedError& other) {
  if (other.relative > relative) *this = other;
}

JudgedError direct_error(const RunSums& sums, const Accuracy& accuracy) {
  const Conversion& conversion = sums.conversion;
  const double quantile = t_quantile(accuracy.confidence, sums.replicates);
  if (std::isnan(quantile)) return {no_value, {}};
  JudgedError largest;
  const double met = sums.met.mean();
  if (!(met > 0.0)) return largest;
  const double one_ray = sums.unseen(conversion.events.beam_share, accuracy.confidence);
  const auto judge = [&](const ReplicateMean& mean, bool can_vary, double least, JudgedFigure::Of of) {
    largest.raise({mean.estimate(quantile, can_vary ? one_ray : 0.0).half_width / std::max(mean.mean(), least), {.of = of}});
  };
  judge(sums.first_vegetation, conversion.areas.beam_meets_vegetation, conversion.least_share_of_vegetation() * met,
        JudgedFigure::Of::vegetation);
  // With nothing in its way the whole beam is known to reach the ground.
  judge(sums.first_ground, conversion.areas.beam_meets_canopy(), least_judged_share * met, JudgedFigure::Of::soil);
  if (accuracy.of == ErrorTarget::organ) {
    largest.raise(organ_error(sums, quantile, false));
  }
  if (accuracy.of == ErrorTarget::triangle && !sums.direct_spread.empty()) {
    largest.raise({element_rms_error(sums, quantile, sums.direct_spread, 0), {.of = JudgedFigure::Of::triangles}});
  }
  return largest;
}

JudgedError indirect_error(const RunSums& sums, const Accuracy& accuracy) {
  const Conversion& conversion = sums.conversion;
  const double quantile = t_quantile(accuracy.confidence, sums.replicates);
  if (std::isnan(quantile)) return {no_value, {}};
  JudgedError largest;
  const auto n = static_cast<double>(sums.replicates);
  const LightEvents events = sums.events(accuracy.confidence);
  for (std::size_t b = 0; b < sums.bands.size(); ++b) {
    const double per_quantum = conversion.quanta[b].w_m2_per_quantum;
    const double least = least_judged_share * static_cast<double>(sums.ledgers[b].incident) * per_quantum / n;
    if (!(least > 0.0)) continue;
    const double unshot = sums.unshot_w_m2(b);
    const double one_packet = sums.unseen(events.other_w_m2(b), accuracy.confidence);
    const auto judge = [&](const ReplicateMean& mean, double absorptance, double at_least, JudgedFigure::Of of) {
      const double half_width = mean.estimate(quantile, one_packet * absorptance).half_width;
      largest.raise({(half_width + unshot) / std::max(mean.mean(), at_least), {.of = of, .band = b}});
    };
    const double of_vegetation =
        std::max(least_judged_share * sums.bands[b].vegetation.mean(), conversion.least_of_vegetation_w_m2(b));
    judge(sums.bands[b].indirect_vegetation, conversion.areas.vegetation_absorptance[b], of_vegetation,
          JudgedFigure::Of::vegetation);
    judge(sums.bands[b].indirect_soil, conversion.areas.soil_absorptance[b], least, JudgedFigure::Of::soil);
  }
  if (accuracy.of == ErrorTarget::organ) {
    largest.raise(organ_error(sums, quantile, true));
  }
  if (accuracy.of == ErrorTarget::triangle && !sums.indirect_spread.empty()) {
    for (std::size_t b = 0; b < sums.bands.size(); ++b) {
      largest.raise({element_rms_error(sums, quantile, sums.indirect_spread, b * sums.elements.size()),
                     {.of = JudgedFigure::Of::triangles, .band = b}});
    }
  }
  return largest;
}

}  // namespace sunfleck
