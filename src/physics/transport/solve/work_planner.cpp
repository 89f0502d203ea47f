#include "physics/transport/solve/work_planner.h"

#include "physics/light/beam_grid.h"
#include "physics/transport/model/statistics.h"

#include <algorithm>
#include <cmath>

#include <limits>
#include <numeric>

namespace sunfleck {
namespace {

// How far pilots forecast.
struct Forecast {
  double trusted;  // largest multiple of the pilots' own work that they are trusted to forecast
  double next;     // larger pilots have the forecast work divided by this

  // Returns the work of the next pilots; that of these if their forecast is trusted.
  [[nodiscard]] double next_pilot(double pilot, double forecast) const {
    return forecast > trusted * pilot ? forecast / next : pilot;
  }
};
// Pilots with a twentieth of the rays cost about a tenth of the run: their rays lie further apart, which makes each dearer, so
// that another series costs more than what a less certain forecast of the rays wastes. The slope of packets is known.
constexpr Forecast ray_forecast{64, 20};
constexpr Forecast packet_forecast{128, 64};
// Lights that need fewer rays than another one, and replicates that hold fewer packets than asked, get this multiple of the rays
// that their own errors ask for: errors from pilots are uncertain, and a beam that lags behind costs more replicates with all of
// their packets.
constexpr double spare_of_rays = 1.5;
// All lights of a simulation get up to this multiple while their rays together stay cheap beside the packets, and no light gets fewer
// than the least number of rays for each packet: a packet of six lights takes the time of twenty rays.
constexpr double most_spare_of_rays = 2.0;
constexpr double least_rays_per_packet = 0.25;
double cheap_rays_per_packet(std::size_t lights) {
  return 1.0 + 0.5 * static_cast<double>(lights);
}
// Largest multiple by which a run changes the work for the next one.
constexpr double most_change = 16;
// Packets start where beam rays landed, so that more of them than this for each ray lessen the error little: what a small leaf gets
// from a wide floor depends on the few landings near it.
constexpr double most_packets_per_ray = 8.0;
// Half of a limit on rays or time is enough for this many replicates.
constexpr int least_replicates = 8;
// Exponents by which errors fall. The sampling error of a jittered grid falls with rays^-3/4 on shadow edges (validation
// G3), and more slowly while its cells are not yet small compared with the leaves: with rays^-0.7 neither pass waited for the
// other in maize. The error of packets falls with packets^-1/2.
constexpr double ray_slope = 0.70;
constexpr double packet_slope = 0.5;
// What the program takes from the system at most for a byte of its arrays, where large pages serve arrays of a few megabytes: a
// stated limit is kept with it.
constexpr double most_memory_per_byte = 1.35;
// Sky rays per packet of the first round when the work is not fixed, and the largest number of sky rays in one replicate.
constexpr double sky_rays_per_packet = 2.0;
// Light that reaches a small stand by way of a wide floor needs more packets, not more sky rays.
constexpr double aimed_sky_rays_per_packet = 0.5;
constexpr double most_sky_rays = 0x1p22;
// A replicate whose packets take more memory than this gains nothing: more replicates do the same work.
constexpr double comfortable_bytes = 0x1p28;
// A bound that holds for each organ is met last by the organ whose error happens to look largest. More, smaller replicates know
// their errors better: a run to 1 % on the sparse plot then needs a fifth fewer packets.
constexpr double comfortable_bytes_for_organs = 0x1p27;
// A ray costs a quarter of a packet, but more than a packet if it is traced again to find its landing, as most are here. Where
// there are many packets for organs, there is at least this number of rays for each, lest packets go on while the beam on some
// organ is still uncertain.
constexpr double rays_per_packet_for_organs = 0.5;
// Four packets then share a landing, which did not raise the errors; small replicates, as in pilots, need one for each packet.
constexpr double sampled_rays_per_packet_for_organs = 0.25;
constexpr double least_sampled_rays = 0x1p16;

// Returns the factor by which the work must grow for an error to fall to its bound.
double growth(double error, double bound, double slope) {
  return std::pow(error / bound, 1.0 / slope);
}

// Returns the ratio of the half-widths that `replicates` would give to those that `done` gave.
double half_width_ratio(std::size_t done, int replicates, double confidence) {
  return std::sqrt(static_cast<double>(done) / replicates) * t_quantile(confidence, static_cast<std::size_t>(replicates)) /
         t_quantile(confidence, done);
}

}  // namespace

int WorkPlanner::asked_replicates() const {
  return settings_.passes.value_or(settings_.grid_m ? fixed_grid_replicates : planned_replicates);
}

std::optional<Work> WorkPlanner::choose(const RunPilots& run_pilots) {
  const bool needs_pilots = !settings_.grid_m || (maker_.has_indirect_pass() && !settings_.packets);
  std::optional<Work> work = needs_pilots ? choose_by_pilots(run_pilots) : Work{};
  if (!work || !settings_.grid_m) return work;
  work->rays = grid_rays_asked();
  work->packets = settings_.packets.value_or(std::max(first_pilot.packets, work->packets));
  return work;
}

// Returns the work of a replicate such that the planned number of replicates reaches the bounds. Pilots trace all light: each
// tells how many rays and how many packets the run needs, and larger ones follow until both forecasts can be trusted. Returns
// nothing if stopped.
std::optional<Work> WorkPlanner::choose_by_pilots(const RunPilots& run_pilots) {
  const double most_rays = std::min(static_cast<double>(max_grid_rays), rays_within_limit());
  // On a fixed grid there is at most one packet per ray, and at least as many packets as in the first pilot.
  const double grid_rays = settings_.grid_m ? grid_rays_asked() : 0.0;
  double most = most_rays;
  if (settings_.grid_m) most = std::min(most, std::max(first_pilot.packets, grid_rays));
  const bool chooses_rays = has_beam_ && !settings_.grid_m;
  Work pilot;
  if (has_beam_) pilot.rays = std::min(first_pilot.rays, settings_.grid_m ? grid_rays : most_rays);
  if (settings_.grid_m) pilot.rays = std::max(pilot.rays, grid_rays / ray_forecast.next);
  if (maker_.has_indirect_pass()) pilot.packets = std::min(first_pilot.packets, most);
  while (true) {
    const std::optional<SeriesOutcome> pilots = run_pilots(pilot);
    if (!pilots) return std::nullopt;
    Part rays{grid_rays, grid_rays};
    if (chooses_rays)
      rays = forecast(pilot.rays, ray_growth(*pilots, asked_replicates()), affordable_growth(*pilots), most_rays);
    Part packets;
    if (pilot.packets > 0.0) {
      const double fits = std::min(most, most_packets({rays.chosen, 0.0}));
      packets = forecast(pilot.packets, packet_growth(*pilots, asked_replicates()), affordable_growth(*pilots), fits);
    }
    fit_to_rays(pilot, pilots->rays_each, rays, packets);
    const Work larger = with_enough_rays({chooses_rays ? ray_forecast.next_pilot(pilot.rays, rays.chosen) : pilot.rays,
                                          packet_forecast.next_pilot(pilot.packets, packets.chosen)});
    if (fitted_to_time_ || (larger.rays == pilot.rays && larger.packets == pilot.packets))
      return with_enough_rays(balanced(rays, packets));
    pilot = larger;
  }
}

// Returns the part of the work that such growth of the pilots' part requests, and how much of it is possible.
WorkPlanner::Part WorkPlanner::forecast(double pilot, double growth, double affordable_growth, double most) {
  const double wanted = pilot * std::max(1.0, growth);
  const double possible = std::min(wanted, most);
  const double affordable = pilot * affordable_growth;
  if (affordable < possible) fitted_to_time_ = true;
  return {wanted, std::max(1.0, std::min(possible, affordable))};
}

// Returns as many rays as a replicate may have if half of a limit on rays is to be enough for least_replicates.
double WorkPlanner::rays_within_limit() const {
  if (!settings_.max_rays) return std::numeric_limits<double>::infinity();
  return std::max(1.0, static_cast<double>(*settings_.max_rays) / (2.0 * least_replicates));
}

// Lessens both parts alike if they exceed a limit on rays. Packets of the first round bring along those of later rounds, and
// the sky's rays.
void WorkPlanner::fit_to_rays(const Work& pilot, double rays_of_pilot, Part& rays, Part& packets) const {
  if (!settings_.max_rays || settings_.grid_m) return;
  const double per_packet = pilot.packets > 0.0 ? std::max(1.0, (rays_of_pilot - pilot.rays) / pilot.packets) : 0.0;
  const double share = std::min(1.0, rays_within_limit() / (rays.chosen + per_packet * packets.chosen));
  for (Part* part : {&rays, &packets}) {
    if (part->chosen > 0.0) part->chosen = std::max(1.0, share * part->chosen);
  }
}

// More replicates make up for packets that do not fit the memory, and each of them then needs fewer rays.
Work WorkPlanner::balanced(const Part& rays, const Part& packets) const {
  Work work{rays.chosen, packets.chosen};
  const bool held_back = !fixed() && packets.chosen > 0.0 && packets.chosen == most_packets(work);
  if (!held_back || !has_beam_) return work;
  const double fewer = std::pow(packets.wanted / packets.chosen, -packet_slope / ray_slope);
  work.rays = std::max(first_pilot.rays, std::min(1.0, spare_of_rays * fewer) * work.rays);
  if (for_organs()) work.rays = std::max(work.rays, std::min(rays.chosen, rays_per_packet_for_organs * work.packets));
  return work;
}

Work WorkPlanner::with_enough_rays(Work work) const {
  if (!has_beam_ || settings_.grid_m || settings_.max_rays) return work;
  work.rays = std::max(work.rays, std::min(work.packets / most_packets_per_ray, static_cast<double>(max_grid_rays)));
  return work;
}

double WorkPlanner::ray_growth(const SeriesOutcome& series, int replicates) const {
  const double fewer = half_width_ratio(series.replicates, replicates, settings_.accuracy.confidence);
  return growth(series.direct_error * fewer, settings_.accuracy.direct, ray_slope);
}

double WorkPlanner::packet_growth(const SeriesOutcome& series, int replicates) const {
  const double fewer = half_width_ratio(series.replicates, replicates, settings_.accuracy.confidence);
  return growth(series.indirect_error * fewer, settings_.accuracy.indirect, packet_slope);
}

// With a limit on time, replicates must be small enough for least_replicates of them to be done in time.
double WorkPlanner::affordable_growth(const SeriesOutcome& pilots) const {
  if (!settings_.max_seconds || !settings_.fit_to_time) return std::numeric_limits<double>::infinity();
  return pilots.seconds_left / (2.0 * least_replicates * std::max(pilots.seconds_each, 1e-6));
}

bool WorkPlanner::far_too_small(const SeriesOutcome& pilots) const {
  return has_beam_ && !settings_.grid_m && ray_growth(pilots, asked_replicates()) > ray_forecast.trusted;
}

Work WorkPlanner::begin_with(Work earlier) const {
  if (has_beam_) earlier.rays = std::max(first_pilot.rays, earlier.rays);
  if (maker_.has_indirect_pass()) earlier.packets = std::max(first_pilot.packets, earlier.packets);
  return with_enough_rays(earlier);
}

std::vector<double> WorkPlanner::ray_needs(std::span<const double> rays, std::span<const SeriesOutcome> lights,
                                           const std::vector<bool>& judged) const {
  std::vector<double> needed;
  double most = 0.0;
  for (std::size_t k = 0; k < lights.size(); ++k) {
    const double growth = ray_growth(lights[k], asked_replicates());
    needed.push_back(std::isnan(growth) ? std::numeric_limits<double>::infinity() : growth * rays[k]);
    if (judged[k]) most = std::max(most, needed.back());
  }
  const bool known = std::isfinite(most) && most > 0.0;
  for (double& own : needed) own = known && std::isfinite(own) ? std::min(1.0, own / most) : 1.0;
  return needed;
}

std::vector<double> WorkPlanner::ray_shares(std::span<const double> needs) const {
  std::vector<double> shares;
  for (const double need : needs) shares.push_back(std::min(1.0, spare_of_rays * need));
  return shares;
}

std::vector<double> WorkPlanner::spare_rays(std::span<const double> needs, Work& work) const {
  std::vector<double> shares = ray_shares(needs);
  const double rays = work.rays * std::accumulate(shares.begin(), shares.end(), 0.0);
  if (fixed() || settings_.max_rays || fitted_to_time_ || shares.size() < 2 || !(rays > 0.0)) return shares;
  const double cheap = cheap_rays_per_packet(shares.size()) * work.packets;
  Work more = work;
  more.rays = std::min(std::clamp(cheap / rays, 1.0, most_spare_of_rays) * work.rays, static_cast<double>(max_grid_rays));
  if (more.packets > most_packets(more)) return shares;  // the rays would take the packets' memory
  const double spare = more.rays / work.rays;
  const double least = least_rays_per_packet * more.packets / more.rays;
  for (std::size_t k = 0; k < shares.size(); ++k)
    shares[k] = std::min(1.0, std::max(needs[k] * std::max(1.0, spare_of_rays / spare), least));
  work = more;
  return shares;
}

Work WorkPlanner::next(const Work& work, const SeriesOutcome& run) const {
  Work next = work;
  if (run.replicates < 2) return next;
  const auto trusted = [](double factor) { return std::clamp(factor, 1.0 / most_change, most_change); };
  next.rays *= trusted(ray_growth(run, planned_replicates));
  next.packets *= trusted(packet_growth(run, planned_replicates));
  next.rays = std::min(next.rays, static_cast<double>(max_grid_rays));
  next.packets = std::min(next.packets, most_packets(next));
  return next;
}

// A fixed grid sets the number of sky rays too.
std::size_t WorkPlanner::sky_rays(const Work& work) const {
  if (!maker_.has_sky()) return 0;
  const double per_packet = maker_.aims() && !settings_.grid_m ? aimed_sky_rays_per_packet : sky_rays_per_packet;
  const double rays = settings_.grid_m && !settings_.packets ? work.rays : per_packet * work.packets;
  return static_cast<std::size_t>(std::clamp(rays, 1.0, most_sky_rays));
}

double WorkPlanner::sampled_rays(const Work& work) const {
  if (!for_organs()) return work.packets;
  return std::min(work.packets, std::max(least_sampled_rays, sampled_rays_per_packet_for_organs * work.packets));
}

// Without an indirect pass the host has little to do meanwhile, and saving memory is better.
std::size_t WorkPlanner::at_once(const Work& work) const {
  if (settings_.max_rays || !maker_.has_indirect_pass()) return 1;
  const auto asked = static_cast<std::size_t>(std::max(1, settings_.replicates_at_once));
  const std::size_t most = std::min(asked, maker_.most_at_once());
  if (!settings_.memory_bytes) return most;
  const double fit = *settings_.memory_bytes / (most_memory_per_byte * replicate_bytes(work));
  return static_cast<std::size_t>(std::clamp(fit, 1.0, static_cast<double>(most)));
}

double WorkPlanner::replicate_bytes(const Work& work) const {
  if (!maker_.has_indirect_pass()) return maker_.sum_bytes() + record_bytes(work);
  return maker_.sum_bytes() - maker_.most_place_bytes().all() + place_bytes(work).all() + memory_.bytes(ray_counts(work)) +
         record_bytes(work) + maker_.device_sum_bytes();
}

double WorkPlanner::record_bytes(const Work& work) const {
  const RayCounts counts = ray_counts(work);
  return maker_.record_bytes(has_beam_ ? work.rays : 0.0, std::min(counts.packets, counts.beam_rays));
}

PlaceBytes WorkPlanner::place_bytes(const Work& work) const {
  return memory_.place_bytes(ray_counts(work), maker_.most_place_bytes());
}

double WorkPlanner::grid_rays_asked() const {
  return std::max(1.0, model_.plot.area_m2() / (*settings_.grid_m * *settings_.grid_m) / asked_replicates());
}

// Returns the largest number of packets in a replicate's first round that fits the memory. It depends on the machine only if
// memory is too short for even a single comfortable replicate.
double WorkPlanner::most_packets(Work work) const {
  if (!settings_.memory_bytes) return most_first_packets;
  const double comfortable = for_organs() ? comfortable_bytes_for_organs : comfortable_bytes;
  const double most_bytes = std::min(comfortable, *settings_.memory_bytes / most_memory_per_byte - maker_.sum_bytes());
  double fits = first_pilot.packets;
  double exceeds = most_first_packets;
  while (exceeds - fits > 1.0) {
    work.packets = std::floor(0.5 * (fits + exceeds));
    const double recorded = model_.planes.empty() ? 0.0 : record_bytes(work);  // elsewhere little for each packet
    (memory_.bytes(ray_counts(work)) + recorded <= most_bytes ? fits : exceeds) = work.packets;
  }
  return fits;
}

RayCounts WorkPlanner::ray_counts(const Work& work) const {
  return {has_beam_ ? std::min(work.rays, sampled_rays(work)) : 0.0, static_cast<double>(sky_rays(work)), work.packets};
}

}  // namespace sunfleck
