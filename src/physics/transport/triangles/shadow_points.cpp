#include "physics/transport/triangles/shadow_points.h"

#include "base/random.h"
#include "physics/light/sun.h"
#include "physics/transport/receivers/sensor_paths.h"
#include "physics/transport/receivers/sensor_rays.h"

#include <oneapi/tbb/parallel_for.h>

#include <cstddef>

namespace sunfleck {
namespace {

constexpr std::uint32_t first_points = 4, edge_points = 8, mixed_points = 24;
constexpr std::uint32_t neighbourhood = 8;
constexpr std::size_t points_at_a_time = std::size_t{1} << 19U;
constexpr std::uint64_t shadow_purpose = 0x5badbeef;

// A request for further points of an element.
struct Request {
  std::uint32_t element = 0;
  std::uint32_t first = 0, points = 0;  // in the element's sequence
};

class ShadowPoints {
 public:
  ShadowPoints(const RadiationModel& model, const CounterLayout& layout, Tracer& tracer, std::uint64_t seed,
               const StopQuestion& stop)
      : model_(model),
        rays_(model, layout),
        tracer_(tracer),
        stop_(stop),
        scene_(make_packet_block(model, layout)),
        to_sun_(direction_to_sun(*model.sun)),
        ground_y_m_(layout.box.ground_y_m),
        seed_(seed),
        lit_(model.canopy.size()),
        asked_(model.canopy.size()) {}

  // Returns false if stopped.
  [[nodiscard]] bool ask(const std::vector<Request>& requests) {
    for (std::size_t begin = 0; begin < requests.size();) {
      std::size_t points = 0;
      std::size_t end = begin;
      while (end < requests.size() && points < points_at_a_time) points += requests[end++].points;
      if (!ask({requests.data() + begin, end - begin}, points)) return false;
      begin = end;
    }
    return true;
  }

  [[nodiscard]] std::uint16_t lit(std::uint32_t element) const { return lit_[element]; }
  [[nodiscard]] std::uint16_t asked(std::uint32_t element) const { return asked_[element]; }
  [[nodiscard]] bool disagree(std::uint32_t element) const { return lit_[element] > 0 && lit_[element] < asked_[element]; }

 private:
  [[nodiscard]] bool ask(std::span<const Request> requests, std::size_t points) {
    std::vector<std::size_t> first(requests.size() + 1);
    for (std::size_t r = 0; r < requests.size(); ++r) first[r + 1] = first[r] + requests[r].points;
    packets_.resize(points);
    landings_.resize(points);
    buried_.assign(points, 0);
    tbb::parallel_for(std::size_t{0}, requests.size(), [&](std::size_t r) { place(requests[r], first[r]); });
    if (tracer_.trace(scene_, packets_, landings_, stop_) == TraceOutcome::stopped) return false;
    for (std::size_t r = 0; r < requests.size(); ++r) {
      const std::uint32_t element = requests[r].element;
      asked_[element] = static_cast<std::uint16_t>(asked_[element] + requests[r].points);
      for (std::size_t k = first[r]; k < first[r + 1]; ++k) {
        if (landings_[k].surface == shared::left_upwards && buried_[k] == 0) ++lit_[element];
      }
    }
    return true;
  }

  // Writes the rays of a request, of which the first has number `first`.
  void place(const Request& request, std::size_t first) {
    const Triangle corners = model_.canopy.corners[request.element];
    const glm::dvec3 corner(corners[0]);
    const glm::dvec3 b = glm::dvec3(corners[1]) - corner;
    const glm::dvec3 c = glm::dvec3(corners[2]) - corner;
    MetSurface at;
    at.normal = unit_normal(corners);
    at.element = request.element;
    RandomStream random(seed_ ^ shadow_purpose, request.element);
    const PairSequence sequence(random);
    for (std::uint32_t k = 0; k < request.points; ++k) {
      glm::dvec2 uv = sequence.at(request.first + k);
      if (uv.x + uv.y > 1.0) uv = glm::dvec2(1.0) - uv;
      at.point_m = corner + b * uv.x + c * uv.y;
      packets_[first + k] = rays_.from(at, to_sun_);
      buried_[first + k] = model_.soil && at.point_m.y < ground_y_m_ ? 1 : 0;
    }
  }

  const RadiationModel& model_;
  SensorRays rays_;
  Tracer& tracer_;
  const StopQuestion& stop_;
  shared::PacketBlock scene_;
  glm::dvec3 to_sun_;
  double ground_y_m_;
  std::uint64_t seed_;
  std::vector<std::uint16_t> lit_, asked_;  // [element], numbers of points
  std::vector<shared::Packet> packets_;
  std::vector<shared::Landing> landings_;
  std::vector<std::uint8_t> buried_;  // [ray]
};

// Returns the largest ranges of the tree with at most `neighbourhood` elements.
std::vector<TreeRange> neighbourhoods(const SurfaceTree& tree) {
  std::vector<TreeRange> ranges;
  const auto add = [&](const TreeRange& range) {
    if (range.size() <= neighbourhood) ranges.push_back(range);
  };
  for (const TreeRange& surface : tree.surfaces) add(surface);
  for (const TreeCut& cut : tree.cuts) {
    if (cut.whole.size() <= neighbourhood) continue;
    add({cut.whole.begin, cut.middle});
    add({cut.middle, cut.whole.end});
  }
  return ranges;
}

}  // namespace

std::optional<std::vector<ElementShade>> ask_shadow_points(const RadiationModel& model, const CounterLayout& layout,
                                                           const BeamExposure& exposure, const SurfaceTree& tree,
                                                           Tracer& tracer, std::uint64_t seed, const StopQuestion& stop) {
  ShadowPoints points(model, layout, tracer, seed, stop);
  std::vector<Request> requests;
  for (const std::uint32_t e : tree.order) {
    if (exposure.can_hit(e)) requests.push_back({e, 0, first_points});
  }
  if (!points.ask(requests)) return std::nullopt;
  std::vector<ElementShade> shades(model.canopy.size());
  requests.clear();
  for (const TreeRange& range : neighbourhoods(tree)) {
    bool light = false, shade = false;
    for (std::uint32_t k = range.begin; k < range.end; ++k) {
      const std::uint32_t e = tree.order[k];
      light = light || points.lit(e) > 0;
      shade = shade || points.lit(e) < points.asked(e);
    }
    for (std::uint32_t k = range.begin; k < range.end; ++k) {
      const std::uint32_t e = tree.order[k];
      if (points.asked(e) == 0) continue;
      if (points.disagree(e)) {
        shades[e].kind = ShadeKind::mixed;
        requests.push_back({e, first_points, mixed_points});
      } else if (light && shade) {
        shades[e].kind = points.lit(e) > 0 ? ShadeKind::edge_light : ShadeKind::edge_shade;
        requests.push_back({e, first_points, edge_points});
      } else {
        shades[e].kind = light ? ShadeKind::inner_light : ShadeKind::inner_shade;
      }
    }
  }
  if (!points.ask(requests)) return std::nullopt;
  requests.clear();
  for (const std::uint32_t e : tree.order) {
    if (shades[e].kind == ShadeKind::mixed || !points.disagree(e)) continue;
    shades[e].kind = ShadeKind::found;
    requests.push_back({e, first_points + edge_points, mixed_points - edge_points});
  }
  if (!points.ask(requests)) return std::nullopt;
  for (const std::uint32_t e : tree.order) {
    ElementShade& shade = shades[e];
    if (shade.kind == ShadeKind::unasked) continue;
    shade.points = points.asked(e);
    shade.share = static_cast<float>(points.lit(e)) / static_cast<float>(shade.points);
  }
  return shades;
}

bool ask_doubted(const RadiationModel& model, const CounterLayout& layout, std::span<const std::uint32_t> elements,
                 Tracer& tracer, std::uint64_t seed, const StopQuestion& stop, std::vector<ElementShade>& shades) {
  ShadowPoints points(model, layout, tracer, seed, stop);
  std::vector<Request> requests;
  for (const std::uint32_t e : elements)
    requests.push_back({e, shades[e].points, first_points + mixed_points - shades[e].points});
  if (!points.ask(requests)) return false;
  for (const std::uint32_t e : elements) {
    ElementShade& shade = shades[e];
    const float lit = shade.share * static_cast<float>(shade.points) + static_cast<float>(points.lit(e));
    shade.points = static_cast<std::uint16_t>(shade.points + points.asked(e));
    shade.share = lit / static_cast<float>(shade.points);
    shade.kind = ShadeKind::doubted;
  }
  return true;
}

}  // namespace sunfleck
