#include "physics/transport/indirect/candidates.h"

#include "base/check.h"
#include "physics/bvh/bvh.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <numeric>

namespace sunfleck {
namespace {

// Steps of the additive sequence: powers of the plastic number. Roberts' sequences in two and in four dimensions would have
// different steps; a round needs two numbers for a direction, and two more for a place on a lamp.
constexpr double step_1 = 0.7548776662466927;
constexpr double step_2 = 0.5698402909980532;

double fraction(double x) {
  return x - std::floor(x);
}

// Returns a direction that is cosine-distributed about the unit normal n, in a frame after Duff et al. 2017, "Building an
// orthonormal basis, revisited", JCGT 6(1).
glm::dvec3 cosine_direction(const glm::dvec3& n, double u, double v) {
  const double sign = std::copysign(1.0, n.z);
  const double a = -1.0 / (sign + n.z);
  const double b = n.x * n.y * a;
  const glm::dvec3 tangent(1.0 + sign * n.x * n.x * a, sign * b, -sign * n.x);
  const glm::dvec3 bitangent(b, sign + n.y * n.y * a, -n.y);
  const double radius = std::sqrt(u);
  const double angle = 2.0 * std::numbers::pi * v;
  return tangent * (radius * std::cos(angle)) + bitangent * (radius * std::sin(angle)) + n * std::sqrt(1.0 - u);
}

// Moves a point that may stick out of the plot back into it; sets `image` to the number of the element's copy there.
glm::dvec3 wrapped(glm::dvec3 point_m, const glm::dvec2& period_m, std::uint32_t& image) {
  const double dx = std::floor(point_m.x / period_m.x);
  const double dz = std::floor(point_m.z / period_m.y);
  image = pack_image(-static_cast<int>(dx), -static_cast<int>(dz));
  point_m.x -= dx * period_m.x;
  point_m.z -= dz * period_m.y;
  return point_m;
}

// Random numbers of one packet, each uniform over [0, 1).
struct PacketNumbers {
  double direction_u, direction_v, place_u, place_v;
};

shared::Packet start_packet(const Canopy& canopy, const EmissionPoint& place, const EmissionFrame& frame,
                            const PacketNumbers& numbers) {
  double b = place.a;
  double c = place.b;
  if (place.a == anywhere) {  // uniform over the triangle (Turk 1990, Graphics Gems)
    const double root = std::sqrt(numbers.place_u);
    b = root * (1.0 - numbers.place_v);
    c = root * numbers.place_v;
  }
  PacketStart start = start_at(canopy, place, b, c, frame);
  start.packet.direction = cosine_direction(start.normal, numbers.direction_u, numbers.direction_v);
  return start.packet;
}

// Bits of a key below the number of its candidate.
constexpr unsigned number_bits = 31;
constexpr std::uint64_t number_mask = (std::uint64_t{1} << number_bits) - 1U;

// Returns the place's rank in the drawing order. Upper sides are drawn before lower ones: with both sides of one landing next to each
// other, systematic sampling would take the same side every time when a landing's expectation is one packet (rho + tau = 1).
std::uint64_t rank_of(const EmissionPoint& place) {
  return std::uint64_t{place.surface % 2} << 32U | place.order;
}

// Leaves keys in ascending order of rank in space.from: a rank of 33 bits above the number of the candidate. The sort is stable: a
// radix sort in three passes of eleven bits, several times faster here than std::stable_sort. Keys hold their ranks, so that no pass
// looks up a place.
void sort_by_rank(const LargeVector<EmissionPoint>& places, SortSpace& space) {
  constexpr unsigned bits = 11;
  constexpr unsigned passes = 3;
  constexpr std::uint64_t mask = (1U << bits) - 1U;
  EXPECT(places.size(), <=, number_mask);
  space.from.resize(places.size());
  space.to.resize(places.size());
  std::array<std::array<std::uint32_t, mask + 2>, passes> start{};
  for (std::size_t k = 0; k < places.size(); ++k) {
    const std::uint64_t rank = rank_of(places[k]);
    space.from[k] = rank << number_bits | k;
    for (unsigned pass = 0; pass < passes; ++pass) ++start[pass][(rank >> pass * bits & mask) + 1];
  }
  for (unsigned pass = 0; pass < passes; ++pass) {
    std::partial_sum(start[pass].begin(), start[pass].end(), start[pass].begin());
    for (const std::uint64_t key : space.from) space.to[start[pass][key >> (number_bits + pass * bits) & mask]++] = key;
    std::swap(space.from, space.to);
  }
}

}  // namespace

void Candidates::add(const EmissionPoint& place, std::span<const std::int64_t> quanta) {
  if (std::all_of(quanta.begin(), quanta.end(), [](std::int64_t q) { return q == 0; })) return;
  places_.push_back(place);
  quanta_.insert(quanta_.end(), quanta.begin(), quanta.end());
  columns::add(quanta, totals_.data());
}

void Candidates::clear() {
  places_.clear();
  quanta_.clear();
  row_of_.clear();
  totals_.assign(columns_, 0);
}

void Candidates::reserve(std::size_t candidates) {
  places_.reserve(candidates);
  quanta_.reserve(candidates * columns_);
}

void Candidates::take_sorted(Candidates& other, SortSpace& space) {
  // Rows as long as this stay where they are: moving them would cost more than reading them in any order.
  constexpr std::size_t least_left_in_place = 32;
  sort_by_rank(other.places_, space);
  places_.resize(other.places_.size());
  totals_ = other.totals_;
  for (std::size_t k = 0; k < places_.size(); ++k) places_[k] = other.places_[space.from[k] & number_mask];
  if (columns_ >= least_left_in_place) {
    row_of_.resize(places_.size());
    for (std::size_t k = 0; k < row_of_.size(); ++k) row_of_[k] = static_cast<std::uint32_t>(space.from[k] & number_mask);
    std::swap(quanta_, other.quanta_);
    return;
  }
  quanta_.resize(other.quanta_.size());
  for (std::size_t k = 0; k < places_.size(); ++k) {
    const std::size_t candidate = space.from[k] & number_mask;
    for (std::size_t c = 0; c < columns_; ++c) quanta_[k * columns_ + c] = other.quanta_[candidate * columns_ + c];
  }
}

void Candidates::retire(const std::vector<bool>& columns) {
  std::vector<std::size_t> retired;
  for (std::size_t c = 0; c < columns_; ++c) {
    if (!columns[c]) continue;
    retired.push_back(c);
    totals_[c] = 0;
  }
  for (std::size_t row = 0; !retired.empty() && row < quanta_.size(); row += columns_) {
    for (const std::size_t c : retired) quanta_[row + c] = 0;
  }
}

void draw_packets(const Candidates& candidates, std::span<const double> expected, RandomStream& random, Draw& draw) {
  EXPECT(expected.size(), ==, candidates.size());
  draw.candidate.clear();
  double reached = random.unit();
  double taken = 1.0;
  for (std::size_t k = 0; k < candidates.size(); ++k) {
    reached += expected[k];
    for (; taken <= reached; taken += 1.0) draw.candidate.push_back(static_cast<std::uint32_t>(k));
  }
  draw.shared = SharedOut(candidates.totals());
  for (std::size_t p = 0; p < draw.candidate.size(); ++p) {
    const std::uint32_t k = draw.candidate[p];
    columns::weigh(candidates.quanta(k), expected[k], static_cast<std::int64_t>(p), draw.shared);
  }
  draw.kept.resize(draw.shared.totals.size());
  for (std::size_t c = 0; c < draw.kept.size(); ++c) draw.kept[c] = draw.shared.totals[c] > 0 && draw.shared.weights[c] == 0.0;
}

void share_out(const Candidates& candidates, std::span<const double> expected, std::size_t packet, Draw& draw,
               std::span<std::int64_t> own) {
  const std::uint32_t k = draw.candidate[packet];
  columns::share(candidates.quanta(k), expected[k], static_cast<std::int64_t>(packet), draw.shared, own);
}

PacketStart start_at(const Canopy& canopy, const EmissionPoint& place, double b, double c, const EmissionFrame& frame) {
  PacketStart start;
  start.packet.element = shared::no_element;
  start.packet.image = 0;
  glm::dvec3 point_m(place.a, frame.ground_y_m, place.b);
  if (place.surface != shared::landed_on_ground) {
    start.packet.element = place.surface / 2;
    const Triangle& corners = canopy.corners[start.packet.element];
    const glm::dvec3 corner(corners[0]);
    point_m = corner + (glm::dvec3(corners[1]) - corner) * b + (glm::dvec3(corners[2]) - corner) * c;
    start.normal = unit_normal(corners) * (place.surface % 2 == 0 ? 1.0 : -1.0);
  }
  point_m += start.normal * frame.offset_m;
  if (canopy.period_m.x > 0.0) point_m = wrapped(point_m, canopy.period_m, start.packet.image);
  start.packet.origin = point_m;
  return start;
}

PacketStarts::PacketStarts(const Canopy& canopy, const Candidates& candidates, const Draw& draw, const EmissionFrame& frame,
                           RandomStream& random)
    : canopy_(canopy),
      candidates_(candidates),
      draw_(draw),
      frame_(frame),
      direction_u_(random.unit()),
      direction_v_(random.unit()),
      place_u_(random.unit()),
      place_v_(random.unit()) {}

void PacketStarts::write(std::size_t first, std::span<shared::Packet> packets) const {
  // Places on a lamp use the same sequence with the dimensions exchanged and a different step.
  constexpr double pace = 0.6180339887498949;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, packets.size(), 1024), [&](const auto& range) {
    for (std::size_t p = range.begin(); p < range.end(); ++p) {
      const auto k = static_cast<double>(first + p);
      const PacketNumbers numbers{fraction(direction_u_ + k * step_1), fraction(direction_v_ + k * step_2),
                                  fraction(place_u_ + k * pace), fraction(place_v_ + k * pace * pace * step_1)};
      packets[p] = start_packet(canopy_, candidates_.place(draw_.candidate[first + p]), frame_, numbers);
    }
  });
}

}  // namespace sunfleck
