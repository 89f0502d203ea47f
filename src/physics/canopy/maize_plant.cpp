#include "physics/canopy/maize_plant.h"

#include "physics/canopy/maize_random.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>

namespace sunfleck {
namespace {

using std::numbers::pi;

constexpr Range degrees(double lo, double hi) {
  return {lo * pi / 180.0, hi * pi / 180.0};
}

// A property by rank: its ranges at the lowest green leaf, at the ear's leaf and at the top leaf, interpolated linearly in
// between.
struct RankProfile {
  Range lowest, ear, top;
};

// Every range below without a source is an ordinary field value for a hybrid in the middle of grain filling.

// --- Number and size of leaves --------------------------------------------------------------------------------------

// Chinese cultivars of the time have 17 to 23 leaves (Agriculture 2020, 10:411). These numbers are the middle of that range,
// so that 13 to 16 leaves are green once the senesced ones are left out.
constexpr int fewest_leaves = 19;
constexpr int most_leaves = 21;
constexpr int fewest_senesced = 5;  // in the middle of grain filling the lowest four to six leaves are dead
constexpr int most_senesced = 6;
constexpr int leaves_above_ear = 7;  // puts the ear at 0.63 to 0.67 of the number of leaves

// Leaf area by rank, S = S0 exp(-(n - n0)^2 / (2 k^2)); Yang & Alley 2005, Agronomy Journal 97:41. Their reduced model,
// F = F0 exp(-(F0 (n - n0))^2 / 0.3542) with F the share of a leaf in the plant's leaf area, ties k to the share of the
// largest leaf: k = 0.421 / F0. F0 is 0.088 for 20 leaves.
constexpr Range largest_area_m2{0.067, 0.0798};  // S0; at silking about 600 to 800 cm2
constexpr double curve_width = 0.24;             // k over the number of leaves
constexpr Range largest_below_ear{0.0, 1.0};     // ranks: the largest leaf is the ear's or the next below
constexpr Range leaf_area_scatter{0.88, 1.12};   // Yang & Alley predict areas to within about 10 %
// Width over length is 0.10 to 0.13 (public parametric models); the upper leaves are broader.
constexpr RankProfile width_to_length{{0.095, 0.105}, {0.108, 0.122}, {0.123, 0.137}};

// --- Positions of the leaves -----------------------------------------------------------------------------------------

constexpr Range ear_height_m{0.94, 1.14};  // of the node on which the ear grows
// The first nodes stay in the crown; the internodes lengthen up to the ear and shorten above it.
constexpr int crown_nodes = 4;
constexpr double first_internode_share = 0.60;  // relative to the ear's internode
constexpr double top_internode_share = 0.50;
constexpr RankProfile sheath_m{{0.11, 0.13}, {0.15, 0.17}, {0.12, 0.14}};
constexpr Range peduncle_m{0.26, 0.36};         // from the top node to the tassel; the lower half is inside the top sheath
constexpr Range base_diameter_m{0.022, 0.025};  // of the stem at its foot
constexpr Range top_diameter_m{0.012, 0.015};   // of the stem at the top node
constexpr double sheath_flare = 1.15;           // the collar of a sheath stands off the stem by one to two millimetres

// --- Directions and curvature of the leaves --------------------------------------------------------------------------

// Deviation of a plant's plane from the plane across the row, which plants follow only weakly: sd 60 degrees. With a
// narrower range the leaves of a dense stand would shade the ground more evenly than leaves placed at random, which maize
// does not (Espana et al. 1999).
constexpr Range plane_deviation_rad = degrees(-208.0, 208.0);
// Deviation of a leaf from its plant's plane: within 5 degrees at the foot and 30 degrees at the top in ADEL-maize (Fournier
// & Andrieu 1998, Annals of Botany 81:233).
constexpr RankProfile leaf_deviation_rad{degrees(-5.0, 5.0), degrees(-17.0, 17.0), degrees(-30.0, 30.0)};
// Angle from the stem to the midrib: 15 to 25 degrees at the top, 40 to 60 at the foot. Around the ear, public parametric
// maize has 35; modern hybrids are more erect (Ford et al. 2008).
constexpr RankProfile insertion_rad{degrees(40.0, 60.0), degrees(20.0, 36.0), degrees(15.0, 25.0)};
// Bending from the collar to the tip: about 120 degrees, two thirds of it before 0.7 of the length (public parametric
// maize); the short and stiff leaves at the top bend less.
constexpr RankProfile bending_rad{degrees(85.0, 115.0), degrees(100.0, 140.0), degrees(45.0, 85.0)};
constexpr Range bend_position{0.65, 0.75};
constexpr Range bend_sharpness{2.0, 3.0};  // the stiff third next to the stem stays nearly straight

// --- Blade surfaces -----------------------------------------------------------------------------------------------------

constexpr Range fold_rad = degrees(12.0, 28.0);  // the V opens to 125 to 155 degrees near the collar
constexpr double widest_wrap_rad = 2.0;          // the foot of the blade wraps two thirds of the stem
constexpr double opening_m = 0.04;               // the wrap opens within about one circumference of the stem
// The margins undulate by 1 to 2 cm on blades that are 10 cm wide, with 8 to 15 cm from crest to crest.
constexpr Range wave_amplitude_to_width{0.10, 0.20};
constexpr Range wave_length_m{0.08, 0.10};  // of the shorter wave; the other is 1.5 times as long

// --- Ear and tassel -----------------------------------------------------------------------------------------------------

constexpr Range ear_length_m{0.18, 0.22};
constexpr Range ear_diameter_m{0.047, 0.053};
constexpr Range ear_inclination_rad = degrees(20.0, 40.0);
constexpr double shank_length_m = 0.04;
constexpr double shank_radius_m = 0.009;
// The ear leaves its sheath past the margin, beside the leaf's midrib rather than under it.
constexpr Range ear_beside_leaf_rad = degrees(50.0, 75.0);
constexpr int husk_tip_count = 4;
constexpr Range husk_tip_length_m{0.06, 0.12};
constexpr Range husk_tip_insertion_rad = degrees(5.0, 25.0);
constexpr Range husk_tip_bending_rad = degrees(10.0, 80.0);

constexpr Range spike_length_m{0.30, 0.40};
constexpr int fewest_branches = 8;
constexpr int most_branches = 20;
constexpr double branched_share = 0.4;  // of the spike, from its foot
constexpr Range branch_length_m{0.13, 0.22};
constexpr Range branch_insertion_rad = degrees(20.0, 50.0);
constexpr Range branch_bending_rad = degrees(10.0, 60.0);
constexpr double spike_radius_m = 0.005;  // including spikelets
constexpr double branch_radius_m = 0.0035;

constexpr glm::dvec3 up{0.0, 1.0, 0.0};

glm::dvec3 horizontal(double angle_rad) {
  return {std::cos(angle_rad), 0.0, std::sin(angle_rad)};
}

// The values that are drawn once per plant, and the heights that follow from them.
struct Architecture {
  int leaf_count = 0;
  int first_green = 0;
  int ear_rank = 0;
  double plane_rad = 0.0;        // horizontal direction of even leaves, from X towards Z
  std::vector<double> node_m;    // [rank], height of the node on which leaf `rank` grows; [0] is the ground
  std::vector<double> collar_m;  // [rank], height at which the sheath ends and the blade begins
  double stem_top_m = 0.0;
  double base_radius_m = 0.0;
  double top_radius_m = 0.0;
};

Range at_rank(const RankProfile& profile, const Architecture& plant, int rank) {
  const bool below = rank < plant.ear_rank;
  const int from = below ? plant.first_green : plant.ear_rank;
  const int to = below ? plant.ear_rank : plant.leaf_count;
  const double t = static_cast<double>(rank - from) / (to - from);
  const Range& a = below ? profile.lowest : profile.ear;
  const Range& b = below ? profile.ear : profile.top;
  return {std::lerp(a.lo, b.lo, t), std::lerp(a.hi, b.hi, t)};
}

// Returns the length of the internode under node `rank`, relative to that under the ear's node.
double internode_share(int rank, int ear_rank, int leaf_count) {
  constexpr int first = crown_nodes + 1;
  if (rank < first) return 0.0;
  if (rank <= ear_rank) return std::lerp(first_internode_share, 1.0, static_cast<double>(rank - first) / (ear_rank - first));
  return std::lerp(1.0, top_internode_share, static_cast<double>(rank - ear_rank) / (leaf_count - ear_rank));
}

// Returns the heights of the nodes, with the internodes scaled so that the ear's node has the given height.
std::vector<double> node_heights(int ear_rank, int leaf_count, double ear_node_m) {
  std::vector<double> node(leaf_count + 1, 0.0);
  for (int rank = 1; rank <= leaf_count; ++rank) node[rank] = node[rank - 1] + internode_share(rank, ear_rank, leaf_count);
  const double scale = ear_node_m / node[ear_rank];
  for (double& height : node) height *= scale;
  return node;
}

Architecture draw_architecture(PlantRandom& random) {
  Architecture plant;
  plant.leaf_count = random.whole(fewest_leaves, most_leaves);
  plant.first_green = random.whole(fewest_senesced, most_senesced) + 1;
  plant.ear_rank = plant.leaf_count - leaves_above_ear;
  const int first_side = random.whole(0, 1);
  plant.plane_rad = pi * (0.5 + first_side) + random.around(plane_deviation_rad);
  plant.node_m = node_heights(plant.ear_rank, plant.leaf_count, random.around(ear_height_m));
  plant.collar_m = plant.node_m;
  for (int rank = crown_nodes + 1; rank <= plant.leaf_count; ++rank) {
    // Sheaths of dead leaves stay on the stem.
    plant.collar_m[rank] += random.around(at_rank(sheath_m, plant, std::max(rank, plant.first_green)));
  }
  plant.stem_top_m = plant.node_m.back() + random.around(peduncle_m);
  plant.base_radius_m = 0.5 * random.around(base_diameter_m);
  plant.top_radius_m = 0.5 * random.around(top_diameter_m);
  return plant;
}

// Returns the radius of the stem without sheaths: linear up to the top node, then linear down to the spike.
double bare_stem_radius(const Architecture& plant, double height_m) {
  const double top_node_m = plant.node_m.back();
  if (height_m <= top_node_m) return std::lerp(plant.base_radius_m, plant.top_radius_m, height_m / top_node_m);
  return std::lerp(plant.top_radius_m, spike_radius_m, (height_m - top_node_m) / (plant.stem_top_m - top_node_m));
}

// Returns the stem with its sheaths: each widens from the collar below to its own collar, where the stem reappears.
Tube make_stem(const Architecture& plant) {
  constexpr double rim_m = 0.004;
  constexpr int rings_per_sheath = 3;
  Tube stem;
  double from_m = 0.0;
  for (int rank = crown_nodes + 1; rank <= plant.leaf_count; ++rank) {
    const double to_m = plant.collar_m[rank];
    for (int i = 0; i <= rings_per_sheath; ++i) {
      const double t = static_cast<double>(i) / rings_per_sheath;
      const double height_m = std::lerp(from_m, to_m, t);
      stem.rings.push_back({height_m * up, bare_stem_radius(plant, height_m) * std::lerp(1.0, sheath_flare, t)});
    }
    from_m = to_m + rim_m;
  }
  stem.rings.push_back({from_m * up, bare_stem_radius(plant, from_m)});
  stem.rings.push_back({plant.stem_top_m * up, spike_radius_m});
  return stem;
}

MaizeLeaf draw_leaf(const Architecture& plant, int rank, double area_m2, PlantRandom& random) {
  Blade blade;
  const double azimuth_rad = plant.plane_rad + pi * (rank % 2) + random.even(at_rank(leaf_deviation_rad, plant, rank));
  const double collar_radius_m = sheath_flare * bare_stem_radius(plant, plant.collar_m[rank]);
  blade.outward = horizontal(azimuth_rad);
  blade.collar_m = plant.collar_m[rank] * up + collar_radius_m * blade.outward;

  const double ratio = random.around(at_rank(width_to_length, plant, rank));
  blade.length_m = std::sqrt(area_m2 / (blade_form_factor() * ratio));
  blade.width_m = ratio * blade.length_m;
  blade.insertion_rad = random.around(at_rank(insertion_rad, plant, rank));
  blade.bending_rad = random.around(at_rank(bending_rad, plant, rank));
  blade.bend_position = random.around(bend_position);
  blade.bend_sharpness = random.around(bend_sharpness);
  blade.fold_rad = random.around(fold_rad);
  const double half_foot_m = 0.5 * blade.width_m * relative_blade_width(0.0);
  blade.wrap_rad = std::min(widest_wrap_rad, half_foot_m / collar_radius_m);
  blade.opening_m = opening_m;
  blade.wave_amplitude_m = random.around(wave_amplitude_to_width) * blade.width_m;
  blade.wave_length_m = random.around(wave_length_m);
  blade.wave_phase_rad = {random.even({0.0, 2.0 * pi}), random.even({0.0, 2.0 * pi})};
  return {rank, blade};
}

std::vector<MaizeLeaf> draw_leaves(const Architecture& plant, PlantRandom& random) {
  const double largest_m2 = random.around(largest_area_m2);
  const double largest_rank = plant.ear_rank - random.around(largest_below_ear);
  const double k = curve_width * plant.leaf_count;
  std::vector<MaizeLeaf> leaves;
  for (int rank = plant.first_green; rank <= plant.leaf_count; ++rank) {
    const double distance = (rank - largest_rank) / k;
    const double area_m2 = largest_m2 * std::exp(-0.5 * distance * distance) * random.around(leaf_area_scatter);
    leaves.push_back(draw_leaf(plant, rank, area_m2, random));
  }
  return leaves;
}

// The position of the husked ear.
struct EarFrame {
  glm::dvec3 shank_foot_m;
  glm::dvec3 foot_m;  // foot of the husked body
  glm::dvec3 axis;
  glm::dvec3 sideways;  // horizontal, perpendicular to the axis
  double length_m = 0.0;
  double radius_m = 0.0;  // at the thickest place
};

EarFrame draw_ear_frame(const Architecture& plant, const glm::dvec3& ear_leaf_outward, PlantRandom& random) {
  const int side = 2 * random.whole(0, 1) - 1;
  const double leaf_azimuth_rad = std::atan2(ear_leaf_outward.z, ear_leaf_outward.x);
  const double azimuth_rad = leaf_azimuth_rad + side * random.around(ear_beside_leaf_rad);
  const double inclination_rad = random.around(ear_inclination_rad);
  const double node_m = plant.node_m[plant.ear_rank];
  const glm::dvec3 outward = horizontal(azimuth_rad);
  EarFrame ear;
  ear.axis = std::cos(inclination_rad) * up + std::sin(inclination_rad) * outward;
  ear.sideways = horizontal(azimuth_rad + 0.5 * pi);
  ear.shank_foot_m = node_m * up + bare_stem_radius(plant, node_m) * outward;
  ear.foot_m = ear.shank_foot_m + shank_length_m * ear.axis;
  ear.length_m = random.around(ear_length_m);
  ear.radius_m = 0.5 * random.around(ear_diameter_m);
  return ear;
}

// Returns the radius of a husked ear. Its silhouette is that of a leaf blade: broad at the foot, widest at a third, drawn
// out to a point.
double ear_radius(const EarFrame& ear, double s) {
  return ear.radius_m * relative_blade_width(s);
}

Tube make_ear(const EarFrame& ear) {
  constexpr int rings = 16;
  constexpr double shank_end = 0.8;  // from here on the shank widens into the body
  Tube tube;
  tube.plane_normal = ear.sideways;
  tube.rings.push_back({ear.shank_foot_m, shank_radius_m});
  tube.rings.push_back({glm::mix(ear.shank_foot_m, ear.foot_m, shank_end), shank_radius_m});
  for (int i = 0; i < rings; ++i) {
    const double s = static_cast<double>(i) / rings;
    tube.rings.push_back({ear.foot_m + s * ear.length_m * ear.axis, ear_radius(ear, s)});
  }
  tube.rings.push_back({ear.foot_m + ear.length_m * ear.axis, 0.0});
  return tube;
}

std::vector<Blade> draw_husk_tips(const EarFrame& ear, PlantRandom& random) {
  constexpr double start = 0.8;  // relative to the ear's length
  const glm::dvec3 inward = glm::cross(ear.axis, ear.sideways);
  std::vector<Blade> tips;
  for (int i = 0; i < husk_tip_count; ++i) {
    const double angle = 2.0 * pi * (i + random.even({0.25, 0.75})) / husk_tip_count;
    Blade tip;
    tip.axis = ear.axis;
    tip.outward = std::cos(angle) * ear.sideways + std::sin(angle) * inward;
    tip.collar_m = ear.foot_m + start * ear.length_m * ear.axis + ear_radius(ear, start) * tip.outward;
    tip.length_m = random.around(husk_tip_length_m);
    tip.width_m = ear.radius_m;
    tip.insertion_rad = random.around(husk_tip_insertion_rad);
    tip.bending_rad = random.around(husk_tip_bending_rad);
    tips.push_back(tip);
  }
  return tips;
}

// Returns a branch, which bends over in its own vertical plane.
Tube draw_tassel_branch(const glm::dvec3& foot_m, double azimuth_rad, PlantRandom& random) {
  constexpr int segments = 6;
  const double step_m = random.around(branch_length_m) / segments;
  const double foot_angle_rad = random.around(branch_insertion_rad);
  const double turn_rad = random.around(branch_bending_rad);
  const glm::dvec3 outward = horizontal(azimuth_rad);
  Tube branch;
  branch.plane_normal = horizontal(azimuth_rad + 0.5 * pi);
  glm::dvec3 position_m = foot_m;
  for (int i = 0; i <= segments; ++i) {
    const double taper = i == segments ? 0.0 : std::lerp(1.0, 0.5, static_cast<double>(i) / segments);
    branch.rings.push_back({position_m, taper * branch_radius_m});
    const double angle = foot_angle_rad + turn_rad * (i + 0.5) / segments;
    position_m += step_m * (std::cos(angle) * up + std::sin(angle) * outward);
  }
  return branch;
}

std::vector<Tube> draw_tassel(const Architecture& plant, PlantRandom& random) {
  constexpr int spike_rings = 8;
  const double golden_angle_rad = pi * (3.0 - std::sqrt(5.0));  // from branch to branch, around the spike
  const double length_m = random.around(spike_length_m);
  std::vector<Tube> tassel(1);
  for (int i = 0; i <= spike_rings; ++i) {
    const double s = static_cast<double>(i) / spike_rings;
    const double taper = i == spike_rings ? 0.0 : std::lerp(1.0, 0.5, s);
    tassel[0].rings.push_back({(plant.stem_top_m + s * length_m) * up, taper * spike_radius_m});
  }
  const int branches = random.whole(fewest_branches, most_branches);
  const double start_rad = random.even({0.0, 2.0 * pi});
  for (int i = 0; i < branches; ++i) {
    const double height_m = plant.stem_top_m + branched_share * length_m * i / branches;
    tassel.push_back(draw_tassel_branch(height_m * up, start_rad + golden_angle_rad * i, random));
  }
  return tassel;
}

}  // namespace

MaizePlant grow_maize_plant(std::uint64_t seed, std::uint32_t number) {
  PlantRandom random(seed, number);
  const Architecture architecture = draw_architecture(random);
  MaizePlant plant;
  plant.stem = make_stem(architecture);
  plant.leaves = draw_leaves(architecture, random);
  const Blade& ear_leaf = plant.leaves[architecture.ear_rank - architecture.first_green].blade;
  const EarFrame ear = draw_ear_frame(architecture, ear_leaf.outward, random);
  plant.ear = make_ear(ear);
  plant.husk_tips = draw_husk_tips(ear, random);
  plant.tassel = draw_tassel(architecture, random);
  return plant;
}

}  // namespace sunfleck
