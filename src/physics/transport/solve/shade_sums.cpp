#include "physics/transport/solve/shade_sums.h"

#include "base/prefetch.h"
#include "physics/transport/model/columns.h"
#include "physics/transport/model/layer_shares.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

namespace sunfleck {
namespace {

// A replicate is summed in parts side by side, each with sums of its own, which are then added up in their order. Their number
// depends on the scene and on what landed, never on threads, devices or how sums are kept, so that they have the same bits on
// every machine.
constexpr std::size_t most_parts = 16;
constexpr std::size_t most_bytes_of_parts = std::size_t{1} << 24U;
constexpr std::size_t least_of_part = 2048;  // landings and sides

constexpr std::vector<double> ShadeSums::*by_band[] = {&ShadeSums::direct_w,        &ShadeSums::indirect_w,
                                                       &ShadeSums::lit_indirect_w,  &ShadeSums::lit_square,
                                                       &ShadeSums::indirect_square, &ShadeSums::lit_indirect_square};

// Returns the beginning of a part of `count` things.
std::size_t begin_of(std::size_t part, std::size_t parts, std::size_t count) {
  return part * count / parts;
}

// How much of an element, or of its part in a layer, the sun shines on in one replicate. [band]
struct LitPart {
  explicit LitPart(std::size_t bands) : part(bands), twice_beam_w_m2(bands), earlier_w_m2(bands) {}

  bool any = false;          // whether the rest is set
  std::vector<double> part;  // of the area
  std::vector<double> twice_beam_w_m2;
  std::vector<double> earlier_w_m2;  // SideLight::earlier_w_m2 times the part
};

// What a side absorbs of other light than the beam in one replicate. All but the first is the same for both sides of an element.
// [band]
struct SideLight {
  explicit SideLight(std::size_t bands) : absorbed_w(bands), earlier_w_m2(bands), lit(bands), space(bands) {}

  // Adds the share of it that belongs to a group, where the sun shines on `lit_part`.
  void add_to(ShadeSums& sums, std::size_t group, double share, const LitPart& lit_part) const {
    const std::array by{earlier_w_m2.data(), lit_part.part.data(), lit_part.twice_beam_w_m2.data(),
                        lit_part.earlier_w_m2.data()};
    const std::array to{sums.of(group, sums.indirect_w).data(), sums.of(group, sums.indirect_square).data(),
                        sums.of(group, sums.lit_indirect_w).data(), sums.of(group, sums.lit_square).data(),
                        sums.of(group, sums.lit_indirect_square).data()};
    columns::add_share(share, absorbed_w, std::span(by).first(lit_part.any ? by.size() : 1), to);
  }

  std::vector<double> absorbed_w;
  std::optional<std::size_t> element;  // the one that the rest was set for
  double per_m2 = 0.0;                 // 1 / its area
  std::vector<double> earlier_w_m2;    // of both sides in all earlier replicates together
  LitPart lit;                         // of the whole element
  std::vector<double> space;
};

// What the beam brings to the part of an element in a layer.
struct BinLight {
  explicit BinLight(std::size_t bands) : direct_w(bands), square(bands) {}

  void add_to(ShadeSums& sums, std::size_t group) const {
    sums.lit_m2[group] += lit_m2;
    columns::add_scaled(1.0, direct_w, sums.of(group, sums.direct_w));
    if (any_lit) columns::add_scaled(1.0, square, sums.of(group, sums.lit_square));
  }

  double lit_m2 = 0.0;
  bool any_lit = false;
  std::vector<double> direct_w, square;  // [band], W and, if any_lit, W2 m-2
};

class ShadeAddition {
 public:
  ShadeAddition(const Conversion& conversion, const Replicate& replicate, PlaceSums& landed, bool all_groups)
      : conversion_(conversion),
        canopy_(conversion.model.canopy),
        replicate_(replicate),
        all_groups_(all_groups),
        bands_(conversion.quanta.size()),
        landed_(landed),
        adds_on_the_way_(replicate.packets && replicate.packets->side_landed.has_rows() && landed.has_rows()),
        earlier_(landed),
        hit_(canopy_.size()) {
    for (std::size_t b = 0; b < bands_; ++b) {
      w_m2_per_quantum_.push_back(conversion.quanta[b].w_m2_per_quantum);
      beam_w_per_landing_.push_back(conversion.ground_per_ray_m2 * conversion.beam_w_m2(b));
    }
    for (const std::uint32_t e : replicate.direct.hit) hit_[e] = true;
  }

  // Sums the replicate, and adds its landings to those of all replicates before.
  ShadeGroupSums sum() const {
    ShadeGroupSums sums(conversion_, all_groups_);
    if (adds_on_the_way_) landed_.append_rows_of(replicate_.packets->side_landed);
    const std::size_t parts = number_of_parts(sums);
    std::vector<ShadeGroupSums> others(parts - 1, sums);
    tbb::parallel_for(std::size_t{0}, parts, [&](std::size_t part) {
      ShadeGroupSums& own = part == 0 ? sums : others[part - 1];
      if (conversion_.model.has_beam()) add_beam(begin_of(part, parts, hits()), begin_of(part + 1, parts, hits()), own);
      if (replicate_.packets) add_other_light(begin_of(part, parts, sides()), begin_of(part + 1, parts, sides()), own);
    });
    for (const ShadeGroupSums& other : others) sums.add(other);
    if (adds_on_the_way_) {
      for (std::size_t part = 1; part < parts; ++part) add_cut_element(begin_of(part, parts, sides()));
    } else if (replicate_.packets) {
      landed_.add(replicate_.packets->side_landed);
    }
    return sums;
  }

 private:
  [[nodiscard]] std::size_t hits() const { return replicate_.direct.hit.size(); }
  [[nodiscard]] std::size_t sides() const { return replicate_.packets ? replicate_.packets->side_landed.places() : 0; }

  [[nodiscard]] std::size_t number_of_parts(const ShadeGroupSums& sums) const {
    const std::size_t groups = sums.organs.groups() + sums.layers.groups() + sums.leaves.groups();
    const std::size_t bytes = groups * (1 + std::size(by_band) * bands_) * sizeof(double);
    return std::clamp<std::size_t>(std::min(most_bytes_of_parts / bytes, (hits() + sides()) / least_of_part), 1, most_parts);
  }

  void add_beam(std::size_t first_hit, std::size_t end_hit, ShadeGroupSums& groups) const {
    BinLight light(bands_);
    for (std::size_t hit = first_hit; hit < end_hit; ++hit) {
      const std::uint32_t e = replicate_.direct.hit[hit];
      const bool foliage = conversion_.areas.foliage[e];
      if (!all_groups_ && !foliage) continue;
      const std::size_t first = first_layer(conversion_.layout, canopy_.corners[e]);
      std::size_t word = conversion_.layout.first_bin_word + 2 * std::size_t{conversion_.layout.first_bin[e]};
      for (std::size_t k = first; k < conversion_.layout.end_layer(e, first); ++k, word += 2) {
        const double upper = replicate_.counters[word];
        const double lower = replicate_.counters[word + 1];
        if (upper + lower == 0.0) continue;
        set_beam(e, upper, lower, light);
        if (foliage) light.add_to(groups.leaves, 0);
        if (!all_groups_) continue;
        light.add_to(groups.organs, canopy_.organ_of[e]);
        if (foliage) light.add_to(groups.layers, k);
      }
    }
  }

  // Sets what these landings of the beam on the two sides of an element bring to one layer.
  void set_beam(std::size_t e, double upper, double lower, BinLight& light) const {
    const double lit_m2_per_landing = conversion_.exposure.lit_m2_per_landing(e);
    light.lit_m2 = (upper + lower) * lit_m2_per_landing;
    light.any_lit = lit_m2_per_landing > 0.0;
    const std::span<const double> upper_part = conversion_.absorptances(canopy_.optics_of[e], 0);
    const std::span<const double> lower_part = conversion_.absorptances(canopy_.optics_of[e], 1);
    for (std::size_t b = 0; b < bands_; ++b) {
      const double upper_w = beam_w_per_landing_[b] * upper_part[b];
      const double lower_w = beam_w_per_landing_[b] * lower_part[b];
      light.direct_w[b] = upper * upper_w + lower * lower_w;
      if (!light.any_lit) continue;
      light.square[b] = (upper * upper_w * upper_w + lower * lower_w * lower_w) / lit_m2_per_landing;
    }
  }

  void add_other_light(std::size_t first_side, std::size_t end_side, ShadeGroupSums& groups) const {
    LayerShares shares(conversion_.layout);
    SideLight light(bands_);
    LitPart lit_in_layer(bands_);
    const std::span<const Triangle> own =
        canopy_.corners.copies().empty() ? canopy_.corners.own() : std::span<const Triangle>();
    const auto come = [&](std::size_t side) {
      earlier_.prefetch(side);
      earlier_.prefetch(side ^ std::size_t{1});
      prefetch(conversion_.areas.per_m2[side / 2]);
      if (!own.empty()) prefetch(own[side / 2]);
    };
    const auto add_side = [&](std::size_t side, std::span<const std::int64_t> quanta) {
      const std::size_t e = side / 2;
      const bool foliage = conversion_.areas.foliage[e];
      if (!all_groups_ && !foliage) return;
      set_light(side, quanta, light);
      if (foliage) light.add_to(groups.leaves, 0, 1.0, light.lit);
      if (!all_groups_) return;
      light.add_to(groups.organs, canopy_.organ_of[e], 1.0, light.lit);
      if (foliage) add_to_layers(e, light, shares, lit_in_layer, groups.layers);
    };
    // An element whose sides are in two parts gets its landings when both are done.
    const std::size_t first_whole = first_side + first_side % 2;
    const std::size_t end_whole = end_side - end_side % 2;
    const auto take_side = [&](std::size_t side, std::span<const std::int64_t> quanta) {
      add_side(side, quanta);
      if (adds_on_the_way_ && side >= first_whole && side < end_whole) landed_.add(side, quanta);
    };
    replicate_.packets->side_landed.for_each(first_side, end_side, take_side, come);
  }

  // Adds the landings on both sides of an element if a part begins with the second.
  void add_cut_element(std::size_t begin) const {
    if (begin % 2 == 0) return;
    const auto add = [&](std::size_t side, std::span<const std::int64_t> quanta) { landed_.add(side, quanta); };
    replicate_.packets->side_landed.for_each(begin - 1, begin + 1, add, [](std::size_t) {});
  }

  void set_light(std::size_t side, std::span<const std::int64_t> quanta, SideLight& light) const {
    set_absorbed_w(side, quanta, light.absorbed_w);
    const std::size_t e = side / 2;
    if (std::exchange(light.element, e) == e) return;
    light.per_m2 = conversion_.areas.per_m2[e];
    std::fill(light.earlier_w_m2.begin(), light.earlier_w_m2.end(), 0.0);
    for (const std::size_t of : {2 * e, 2 * e + 1}) {
      const auto landed = earlier_.at(of);
      if (landed.empty()) continue;
      set_absorbed_w(of, landed, light.space);
      columns::add_scaled(light.per_m2, light.space, light.earlier_w_m2);
    }
    light.lit.any = hit_[e];  // most elements have no landing of the beam in a replicate
    if (light.lit.any) set_lit(e, conversion_.element_landings(replicate_.counters, e), light.per_m2, light, light.lit);
  }

  // Sets what depends on the sunlit part of an element, or of its part in a layer with an area of 1 / per_m2, from the beam's
  // landings there.
  void set_lit(std::size_t e, const BeamLandings& landings, double per_m2, const SideLight& light, LitPart& lit) const {
    const double part = static_cast<double>(landings.both()) * conversion_.exposure.lit_m2_per_landing(e) * per_m2;
    const auto upper = static_cast<double>(landings.upper);
    const auto lower = static_cast<double>(landings.lower);
    const std::span<const double> upper_part = conversion_.absorptances(canopy_.optics_of[e], 0);
    const std::span<const double> lower_part = conversion_.absorptances(canopy_.optics_of[e], 1);
    for (std::size_t b = 0; b < bands_; ++b) {
      const double beam_w = beam_w_per_landing_[b] * (upper * upper_part[b] + lower * lower_part[b]);
      lit.part[b] = part;
      lit.twice_beam_w_m2[b] = 2.0 * (beam_w * per_m2);
      lit.earlier_w_m2[b] = part * light.earlier_w_m2[b];
    }
  }

  // Adds the light on a side to the layers into which its element reaches: the light that is not the beam's is taken to be even
  // over the element, but the sun may shine on all of its part in one layer and on none in another.
  void add_to_layers(std::size_t e, const SideLight& light, LayerShares& shares, LitPart& lit_in_layer,
                     ShadeSums& layers) const {
    const Triangle corners = canopy_.corners[e];
    const std::size_t first = first_layer(conversion_.layout, corners);
    const std::size_t first_word = conversion_.layout.first_bin_word + 2 * std::size_t{conversion_.layout.first_bin[e]};
    shares.visit(e, corners, [&](std::size_t k, double share) {
      if (share == 1.0 || !light.lit.any) return light.add_to(layers, k, share, light.lit);
      const std::size_t word = first_word + 2 * (k - first);
      const BeamLandings landings{replicate_.counters[word], replicate_.counters[word + 1]};
      lit_in_layer.any = share > 0.0 && landings.both() > 0;
      if (lit_in_layer.any) set_lit(e, landings, light.per_m2 / share, light, lit_in_layer);
      light.add_to(layers, k, share, lit_in_layer);
    });
  }

  // Sets what a side absorbs of other light, [band].
  void set_absorbed_w(std::size_t side, std::span<const std::int64_t> quanta, std::span<double> absorbed_w) const {
    columns::scale(quanta, w_m2_per_quantum_, conversion_.model.plot.area_m2(),
                   conversion_.absorptances(canopy_.optics_of[side / 2], side % 2), absorbed_w);
  }

  const Conversion& conversion_;
  const Canopy& canopy_;
  const Replicate& replicate_;
  bool all_groups_;
  std::size_t bands_;
  PlaceSums& landed_;
  bool adds_on_the_way_;
  PlaceSums::Finder earlier_;  // in landed_; an element's rows are read before any of its sides is added
  std::vector<bool> hit_;      // [element]
  std::vector<double> w_m2_per_quantum_, beam_w_per_landing_;  // [band]
};

}  // namespace

ShadeSums::ShadeSums(std::size_t groups, std::size_t number_of_bands) : bands(number_of_bands), lit_m2(groups) {
  for (const auto sums : by_band) (this->*sums).resize(groups * bands);
}

void ShadeSums::add(const ShadeSums& other) {
  columns::add_scaled(1.0, other.lit_m2, lit_m2);
  for (const auto sums : by_band) columns::add_scaled(1.0, other.*sums, this->*sums);
}

ShadeGroupSums::ShadeGroupSums(const Conversion& conversion, bool all_groups)
    : organs(all_groups ? conversion.areas.organ_open_m2.size() : 0, conversion.quanta.size()),
      layers(all_groups ? conversion.areas.layer_open_foliage_m2.size() : 0, conversion.quanta.size()),
      leaves(1, conversion.quanta.size()) {}

void ShadeGroupSums::add(const ShadeGroupSums& other) {
  organs.add(other.organs);
  layers.add(other.layers);
  leaves.add(other.leaves);
}

ShadeGroupSums sum_shade_and_add(const Conversion& conversion, const Replicate& replicate, bool all_groups, PlaceSums& landed) {
  return ShadeAddition(conversion, replicate, landed, all_groups).sum();
}

}  // namespace sunfleck
