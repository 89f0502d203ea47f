#include "physics/transport/model/columns.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "physics/transport/model/columns.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace sunfleck::columns::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

const hn::ScalableTag<double> reals;
const hn::ScalableTag<std::int64_t> wholes;
const hn::ScalableTag<std::uint64_t> words;
const hn::Rebind<std::uint32_t, decltype(words)> halves;
using Words = hn::Vec<decltype(words)>;

// Calls take(first column) for whole vectors of columns; returns the number of the first column that is left.
template <class Take>
HWY_INLINE std::size_t for_each_vector(std::size_t columns, const Take& take) {
  std::size_t c = 0;
  for (; c + hn::Lanes(words) <= columns; c += hn::Lanes(words)) take(c);
  return c;
}

HWY_INLINE Words load(const std::uint64_t* at) {
  return hn::LoadU(words, at);
}

HWY_INLINE Words load(const std::int64_t* at) {
  return hn::BitCast(words, hn::LoadU(wholes, at));
}

HWY_INLINE void add_at(std::uint64_t* at, Words terms) {
  hn::StoreU(hn::Add(load(at), terms), words, at);
}

HWY_INLINE void add_at(std::int64_t* at, Words terms) {
  hn::StoreU(hn::BitCast(wholes, hn::Add(load(at), terms)), wholes, at);
}

// Returns the products of the low words.
HWY_INLINE Words times(Words a, Words b) {
#if HWY_TARGET == HWY_SCALAR
  return hn::Set(words, (hn::GetLane(a) & shared::low_word) * (hn::GetLane(b) & shared::low_word));
#else
  const hn::Repartition<std::uint32_t, decltype(words)> low;
  return hn::MulEven(hn::BitCast(low, a), hn::BitCast(low, b));
#endif
}

// Returns shared::part_of for each column.
HWY_INLINE Words parts(Words quanta, Words coefficients, Words u) {
  const Words low = hn::ShiftRight<32>(hn::Add(times(quanta, coefficients), u));
  const Words part = hn::Add(times(hn::ShiftRight<32>(quanta), coefficients), low);
  return hn::IfThenElse(hn::Eq(coefficients, hn::Set(words, std::uint64_t{1} << 32U)), quanta, part);
}

// Returns shared::scaled for each column.
HWY_INLINE Words scaled(Words quanta, const FactorColumns& by, std::size_t column) {
  const Words mantissa = load(&by.value[column]);
  const Words shift = load(&by.shift[column]);
  const Words high = hn::Shl(times(hn::ShiftRight<32>(quanta), mantissa), hn::Sub(hn::Set(words, 32), shift));
  return hn::Add(high, hn::Shr(times(quanta, mantissa), shift));
}

// Joins the scaled parts of whole vectors of columns to `reflected` and `transmitted`, lane by lane; returns the number of the
// first column that is left.
template <class Join>
HWY_INLINE std::size_t join_parts(std::span<const std::int64_t> landed, const ScatteredParts& of, const FactorColumns& by,
                                  std::size_t first, const Join& join, Words& reflected, Words& transmitted) {
  const Words u = hn::Set(words, of.u);
  return for_each_vector(landed.size(), [&](std::size_t k) HWY_ATTR {
    const Words quanta = load(&landed[k]);
    const Words low = parts(quanta, load(of.reflected + first + k), u);
    reflected = join(reflected, scaled(low, by, first + k));
    if (of.scattered == nullptr) return;
    const Words high = parts(quanta, load(of.scattered + first + k), u);
    transmitted = join(transmitted, scaled(hn::Sub(high, low), by, first + k));
  });
}

OfBothParts sum_scaled(std::span<const std::int64_t> landed, const ScatteredParts& of, const FactorColumns& by,
                       std::size_t first) {
  Words reflected = hn::Zero(words);
  Words transmitted = hn::Zero(words);
  const auto join = [](Words a, Words b) HWY_ATTR { return hn::Add(a, b); };
  const std::size_t rest = join_parts(landed, of, by, first, join, reflected, transmitted);
  const OfBothParts others = singly::sum_scaled(rest, landed, of, by, first);
  return {hn::GetLane(hn::SumOfLanes(words, reflected)) + others.reflected,
          hn::GetLane(hn::SumOfLanes(words, transmitted)) + others.transmitted};
}

OfBothParts largest_scaled(std::span<const std::int64_t> landed, const ScatteredParts& of, const FactorColumns& by,
                           std::size_t first) {
  Words reflected = hn::Zero(words);
  Words transmitted = hn::Zero(words);
  const auto join = [](Words a, Words b) HWY_ATTR { return hn::Max(a, b); };
  const std::size_t rest = join_parts(landed, of, by, first, join, reflected, transmitted);
  return singly::largest_of(singly::largest_scaled(rest, landed, of, by, first),
                            {hn::GetLane(hn::MaxOfLanes(words, reflected)), hn::GetLane(hn::MaxOfLanes(words, transmitted))});
}

void weigh(std::span<const std::int64_t> landed, const SentPart& sent, const FactorColumns& by, std::size_t first,
           const shared::Sharing& sharing, std::uint32_t* weights, std::uint64_t* sums) {
  const Words u = hn::Set(words, sent.u);
  const Words inverse = hn::Set(words, sharing.inverse);
  const Words all_bits = hn::Set(words, shared::low_word);
  const Words half_bit = hn::Set(words, shared::half_of(sharing));
  const Words half_weight = hn::Set(words, std::uint64_t{1} << 31U);
  const Words right = hn::Set(words, static_cast<std::uint64_t>(std::max(0, sharing.shift_right)));
  const Words left = hn::Set(words, static_cast<std::uint64_t>(std::max(0, -sharing.shift_right)));
  const std::size_t rest = for_each_vector(landed.size(), [&](std::size_t k) HWY_ATTR {
    const Words quanta = load(&landed[k]);
    const Words up_to = parts(quanta, load(sent.to + first + k), u);
    const Words before = sent.from != nullptr ? parts(quanta, load(sent.from + first + k), u) : hn::Zero(words);
    const Words expected = scaled(hn::Sub(up_to, before), by, first + k);
    const Words bits = hn::Min(hn::Shl(hn::Shr(hn::Add(expected, half_bit), right), left), all_bits);
    const Words weight = hn::ShiftRight<32>(hn::Add(times(bits, inverse), half_weight));
    hn::StoreU(hn::TruncateTo(halves, weight), halves, weights + k);
    add_at(sums + first + k, weight);
  });
  singly::weigh(rest, landed, sent, by, first, sharing, weights, sums);
}

void carry(std::span<const std::uint32_t> weights, const FactorColumns& loads, std::size_t first, std::int64_t* quanta) {
  const std::size_t rest = for_each_vector(weights.size(), [&](std::size_t k) HWY_ATTR {
    const Words weight = hn::PromoteTo(words, hn::LoadU(halves, &weights[k]));
    const Words factor = load(&loads.value[first + k]);
    const Words product = hn::Add(times(weight, hn::ShiftRight<32>(factor)), hn::ShiftRight<32>(times(weight, factor)));
    const Words shift = hn::Sub(load(&loads.shift[first + k]), hn::Set(words, 32));
    hn::StoreU(hn::BitCast(wholes, hn::Shr(product, shift)), wholes, quanta + k);
  });
  singly::carry(rest, weights, loads, first, quanta);
}

void split(std::span<const std::int64_t> landed, const std::uint64_t* coefficients, std::uint32_t u, std::int64_t* absorbed,
           std::int64_t* scattered) {
  const Words random = hn::Set(words, u);
  const std::size_t rest = for_each_vector(landed.size(), [&](std::size_t k) HWY_ATTR {
    const Words quanta = load(&landed[k]);
    const Words left = parts(quanta, load(coefficients + k), random);
    add_at(absorbed + k, hn::Sub(quanta, left));
    hn::StoreU(hn::BitCast(wholes, left), wholes, scattered + k);
  });
  singly::split(rest, landed, coefficients, u, absorbed, scattered);
}

void add(std::span<const std::int64_t> quanta, std::int64_t* sums) {
  const std::size_t rest = for_each_vector(quanta.size(), [&](std::size_t c) HWY_ATTR {
    hn::StoreU(hn::Add(hn::LoadU(wholes, sums + c), hn::LoadU(wholes, &quanta[c])), wholes, sums + c);
  });
  singly::add(rest, quanta, sums);
}

void subtract(std::span<const std::int64_t> quanta, std::int64_t* sums) {
  const std::size_t rest = for_each_vector(quanta.size(), [&](std::size_t c) HWY_ATTR {
    hn::StoreU(hn::Sub(hn::LoadU(wholes, sums + c), hn::LoadU(wholes, &quanta[c])), wholes, sums + c);
  });
  singly::subtract(rest, quanta, sums);
}

void scale(std::span<const std::int64_t> quanta, std::span<const double> a, double b, std::span<const double> c,
           std::span<double> products) {
  const std::size_t rest = for_each_vector(quanta.size(), [&](std::size_t k) HWY_ATTR {
    auto product = hn::Mul(hn::ConvertTo(reals, hn::LoadU(wholes, &quanta[k])), hn::LoadU(reals, &a[k]));
    product = hn::Mul(product, hn::Set(reals, b));
    hn::StoreU(hn::Mul(product, hn::LoadU(reals, &c[k])), reals, &products[k]);
  });
  singly::scale(rest, quanta, a, b, c, products);
}

void add_share(double share, std::span<const double> a, std::span<const double* const> by, std::span<double* const> sums) {
  const std::size_t rest = for_each_vector(a.size(), [&](std::size_t c) HWY_ATTR {
    const auto part = hn::Mul(hn::Set(reals, share), hn::LoadU(reals, &a[c]));
    hn::StoreU(hn::Add(hn::LoadU(reals, sums[0] + c), part), reals, sums[0] + c);
    for (std::size_t k = 0; k < by.size(); ++k) {
      // Not MulAdd, which rounds once.
      const auto product = hn::Mul(hn::LoadU(reals, by[k] + c), part);
      hn::StoreU(hn::Add(hn::LoadU(reals, sums[k + 1] + c), product), reals, sums[k + 1] + c);
    }
  });
  singly::add_share(rest, share, a, by, sums);
}

void add_scaled(double factor, std::span<const double> a, std::span<double> sums) {
  const std::size_t rest = for_each_vector(a.size(), [&](std::size_t c) HWY_ATTR {
    const auto product = hn::Mul(hn::Set(reals, factor), hn::LoadU(reals, &a[c]));
    hn::StoreU(hn::Add(hn::LoadU(reals, &sums[c]), product), reals, &sums[c]);
  });
  singly::add_scaled(rest, factor, a, sums);
}

const InVectors* functions() {
  static constexpr InVectors all{sum_scaled, largest_scaled, weigh, carry, split, add, subtract, scale, add_share, add_scaled};
  return &all;
}

}  // namespace sunfleck::columns::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sunfleck {
namespace columns {

HWY_EXPORT(functions);

const InVectors& in_vectors() {
  static const InVectors& widest = *HWY_DYNAMIC_DISPATCH(functions)();
  return widest;
}

}  // namespace columns

FaceColumns::FaceColumns(const std::vector<FaceOptics>& face, std::size_t lights) {
  for (const FaceOptics& band : face) {
    const SplitCoefficients of = split_coefficients(band.reflectance, band.transmittance);
    reflected.insert(reflected.end(), lights, of.reflected);
    scattered.insert(scattered.end(), lights, of.scattered);
    transmits = transmits || of.scattered != of.reflected;
  }
}

}  // namespace sunfleck
#endif
