#include "physics/transport/model/columns.h"

#include <array>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "physics/transport/model/columns.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace sunfleck::columns::in_vectors::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

const hn::ScalableTag<double> reals;
const hn::ScalableTag<std::int64_t> wholes;

// Calls take(first column) for whole vectors of columns; returns the number of the first column that is left.
template <class Take>
HWY_INLINE std::size_t for_each_vector(std::size_t columns, const Take& take) {
  std::size_t c = 0;
  for (; c + hn::Lanes(reals) <= columns; c += hn::Lanes(reals)) take(c);
  return c;
}

void split(const FaceColumns& face, const SplitColumns& row) {
  const std::size_t rest = for_each_vector(row.landed.size(), [&](std::size_t c) HWY_ATTR {
    const auto landed = hn::LoadU(wholes, &row.landed[c]);
    const auto real = hn::ConvertTo(reals, landed);
    const auto u = hn::LoadU(reals, &row.u[c]);
    const auto part = [&](const double* coefficient) HWY_ATTR {  // ConvertTo saturates, as split_quanta does
      const auto rounded = hn::ConvertTo(wholes, hn::Add(hn::Mul(real, hn::LoadU(reals, coefficient)), u));
      return hn::Min(landed, rounded);
    };
    const auto reflected = part(&face.reflected[c]);
    const auto transmitted = hn::Max(hn::Zero(wholes), hn::Sub(part(&face.scattered[c]), reflected));
    const auto absorbed = hn::Sub(hn::Sub(landed, reflected), transmitted);
    hn::StoreU(hn::Add(hn::LoadU(wholes, &row.absorbed[c]), absorbed), wholes, &row.absorbed[c]);
    hn::StoreU(reflected, wholes, &row.reflected[c]);
    hn::StoreU(transmitted, wholes, &row.transmitted[c]);
  });
  singly::split(rest, face, row);
}

void weigh(std::span<const std::int64_t> quanta, double expected, std::int64_t packet, SharedOut& shared) {
  const auto per = hn::Set(reals, expected);
  const auto number = hn::Set(wholes, packet);
  const std::size_t rest = for_each_vector(quanta.size(), [&](std::size_t c) HWY_ATTR {
    const auto own = hn::LoadU(wholes, &quanta[c]);
    const auto weight = hn::Div(hn::ConvertTo(reals, own), per);
    hn::StoreU(hn::Add(hn::LoadU(reals, &shared.weights[c]), weight), reals, &shared.weights[c]);
    const auto any = hn::Gt(own, hn::Zero(wholes));
    hn::StoreU(hn::IfThenElse(any, number, hn::LoadU(wholes, &shared.last[c])), wholes, &shared.last[c]);
  });
  singly::weigh(rest, quanta, expected, packet, shared);
}

void share(std::span<const std::int64_t> quanta, double expected, std::int64_t packet, SharedOut& shared,
           std::span<std::int64_t> own) {
  const auto per = hn::Set(reals, expected);
  const auto number = hn::Set(wholes, packet);
  const std::size_t rest = for_each_vector(quanta.size(), [&](std::size_t c) HWY_ATTR {
    const auto quantas = hn::LoadU(wholes, &quanta[c]);
    const auto none = hn::Eq(quantas, hn::Zero(wholes));
    const auto weight = hn::Div(hn::ConvertTo(reals, quantas), per);
    const auto sum = hn::Add(hn::LoadU(reals, &shared.sums[c]), weight);
    hn::StoreU(sum, reals, &shared.sums[c]);
    const auto total = hn::LoadU(wholes, &shared.totals[c]);
    const auto given = hn::LoadU(wholes, &shared.given[c]);
    // Without any weight the ratio is no number; the row is then 0 there, and the result is not used.
    const auto ratio = hn::Div(sum, hn::LoadU(reals, &shared.weights[c]));
    const auto part = hn::ConvertTo(wholes, hn::Mul(ratio, hn::ConvertTo(reals, total)));
    const auto between = hn::Min(hn::Max(part, given), total);
    const auto is_last = hn::Eq(number, hn::LoadU(wholes, &shared.last[c]));
    const auto up_to = hn::IfThenElse(none, given, hn::IfThenElse(is_last, total, between));
    hn::StoreU(hn::Sub(up_to, given), wholes, &own[c]);
    hn::StoreU(up_to, wholes, &shared.given[c]);
  });
  singly::share(rest, quanta, expected, packet, shared, own);
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

void divide(std::span<const std::int64_t> quanta, std::span<const double> by, std::span<double> ratios) {
  const std::size_t rest = for_each_vector(quanta.size(), [&](std::size_t c) HWY_ATTR {
    const auto real = hn::ConvertTo(reals, hn::LoadU(wholes, &quanta[c]));
    hn::StoreU(hn::Div(real, hn::LoadU(reals, &by[c])), reals, &ratios[c]);
  });
  singly::divide(rest, quanta, by, ratios);
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

void add_products(std::span<const double> a, std::span<const double> b, std::span<double> sums) {
  const std::size_t rest = for_each_vector(a.size(), [&](std::size_t c) HWY_ATTR {
    // Not MulAdd, which rounds once.
    const auto product = hn::Mul(hn::LoadU(reals, &a[c]), hn::LoadU(reals, &b[c]));
    hn::StoreU(hn::Add(hn::LoadU(reals, &sums[c]), product), reals, &sums[c]);
  });
  singly::add_products(rest, a, b, sums);
}

void add_scaled(double factor, std::span<const double> a, std::span<double> sums) {
  const std::size_t rest = for_each_vector(a.size(), [&](std::size_t c) HWY_ATTR {
    const auto product = hn::Mul(hn::Set(reals, factor), hn::LoadU(reals, &a[c]));
    hn::StoreU(hn::Add(hn::LoadU(reals, &sums[c]), product), reals, &sums[c]);
  });
  singly::add_scaled(rest, factor, a, sums);
}

}  // namespace sunfleck::columns::in_vectors::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sunfleck {
namespace columns {
namespace in_vectors {

HWY_EXPORT(split);
HWY_EXPORT(weigh);
HWY_EXPORT(share);
HWY_EXPORT(add);
HWY_EXPORT(subtract);
HWY_EXPORT(divide);
HWY_EXPORT(scale);
HWY_EXPORT(add_products);
HWY_EXPORT(add_scaled);

void split(const FaceColumns& face, const SplitColumns& row) {
  HWY_DYNAMIC_DISPATCH(split)(face, row);
}

void weigh(std::span<const std::int64_t> quanta, double expected, std::int64_t packet, SharedOut& shared) {
  HWY_DYNAMIC_DISPATCH(weigh)(quanta, expected, packet, shared);
}

void share(std::span<const std::int64_t> quanta, double expected, std::int64_t packet, SharedOut& shared,
           std::span<std::int64_t> own) {
  HWY_DYNAMIC_DISPATCH(share)(quanta, expected, packet, shared, own);
}

void add(std::span<const std::int64_t> quanta, std::int64_t* sums) {
  HWY_DYNAMIC_DISPATCH(add)(quanta, sums);
}

void subtract(std::span<const std::int64_t> quanta, std::int64_t* sums) {
  HWY_DYNAMIC_DISPATCH(subtract)(quanta, sums);
}

void divide(std::span<const std::int64_t> quanta, std::span<const double> by, std::span<double> ratios) {
  HWY_DYNAMIC_DISPATCH(divide)(quanta, by, ratios);
}

void scale(std::span<const std::int64_t> quanta, std::span<const double> a, double b, std::span<const double> c,
           std::span<double> products) {
  HWY_DYNAMIC_DISPATCH(scale)(quanta, a, b, c, products);
}

void add_products(std::span<const double> a, std::span<const double> b, std::span<double> sums) {
  HWY_DYNAMIC_DISPATCH(add_products)(a, b, sums);
}

void add_scaled(double factor, std::span<const double> a, std::span<double> sums) {
  HWY_DYNAMIC_DISPATCH(add_scaled)(factor, a, sums);
}

}  // namespace in_vectors

void sum_ratios(std::span<const std::span<const std::int64_t>> rows, std::span<const double> by, std::span<double> sums) {
  const std::size_t count = by.size();
  if (count < least_in_vectors) {  // by way of an array, runs with two bands took 4 % longer
    for (std::size_t row = 0; row < sums.size(); ++row) {
      double sum = 0.0;
      for (std::size_t c = 0; c < count; ++c) sum += static_cast<double>(rows[row][c]) / by[c];
      sums[row] = sum;
    }
    return;
  }
  // Each addition waits for the one before it, so that rows are added side by side.
  constexpr std::size_t at_once = 8;
  std::vector<double> ratios(at_once * count);
  for (std::size_t first = 0; first < sums.size(); first += at_once) {
    const std::size_t those = std::min(at_once, sums.size() - first);
    for (std::size_t k = 0; k < those; ++k) {
      in_vectors::divide(rows[first + k], by, std::span(ratios).subspan(k * count, count));
    }
    std::array<double, at_once> sum{};
    for (std::size_t c = 0; c < count; ++c) {
      for (std::size_t k = 0; k < at_once; ++k) sum[k] += ratios[k * count + c];
    }
    std::copy_n(sum.begin(), those, sums.begin() + static_cast<std::ptrdiff_t>(first));
  }
}

}  // namespace columns

FaceColumns::FaceColumns(const std::vector<FaceOptics>& face, std::size_t lights) {
  for (const FaceOptics& band : face) {
    const SplitCoefficients of = split_coefficients(band.reflectance, band.transmittance);
    reflected.insert(reflected.end(), lights, of.reflected);
    scattered.insert(scattered.end(), lights, of.scattered);
  }
}

}  // namespace sunfleck
#endif
