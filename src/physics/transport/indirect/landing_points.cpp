#include "physics/transport/indirect/landing_points.h"

#include "physics/light/sun.h"
#include "physics/transport/indirect/landing_places.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace sunfleck {
namespace {

double weighted_rays(const BeamPart& part) {
  return static_cast<double>(part.weight) * static_cast<double>(part.rays());
}

// One part of a light's beam with its sample.
struct SampledPart {
  const BeamPart* part = nullptr;
  double ground_m2 = 0.0;  // level ground that a sampled ray represents
};

// A light's beam.
struct SampledBeam {
  std::size_t light = 0;
  glm::dvec3 to_sun{0.0, 1.0, 0.0};
  std::vector<SampledPart> parts;

  // Returns the level ground that a sampled ray through the point represents.
  [[nodiscard]] double ground_m2(const glm::dvec3& point_m) const {
    for (const SampledPart& sampled : parts) {
      if (&sampled == &parts.back()) break;
      const shared::BeamBlock& block = sampled.part->block;
      const glm::dvec3 u(block.edge_u), v(block.edge_v);
      const glm::dvec3 from_corner = point_m - glm::dvec3(block.corner);
      const double along_u = glm::dot(from_corner, u) / glm::dot(u, u);
      const double along_v = glm::dot(from_corner, v) / glm::dot(v, v);
      if (along_u >= 0.0 && along_u < 1.0 && along_v >= 0.0 && along_v < 1.0) return sampled.ground_m2;
    }
    return parts.back().ground_m2;
  }
};

class LandingSampler {
 public:
  LandingSampler(const IndirectScene& scene, const LightFromAbove& light, const StopQuestion& stop, PassArrays& arrays)
      : scene_(scene), light_(light), stop_(stop), arrays_(arrays), points_(arrays.points) {
    points_.places.clear();
    points_.weights.clear();
    for (std::size_t k = 0; k < light.first.size(); ++k) {
      if (!light.first[k].beam.empty()) beams_.push_back({k, direction_to_sun(*scene.lights[k].sun), {}});
    }
  }

  [[nodiscard]] bool sample(double most, RandomStream& random) {
    for (std::size_t k = 0; k < beams_.size(); ++k) {
      if (!sample_beam(k, most / static_cast<double>(beams_.size()), random)) return false;
    }
    return beams_.size() < 2 || share_points();
  }

 private:
  [[nodiscard]] bool sample_beam(std::size_t number, double most, RandomStream& random) {
    const std::vector<BeamPart>& beam = light_.first[beams_[number].light].beam;
    double around = 0.0;
    for (std::size_t k = 1; k < beam.size(); ++k) around += weighted_rays(beam[k]);
    for (std::size_t k = 0; k < beam.size(); ++k) {
      const double share = around == 0.0 ? 1.0 : k == 0 ? 0.5 : 0.5 * weighted_rays(beam[k]) / around;
      if (!sample_part(number, beam[k], share * most, random)) return false;
    }
    return true;
  }

  // Takes at most `most` rays of a part, and adds the points where they landed. Returns false if stopped.
  [[nodiscard]] bool sample_part(std::size_t number, const BeamPart& part, double most, RandomStream& random) {
    const FirstLandings& first = light_.first[beams_[number].light];
    const shared::BeamSample sample = sample_of(part, most, random);
    const double stride = static_cast<double>(sample.rays) / static_cast<double>(sample.count);
    beams_[number].parts.push_back({&part, first.ground_per_ray_m2 * stride * part.weight});
    // Only the parts of one beam differ in weight, and only while no other light shares the points.
    const double alone = first.beam.size() == 1 ? 1.0 : stride * part.weight;
    for (std::size_t begin = 0; begin < sample.count; begin += most_at_a_time) {
      numbers_.resize(std::min(most_at_a_time, sample.count - begin));
      for (std::size_t k = 0; k < numbers_.size(); ++k) {
        numbers_[k] = shared::sampled_ray(sample, static_cast<std::uint32_t>(begin + k));
      }
      if (!first.recorded.empty()) {
        take_recorded(first);
      } else if (!trace_again(part)) {
        return false;
      }
      add_points(number, alone);
    }
    return true;
  }

  // Finds where the rays numbers_ of a part landed, by tracing them. Returns false if stopped.
  [[nodiscard]] bool trace_again(const BeamPart& part) {
    std::vector<shared::Packet>& rays = arrays_.packets;
    rays.resize(numbers_.size());
    for (std::size_t k = 0; k < rays.size(); ++k) rays[k] = beam_packet(part.block, numbers_[k]);
    return trace();
  }

  // Does the same with what the direct pass found.
  void take_recorded(const FirstLandings& first) {
    arrays_.landings.resize(numbers_.size());
    for (std::size_t k = 0; k < numbers_.size(); ++k) arrays_.landings[k] = first.recorded[numbers_[k]];
  }

  // Traces arrays_.packets. Returns false if stopped.
  [[nodiscard]] bool trace() {
    arrays_.landings.resize(arrays_.packets.size());
    return scene_.tracer.trace(scene_.block, arrays_.packets, arrays_.landings, stop_) != TraceOutcome::stopped;
  }

  // Adds the places where arrays_.landings met something.
  void add_points(std::size_t number, double weight) {
    const std::size_t before = points_.places.size();
    points_.places.resize(before + arrays_.landings.size());
    const auto added = [&] { return points_.places.begin() + static_cast<std::ptrdiff_t>(before); };
    find_places(scene_, arrays_.landings, {added(), points_.places.end()});
    std::for_each(added(), points_.places.end(), [&](EmissionPoint& place) { place.u = next_number_++; });
    const auto missed = [](const EmissionPoint& place) { return place.surface > shared::landed_on_ground; };
    points_.places.erase(std::remove_if(added(), points_.places.end(), missed), points_.places.end());
    if (all_weigh_the_same()) return;
    const std::size_t lights = light_.first.size();
    points_.weights.resize(points_.places.size() * lights);
    for (std::size_t p = before; p < points_.places.size(); ++p) {
      points_.weights[p * lights + beams_[number].light] = weight;
    }
    if (beams_.size() > 1) sampled_by_.resize(points_.places.size(), number);
  }

  [[nodiscard]] bool all_weigh_the_same() const { return light_.first.size() == 1 && light_.first.front().beam.size() == 1; }

  // Finds which other lights shine on the points, and weighs these. Returns false if stopped.
  [[nodiscard]] bool share_points() {
    const std::size_t points_at_once = std::max<std::size_t>(1, most_at_a_time / beams_.size());
    for (std::size_t first = 0; first < points_.places.size(); first += points_at_once) {
      if (!share_points(first, std::min(points_.places.size(), first + points_at_once))) return false;
    }
    return true;
  }

  [[nodiscard]] bool share_points(std::size_t first, std::size_t end) {
    std::vector<shared::Packet>& rays = arrays_.packets;
    rays.clear();
    rays.reserve((end - first) * (beams_.size() - 1));
    for (std::size_t p = first; p < end; ++p) {
      const Faces faces = faces_at(p);
      for (std::size_t k = 0; k < beams_.size(); ++k) {
        if (k != sampled_by_[p]) rays.push_back(faces.towards(beams_[k].to_sun));
      }
    }
    if (!trace()) return false;
    auto ray_end = arrays_.landings.begin();
    for (std::size_t p = first; p < end; ++p) {
      const Faces faces = faces_at(p);
      const glm::dvec3 point_m(faces.front.origin);
      double density = 0.0;
      double* const weights = &points_.weights[p * light_.first.size()];
      for (std::size_t k = 0; k < beams_.size(); ++k) {
        const bool shines = k == sampled_by_[p] || (ray_end++)->surface == shared::left_upwards;
        const double per_ground = shines ? glm::dot(faces.normal, beams_[k].to_sun) / beams_[k].to_sun.y : 0.0;
        weights[beams_[k].light] = per_ground;
        density += std::abs(per_ground) / beams_[k].ground_m2(point_m);
      }
      for (std::size_t k = 0; k < beams_.size(); ++k) weights[beams_[k].light] /= density;
    }
    return true;
  }

  // Both faces at a point; the ground has only its upper one.
  struct Faces {
    shared::Packet front, back;
    glm::dvec3 normal{0.0, 1.0, 0.0};

    [[nodiscard]] shared::Packet towards(const glm::dvec3& to_sun) const {
      shared::Packet ray = glm::dot(normal, to_sun) >= 0.0 ? front : back;
      ray.direction = to_sun;
      return ray;
    }
  };
  [[nodiscard]] Faces faces_at(std::size_t point) const {
    const EmissionPoint& place = points_.places[point];
    const PacketStart front = start_at(scene_.model.canopy, place.surface, place.a, place.b, scene_.frame);
    Faces faces{front.packet, front.packet, glm::dvec3(front.normal)};
    if (place.surface == shared::landed_on_ground) return faces;
    faces.back = start_at(scene_.model.canopy, place.surface ^ 1U, place.a, place.b, scene_.frame).packet;
    return faces;
  }

  const IndirectScene& scene_;
  const LightFromAbove& light_;
  const StopQuestion& stop_;
  PassArrays& arrays_;
  LandingPoints& points_;
  std::vector<SampledBeam> beams_;
  std::vector<std::uint32_t> numbers_;   // of the sampled rays in hand
  std::uint32_t next_number_ = 0;        // in the sample
  std::vector<std::size_t> sampled_by_;  // [point], number of the beam; empty for a single one
};

}  // namespace

bool sample_landings(const IndirectScene& scene, const LightFromAbove& light, double most, RandomStream& random,
                     const StopQuestion& stop, PassArrays& arrays) {
  return LandingSampler(scene, light, stop, arrays).sample(most, random);
}

shared::BeamSample sample_of(const BeamPart& part, double most, RandomStream& random) {
  const auto rays = static_cast<double>(part.rays());
  const double count = std::max(1.0, std::min(most, rays));
  const double offset = std::min(random.unit() * rays, rays - 1.0);  // the product may be rounded up to all rays
  return {static_cast<std::uint32_t>(part.rays()), static_cast<std::uint32_t>(count), static_cast<std::uint32_t>(offset)};
}

}  // namespace sunfleck
