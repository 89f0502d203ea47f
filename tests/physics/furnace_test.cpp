// Tests cavities whose light is known exactly (B4 to B6 of the validation table), and how the error falls with the packets.
#include "programs/validate/known/cavity_scenes.h"
#include "support/scattering.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <utility>
#include <vector>

namespace sunfleck::test {
namespace {

// Largest share that may escape: light that leaves a point within the offset of a wall (2^-17 of the extent, 8 um) can slip out
// beside it, and light that starts exactly at the edge of two walls can meet the outside of one.
constexpr double escaping = 1e-5;

TEST(Furnace, EveryWallSeesTheSame) {
  for (const bool furnished : {false, true}) {
    const RadiationModel model = furnace(furnished ? furnished_box(4) : empty_box(4));
    SolveSettings settings = fixed_packets(model, 8192, usual_replicates);
    settings.element_errors = ElementErrors::keep;
    const RadiationResult result = simulate_soundly(model, settings);
    std::printf("%s: %.1f million packets, %.1f s\n", furnished ? "with leaves" : "empty",
                static_cast<double>(result.indirect.packets) * 1e-6, result.indirect.seconds);
    ZScores scores(usual_replicates);
    for (std::size_t b = 0; b < furnace_reflectances.size(); ++b) {
      const FluxLedger& ledger = result.bands[b].ledger;
      EXPECT_LE(static_cast<double>(ledger.reflected + ledger.transmitted), escaping * static_cast<double>(ledger.incident));
      if (furnished) {
        EXPECT_NEAR(result.organs[box_walls].absorbed[b].value, 0.0, 1e-12);
      }
      for (std::size_t o = 0; o < box_walls; ++o) {
        expect_agrees(result.organs[o].absorbed[b], 1.0, usual_replicates, 0.003, 2 * box_walls * furnace_reflectances.size(),
                      fmt::format("rho {}, wall {}", furnace_reflectances[b], o).c_str());
      }
      for (std::size_t e = 0; e < model.canopy.size(); ++e) {
        if (model.canopy.organ_of[e] >= box_walls) continue;
        const double got =
            result.side_indirect_w_m2(2 * e, area_m2(model.canopy.corners[e]), b) * (1.0 - furnace_reflectances[b]);
        const std::int64_t outside = result.side_indirect[(2 * e + 1) * furnace_reflectances.size() + b];
        EXPECT_LE(static_cast<double>(outside), escaping * static_cast<double>(ledger.incident));
        scores.add({got, result.element_error[b * model.canopy.size() + e]}, 1.0, "triangle");
      }
    }
    scores.expect_plausible();
  }
}

// Both sides of a leaf with rho + tau = 1 see the same light as the walls.
TEST(Furnace, BothSidesOfALeafSeeWhatTheWallsSee) {
  const RadiationModel model = furnace(furnished_box(1));
  std::vector<std::uint32_t> group_of(model.canopy.size());
  for (std::uint32_t e = 0; e < group_of.size(); ++e) group_of[e] = e;
  const SideIrradiance got(model, group_of, 16384, usual_replicates, 500);
  ZScores scores(usual_replicates);
  std::size_t first_leaf = 0;
  while (model.canopy.organ_of[first_leaf] < box_walls) ++first_leaf;
  const std::size_t comparisons = 2 * (group_of.size() - first_leaf) * furnace_reflectances.size();
  for (std::size_t e = first_leaf; e < group_of.size(); ++e) {
    for (std::size_t b = 0; b < furnace_reflectances.size(); ++b) {
      for (const std::size_t side : {0U, 1U}) {
        const Estimate share = got.of(e, side, b).scaled(1.0 - furnace_reflectances[b]);
        expect_agrees(share, 1.0, usual_replicates, 0.03, comparisons, side == 0 ? "upper side" : "lower side");
        scores.add(share, 1.0, "leaf side");
      }
    }
  }
  scores.expect_plausible();
}

// Returns a sphere of radius 1 about (1, 1, 1), made from an icosahedron whose triangles are cut in four `times` times. The
// faces look inwards; each of the twenty original faces is an organ.
Mesh icosphere(int times) {
  using Corners = std::array<glm::dvec3, 3>;
  const double golden = 0.5 * (1.0 + std::sqrt(5.0));
  std::vector<glm::dvec3> corners;
  for (const double a : {-1.0, 1.0}) {
    for (const double b : {-golden, golden}) corners.insert(corners.end(), {{0.0, a, b}, {a, b, 0.0}, {b, 0.0, a}});
  }
  MeshMaker maker;
  const auto near = [](const glm::dvec3& a, const glm::dvec3& b) { return glm::distance(a, b) < 2.1; };
  for (std::size_t i = 0; i < corners.size(); ++i) {
    for (std::size_t j = i + 1; j < corners.size(); ++j) {
      for (std::size_t k = j + 1; k < corners.size(); ++k) {
        if (!near(corners[i], corners[j]) || !near(corners[i], corners[k]) || !near(corners[j], corners[k])) continue;
        Corners face{glm::normalize(corners[i]), glm::normalize(corners[j]), glm::normalize(corners[k])};
        if (glm::dot(glm::cross(face[1] - face[0], face[2] - face[0]), face[0]) > 0.0) std::swap(face[1], face[2]);
        std::vector<Corners> pieces{face};
        for (int cut = 0; cut < times; ++cut) {
          std::vector<Corners> smaller;
          for (const auto& [a, b, c] : pieces) {
            const glm::dvec3 ab = glm::normalize(a + b);
            const glm::dvec3 bc = glm::normalize(b + c);
            const glm::dvec3 ca = glm::normalize(c + a);
            smaller.insert(smaller.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
          }
          pieces = std::move(smaller);
        }
        maker.organ(fmt::format("face{}", maker.mesh().organs.size()));
        const glm::dvec3 centre(1.0);
        for (const auto& [a, b, c] : pieces) maker.triangle(centre + a, centre + b, centre + c);
      }
    }
  }
  return maker.mesh();
}

// One of the twenty faces emits: after the first landing the light is even, on that face as well.
TEST(Furnace, IntegratingSphere) {
  constexpr std::array walls_reflect = {0.5, 0.8};
  RadiationModel model = lamp_model(icosphere(5), {2.0, 2.0, false}, walls_reflect.size());
  ASSERT_EQ(model.optics.size(), 20U);
  ASSERT_EQ(model.canopy.size(), 20480U);
  double sphere_m2 = 0.0;
  for (std::size_t o = 0; o < model.optics.size(); ++o) {
    for (std::size_t b = 0; b < walls_reflect.size(); ++b) model.optics[o].upper[b].reflectance = walls_reflect[b];
  }
  for (const Triangle& corners : model.canopy.corners) sphere_m2 += area_m2(corners);
  model.optics[0].emission_w_m2.assign(walls_reflect.size(), 1.0);
  const RadiationResult result = simulate_soundly(model, fixed_packets(model, 65536, usual_replicates));
  std::printf("%.1f million packets, %.1f s\n", static_cast<double>(result.indirect.packets) * 1e-6, result.indirect.seconds);
  double largest = 0.0;
  for (std::size_t b = 0; b < walls_reflect.size(); ++b) {
    const double irradiance = result.organs[0].area_m2 / (sphere_m2 * (1.0 - walls_reflect[b]));
    EXPECT_LE(static_cast<double>(result.bands[b].ledger.reflected + result.bands[b].ledger.transmitted),
              escaping * static_cast<double>(result.bands[b].ledger.incident));
    for (const OrganResult& face : result.organs) {
      const Estimate got = face.indirect[b].scaled(1.0 / irradiance);
      const double error = standard_error(got, usual_replicates);
      EXPECT_LE(error, 0.0015);
      EXPECT_LE(std::abs(got.value - 1.0), 0.003 + table_quantile(40, usual_replicates) * error);
      largest = std::max(largest, std::abs(got.value - 1.0));
    }
    std::printf("reflectance %.1f: glowing face %.5f of the even light, error %.1e\n", walls_reflect[b],
                result.organs[0].indirect[b].value / irradiance,
                standard_error(result.organs[0].indirect[b], usual_replicates) / irradiance);
  }
  std::printf("largest deviation of a face: %.5f\n", largest);
}

TEST(Furnace, HemisphericalBowl) {
  constexpr std::array inside = {0.2, 0.5, 0.8};
  constexpr std::size_t comparisons = 4 * inside.size();
  ZScores scores(usual_replicates);
  for (const double elevation : {90.0, 60.0, 35.0, 15.0}) {
    const Bowl bowl = bowl_under(sun_at(elevation, 40.0), 128, inside);
    const RadiationModel& model = bowl.model;
    for (const Triangle& corners : model.canopy.corners) {
      ASSERT_GT(glm::dot(unit_normal(corners), glm::dvec3(0.5, 0.6, 0.5) - model.canopy.origin_m - glm::dvec3(corners[0])),
                0.0);
    }
    const RadiationResult result = simulate_soundly(model, fixed_packets(model, 16384, usual_replicates, 77));
    for (std::size_t b = 0; b < inside.size(); ++b) {
      const double escaping_share = bowl.escaping_share(inside[b]);
      const Estimate got = result.bands[b].reflected.scaled(model.plot.area_m2() / bowl.opening_m2);
      expect_agrees(got, escaping_share, usual_replicates, 1e-3, comparisons,
                    fmt::format("beam at {}, rho {}, facets' part {:+.1e}", elevation, inside[b],
                                escaping_share - inside[b] * 0.5 / (1.0 - inside[b] * 0.5))
                        .c_str());
      scores.add(got, escaping_share, "bowl");
    }
  }
}

// Compares the root-mean-square error of the light on the walls and leaf sides of a furnace with the number of packets traced.
TEST(Furnace, ErrorFallsWithTheRootOfThePackets) {
  RadiationModel model = dark_box(furnished_box(1), 1);
  for (std::size_t o = 0; o < model.optics.size(); ++o) {
    model.optics[o].upper[0].reflectance = 0.5;
    if (o < box_walls) model.optics[o].emission_w_m2 = {1.0};
    if (o >= box_walls) set_faces(model, o, {{0.4, 0.6}});
  }
  const Prepared prepared(model);
  constexpr int seeds = 12;
  std::vector<double> packets, errors;  // logarithms
  for (double first = 1024; first <= 262144; first *= 4) {
    double squares = 0.0;
    double traced = 0.0;
    int sides = 0;
    for (int seed = 0; seed < seeds; ++seed) {
      SolveSettings settings = fixed_packets(model, first, 1, 4000 + static_cast<std::uint64_t>(seed));
      settings.accuracy.indirect = 0.05;  // leaves less than 5e-5 unshot: fewer rounds of minimum size
      const RadiationResult result = simulate(model, prepared, settings);
      expect_sound(model, result);
      traced += static_cast<double>(result.indirect.packets) / seeds;
      for (std::size_t side = 0; side < 2 * model.canopy.size(); ++side) {
        const bool outside = model.canopy.organ_of[side / 2] < box_walls && side % 2 == 1;
        if (outside) continue;
        const double got = result.side_indirect_w_m2(side, area_m2(model.canopy.corners[side / 2]), 0);
        squares += (got / 2.0 - 1.0) * (got / 2.0 - 1.0);
        ++sides;
      }
    }
    packets.push_back(std::log(traced));
    errors.push_back(0.5 * std::log(squares / sides));
    std::printf("%9.0f packets: error %.5f\n", traced, std::exp(errors.back()));
  }
  const auto n = static_cast<double>(packets.size());
  double x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
  for (std::size_t k = 0; k < packets.size(); ++k) {
    x += packets[k] / n;
    y += errors[k] / n;
    xx += packets[k] * packets[k] / n;
    xy += packets[k] * errors[k] / n;
  }
  const double slope = (xy - x * y) / (xx - x * x);
  std::printf("slope %.3f over %.1f decades\n", slope, (packets.back() - packets.front()) / std::log(10.0));
  EXPECT_GE(packets.back() - packets.front(), std::log(100.0));
  EXPECT_LE(slope, -0.47);
}

}  // namespace
}  // namespace sunfleck::test
