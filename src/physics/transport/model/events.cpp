#include "physics/transport/model/events.h"

#include "physics/transport/model/surfaces.h"

#include <algorithm>

namespace sunfleck {
namespace {

// Returns the largest share of a landing's flux that any surface scatters.
double largest_scattering(const RadiationModel& model, std::size_t band) {
  double largest = model.soil ? model.soil->reflectance[band] : 0.0;
  for (const SurfaceOptics& optics : model.optics) {
    for (const auto* face : {&optics.upper, &optics.lower}) largest = std::max(largest, 1.0 - (*face)[band].absorptance());
  }
  return largest;
}

}  // namespace

double LightEvents::other_w_m2(std::size_t band) const {
  return std::max(sky_w_m2[band], start_w_m2[band] * packet_share[band]);
}

double LightEvents::largest_w_m2(std::size_t band) const {
  return std::max(beam_w_m2[band], other_w_m2(band));
}

// A packet carries what a side of its place sends, divided by the number of packets expected from there. That number is the packets
// of the first round times the mean, over the scattering bands, of the quanta that the side sends divided by all quanta waiting at
// the start. With light in one band only, a packet carries at most that band's start times the number of scattering bands, divided
// by the packets (see PacketDraw). Several lights share these evenly, so that `packets` are those of one light.
LightEvents make_light_events(const RadiationModel& model, const std::vector<BandQuanta>& quanta, const Incidence& incidence) {
  LightEvents events;
  double scattering_bands = 0.0;
  for (std::size_t b = 0; b < quanta.size(); ++b) scattering_bands += scatters(model, b) ? 1.0 : 0.0;
  events.beam_share = incidence.ground_per_ray_m2 / model.plot.area_m2();
  for (std::size_t b = 0; b < quanta.size(); ++b) {
    const double beam_w_m2 = model.has_beam() ? events.beam_share * model.bands[b].direct_w_m2 : 0.0;
    const double sky_w_m2 = static_cast<double>(quanta[b].sky) * quanta[b].w_m2_per_quantum;
    const double lamps_w_m2 = static_cast<double>(quanta[b].lamps) * quanta[b].w_m2_per_quantum;
    events.beam_w_m2.push_back(beam_w_m2);
    events.around_w_m2.push_back(beam_w_m2 * incidence.largest_weight);
    events.sky_w_m2.push_back(incidence.sky_rays > 0 ? sky_w_m2 * incidence.sky_weight / static_cast<double>(incidence.sky_rays)
                                                     : 0.0);
    events.scattering.push_back(largest_scattering(model, b));
    const double first_w_m2 = beam_w_m2 * static_cast<double>(incidence.rays) + sky_w_m2;
    events.start_w_m2.push_back(lamps_w_m2 + first_w_m2 * events.scattering.back());
    events.packet_share.push_back(scatters(model, b) && incidence.packets > 0.0 ? scattering_bands / incidence.packets : 0.0);
  }
  return events;
}

}  // namespace sunfleck
