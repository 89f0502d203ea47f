#pragma once
// Arithmetic over the columns of a place or packet, such as two hundred wavebands: in vectors by Google Highway where there are many,
// one by one where there are few. Both give the same bits on every kind of processor.

#include "physics/transport/model/model.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace sunfleck {

// Landed quanta are split into parts that add up to them exactly. Each part is its exact share rounded down or up at random, so that
// its expectation is right; a part whose coefficient is 0 gets exactly 0.
struct QuantaSplit {
  std::int64_t absorbed = 0, reflected = 0, transmitted = 0;
  [[nodiscard]] std::int64_t scattered() const { return reflected + transmitted; }
};

// Coefficients of what a face reflects, and of what it reflects or transmits; 2 where that is everything to within rounding, so that
// split_quanta finds all quanta.
struct SplitCoefficients {
  double reflected = 0.0, scattered = 0.0;
};
[[nodiscard]] inline SplitCoefficients split_coefficients(double reflectance, double transmittance) {
  constexpr double everything = 2.0;
  const bool absorbs = 1.0 - reflectance - transmittance > 1e-12;
  return {transmittance == 0.0 && !absorbs ? everything : reflectance, absorbs ? reflectance + transmittance : everything};
}

// Splits quanta; `u` is uniform over [0, 1).
[[nodiscard]] inline QuantaSplit split_quanta(std::int64_t quanta, const SplitCoefficients& of, double u) {
  const auto part = [&](double coefficient) {
    const double share = static_cast<double>(quanta) * coefficient + u;
    return share < 0x1p63 ? std::min(quanta, static_cast<std::int64_t>(share)) : quanta;
  };
  QuantaSplit split;
  split.reflected = part(of.reflected);
  split.transmitted = std::max<std::int64_t>(0, part(of.scattered) - split.reflected);
  split.absorbed = quanta - split.reflected - split.transmitted;
  return split;
}

// The SplitCoefficients of a face for the columns of `lights` lights. [column]
struct FaceColumns {
  FaceColumns(const std::vector<FaceOptics>& face, std::size_t lights);

  std::vector<double> reflected, scattered;
};

// Landed quanta, and where their parts go. [column]
struct SplitColumns {
  std::span<const std::int64_t> landed;
  std::span<const double> u;            // uniform over [0, 1)
  std::span<std::int64_t> absorbed;     // to which what is absorbed is added
  std::span<std::int64_t> reflected;    // overwritten
  std::span<std::int64_t> transmitted;  // overwritten
};

// The flux that drawn packets share out, column by column: the k-th packet gets its weight's part of the total. Cumulative shares are
// rounded down, so that their differences add up to it. [column]
struct SharedOut {
  SharedOut() = default;
  explicit SharedOut(std::vector<std::int64_t> of)
      : totals(std::move(of)), weights(totals.size()), sums(totals.size()), given(totals.size()), last(totals.size()) {}

  std::vector<std::int64_t> totals;
  std::vector<double> weights;      // of all packets
  std::vector<double> sums;         // of the weights of the packets so far
  std::vector<std::int64_t> given;  // to the packets so far
  std::vector<std::int64_t> last;   // number of the last packet with any quanta
};

namespace columns {

// Rows of fewer columns are not worth vectors.
inline constexpr std::size_t least_in_vectors = 6;

namespace in_vectors {

void split(const FaceColumns& face, const SplitColumns& row);
void weigh(std::span<const std::int64_t> quanta, double expected, std::int64_t packet, SharedOut& shared);
void share(std::span<const std::int64_t> quanta, double expected, std::int64_t packet, SharedOut& shared,
           std::span<std::int64_t> own);
void add(std::span<const std::int64_t> quanta, std::int64_t* sums);
void subtract(std::span<const std::int64_t> quanta, std::int64_t* sums);
void divide(std::span<const std::int64_t> quanta, std::span<const double> by, std::span<double> ratios);
void scale(std::span<const std::int64_t> quanta, std::span<const double> a, double b, std::span<const double> c,
           std::span<double> products);
void add_products(std::span<const double> a, std::span<const double> b, std::span<double> sums);
void add_scaled(double factor, std::span<const double> a, std::span<double> sums);

}  // namespace in_vectors

// The columns of a row from `first` on, one by one.
namespace singly {

inline void split(std::size_t first, const FaceColumns& face, const SplitColumns& row) {
  for (std::size_t c = first; c < row.landed.size(); ++c) {
    const QuantaSplit parts = split_quanta(row.landed[c], {face.reflected[c], face.scattered[c]}, row.u[c]);
    row.absorbed[c] += parts.absorbed;
    row.reflected[c] = parts.reflected;
    row.transmitted[c] = parts.transmitted;
  }
}

inline void weigh(std::size_t first, std::span<const std::int64_t> quanta, double expected, std::int64_t packet,
                  SharedOut& shared) {
  for (std::size_t c = first; c < quanta.size(); ++c) {
    shared.weights[c] += static_cast<double>(quanta[c]) / expected;
    if (quanta[c] > 0) shared.last[c] = packet;
  }
}

inline void share(std::size_t first, std::span<const std::int64_t> quanta, double expected, std::int64_t packet,
                  SharedOut& shared, std::span<std::int64_t> own) {
  for (std::size_t c = first; c < quanta.size(); ++c) {
    own[c] = 0;
    if (quanta[c] == 0) continue;
    shared.sums[c] += static_cast<double>(quanta[c]) / expected;
    const std::int64_t total = shared.totals[c];
    const auto share = static_cast<std::int64_t>(shared.sums[c] / shared.weights[c] * static_cast<double>(total));
    const std::int64_t up_to = packet == shared.last[c] ? total : std::clamp(share, shared.given[c], total);
    own[c] = up_to - shared.given[c];
    shared.given[c] = up_to;
  }
}

inline void add(std::size_t first, std::span<const std::int64_t> quanta, std::int64_t* sums) {
  for (std::size_t c = first; c < quanta.size(); ++c) sums[c] += quanta[c];
}

inline void subtract(std::size_t first, std::span<const std::int64_t> quanta, std::int64_t* sums) {
  for (std::size_t c = first; c < quanta.size(); ++c) sums[c] -= quanta[c];
}

inline void divide(std::size_t first, std::span<const std::int64_t> quanta, std::span<const double> by,
                   std::span<double> ratios) {
  for (std::size_t c = first; c < quanta.size(); ++c) ratios[c] = static_cast<double>(quanta[c]) / by[c];
}

inline void scale(std::size_t first, std::span<const std::int64_t> quanta, std::span<const double> a, double b,
                  std::span<const double> c, std::span<double> products) {
  for (std::size_t k = first; k < quanta.size(); ++k) products[k] = static_cast<double>(quanta[k]) * a[k] * b * c[k];
}

inline void add_products(std::size_t first, std::span<const double> a, std::span<const double> b, std::span<double> sums) {
  for (std::size_t c = first; c < a.size(); ++c) sums[c] += a[c] * b[c];
}

inline void add_scaled(std::size_t first, double factor, std::span<const double> a, std::span<double> sums) {
  for (std::size_t c = first; c < a.size(); ++c) sums[c] += factor * a[c];
}

}  // namespace singly

// Splits what landed on a face.
inline void split(const FaceColumns& face, const SplitColumns& row) {
  if (row.landed.size() >= least_in_vectors) return in_vectors::split(face, row);
  singly::split(0, face, row);
}

// Adds the weights, quanta / expected, of a packet, and notes it where it has any quanta.
inline void weigh(std::span<const std::int64_t> quanta, double expected, std::int64_t packet, SharedOut& shared) {
  if (quanta.size() >= least_in_vectors) return in_vectors::weigh(quanta, expected, packet, shared);
  singly::weigh(0, quanta, expected, packet, shared);
}

// Sets `own` to what the packet gets, once all were weighed.
inline void share(std::span<const std::int64_t> quanta, double expected, std::int64_t packet, SharedOut& shared,
                  std::span<std::int64_t> own) {
  if (quanta.size() >= least_in_vectors) return in_vectors::share(quanta, expected, packet, shared, own);
  singly::share(0, quanta, expected, packet, shared, own);
}

// Adds quanta to as many sums.
inline void add(std::span<const std::int64_t> quanta, std::int64_t* sums) {
  if (quanta.size() >= least_in_vectors) return in_vectors::add(quanta, sums);
  singly::add(0, quanta, sums);
}

// Subtracts quanta from as many sums.
inline void subtract(std::span<const std::int64_t> quanta, std::int64_t* sums) {
  if (quanta.size() >= least_in_vectors) return in_vectors::subtract(quanta, sums);
  singly::subtract(0, quanta, sums);
}

// Sets the sums of quanta / by of each row, added in the order of the columns.
void sum_ratios(std::span<const std::span<const std::int64_t>> rows, std::span<const double> by, std::span<double> sums);

// Sets the products of quanta * a * b * c, multiplied in this order.
inline void scale(std::span<const std::int64_t> quanta, std::span<const double> a, double b, std::span<const double> c,
                  std::span<double> products) {
  if (quanta.size() >= least_in_vectors) return in_vectors::scale(quanta, a, b, c, products);
  singly::scale(0, quanta, a, b, c, products);
}

// Adds a * b to the sums.
inline void add_products(std::span<const double> a, std::span<const double> b, std::span<double> sums) {
  if (a.size() >= least_in_vectors) return in_vectors::add_products(a, b, sums);
  singly::add_products(0, a, b, sums);
}

// Adds factor * a to the sums.
inline void add_scaled(double factor, std::span<const double> a, std::span<double> sums) {
  if (a.size() >= least_in_vectors) return in_vectors::add_scaled(factor, a, sums);
  singly::add_scaled(0, factor, a, sums);
}

}  // namespace columns
}  // namespace sunfleck
