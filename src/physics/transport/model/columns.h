#pragma once
// Arithmetic over the columns of a place or packet, such as two hundred wavebands: in vectors by Google Highway where there are
// many, one by one where there are few. Both give the same bits on every kind of processor.

#include "physics/canopy/optics.h"
#include "shared/quanta.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace sunfleck {

// Landed quanta are split into parts that add up to them exactly. Each part is its exact share rounded down or up at random, so
// that its expectation is right to 2^-33 of what landed; a part whose coefficient is 0 gets exactly 0.
struct QuantaSplit {
  std::int64_t absorbed = 0, reflected = 0, transmitted = 0;
  [[nodiscard]] std::int64_t scattered() const { return reflected + transmitted; }
};

// Coefficients of what a face reflects, and of what it reflects or transmits, as parts of 2^32 (shaders/shared/quanta.h).
struct SplitCoefficients {
  std::uint64_t reflected = 0, scattered = 0;
};
[[nodiscard]] inline SplitCoefficients split_coefficients(double reflectance, double transmittance) {
  const auto coefficient = [](double part) {
    return static_cast<std::uint64_t>(std::llround(std::clamp(part, 0.0, 1.0) * 0x1p32));
  };
  return {coefficient(reflectance), coefficient(reflectance + transmittance)};
}

// Returns shared::part_of; `u` has 32 random bits.
[[nodiscard]] inline std::int64_t part_of(std::int64_t quanta, std::uint64_t coefficient, std::uint32_t u) {
  return static_cast<std::int64_t>(shared::part_of(static_cast<std::uint64_t>(quanta), coefficient, u));
}

// Splits quanta; `u` is that of part_of.
[[nodiscard]] inline QuantaSplit split_quanta(std::int64_t quanta, const SplitCoefficients& of, std::uint32_t u) {
  const std::int64_t scattered = part_of(quanta, of.scattered, u);
  QuantaSplit split;
  split.reflected = part_of(quanta, of.reflected, u);
  split.transmitted = scattered - split.reflected;
  split.absorbed = quanta - scattered;
  return split;
}

// The SplitCoefficients of a face for the columns of `lights` lights. [column]
struct FaceColumns {
  FaceColumns(const std::vector<FaceOptics>& face, std::size_t lights);

  std::vector<std::uint64_t> reflected, scattered;
  bool transmits = false;  // in any column
};

// What one side of a place sends out of what landed there: the parts between two coefficients, or below one. [column]
struct SentPart {
  const std::uint64_t* from = nullptr;  // null: from 0
  const std::uint64_t* to = nullptr;
  std::uint32_t u = 0;  // as in part_of
};

// What both sides of a place send: the parts below one coefficient are reflected, those from there to another transmitted.
// [column]
struct ScatteredParts {
  const std::uint64_t* reflected = nullptr;
  const std::uint64_t* scattered = nullptr;  // null where nothing is transmitted
  std::uint32_t u = 0;                       // as in part_of
};

// A number for each of the two.
struct OfBothParts {
  std::uint64_t reflected = 0, transmitted = 0;
};

// A factor for each column, value / 2^shift: a shared::Scale or a shared::Load.
struct FactorColumns {
  explicit FactorColumns(std::size_t columns) : value(columns), shift(columns) {}
  void set(std::size_t column, std::uint64_t of_value, std::uint32_t of_shift) {
    value[column] = of_value;
    shift[column] = of_shift;
  }
  void set(std::size_t column, const shared::Scale& scale) { set(column, scale.mantissa, scale.shift); }
  void set(std::size_t column, const shared::Load& load) { set(column, load.factor, load.shift); }

  std::vector<std::uint64_t> value, shift;
};

// Neighbouring columns; all others have nothing left to send.
struct ColumnRange {
  std::size_t first = 0, count = 0;
};

namespace columns {

// Rows of fewer columns are not worth vectors.
inline constexpr std::size_t least_in_vectors = 6;

// Functions of the same names as those below, in vectors.
struct InVectors {
  OfBothParts (*sum_scaled)(std::span<const std::int64_t> landed, const ScatteredParts& parts, const FactorColumns& by,
                            std::size_t first);
  OfBothParts (*largest_scaled)(std::span<const std::int64_t> landed, const ScatteredParts& parts, const FactorColumns& by,
                                std::size_t first);
  void (*weigh)(std::span<const std::int64_t> landed, const SentPart& sent, const FactorColumns& by, std::size_t first,
                const shared::Sharing& sharing, std::uint32_t* weights, std::uint64_t* sums);
  void (*carry)(std::span<const std::uint32_t> weights, const FactorColumns& loads, std::size_t first, std::int64_t* quanta);
  void (*split)(std::span<const std::int64_t> landed, const std::uint64_t* coefficients, std::uint32_t u,
                std::int64_t* absorbed, std::int64_t* scattered);
  void (*add)(std::span<const std::int64_t> quanta, std::int64_t* sums);
  void (*subtract)(std::span<const std::int64_t> quanta, std::int64_t* sums);
  void (*scale)(std::span<const std::int64_t> quanta, std::span<const double> a, double b, std::span<const double> c,
                std::span<double> products);
  void (*add_share)(double share, std::span<const double> a, std::span<const double* const> by, std::span<double* const> sums);
  void (*add_scaled)(double factor, std::span<const double> a, std::span<double> sums);
};
// Returns those in the widest vectors of this processor.
[[nodiscard]] const InVectors& in_vectors();

// The columns of a row from the k-th on, one by one. `first` is the number of the row's first column among all columns.
namespace singly {

inline std::uint64_t scaled(std::int64_t quanta, const FactorColumns& by, std::size_t column) {
  return shared::scaled(static_cast<std::uint64_t>(quanta),
                        {static_cast<std::uint32_t>(by.value[column]), static_cast<std::uint32_t>(by.shift[column])});
}

// Calls take(reflected, transmitted) for the scaled parts of each column.
template <class Take>
void for_both_parts(std::size_t k, std::span<const std::int64_t> landed, const ScatteredParts& parts, const FactorColumns& by,
                    std::size_t first, const Take& take) {
  for (; k < landed.size(); ++k) {
    const std::size_t c = first + k;
    const std::int64_t reflected = part_of(landed[k], parts.reflected[c], parts.u);
    const std::int64_t scattered = parts.scattered != nullptr ? part_of(landed[k], parts.scattered[c], parts.u) : reflected;
    take(scaled(reflected, by, c), scaled(scattered - reflected, by, c));
  }
}

inline OfBothParts sum_scaled(std::size_t k, std::span<const std::int64_t> landed, const ScatteredParts& parts,
                              const FactorColumns& by, std::size_t first) {
  OfBothParts sums;
  for_both_parts(k, landed, parts, by, first, [&](std::uint64_t reflected, std::uint64_t transmitted) {
    sums.reflected += reflected;
    sums.transmitted += transmitted;
  });
  return sums;
}

inline OfBothParts largest_of(const OfBothParts& a, const OfBothParts& b) {
  return {std::max(a.reflected, b.reflected), std::max(a.transmitted, b.transmitted)};
}

inline OfBothParts largest_scaled(std::size_t k, std::span<const std::int64_t> landed, const ScatteredParts& parts,
                                  const FactorColumns& by, std::size_t first) {
  OfBothParts largest;
  for_both_parts(k, landed, parts, by, first, [&](std::uint64_t reflected, std::uint64_t transmitted) {
    largest = largest_of(largest, {reflected, transmitted});
  });
  return largest;
}

inline void weigh(std::size_t k, std::span<const std::int64_t> landed, const SentPart& sent, const FactorColumns& by,
                  std::size_t first, const shared::Sharing& sharing, std::uint32_t* weights, std::uint64_t* sums) {
  for (; k < landed.size(); ++k) {
    const std::int64_t before = sent.from != nullptr ? part_of(landed[k], sent.from[first + k], sent.u) : 0;
    const std::int64_t quanta = part_of(landed[k], sent.to[first + k], sent.u) - before;
    weights[k] = shared::share_of(scaled(quanta, by, first + k), sharing);
    sums[first + k] += weights[k];
  }
}

inline void carry(std::size_t k, std::span<const std::uint32_t> weights, const FactorColumns& loads, std::size_t first,
                  std::int64_t* quanta) {
  for (; k < weights.size(); ++k) {
    const shared::Load load{loads.value[first + k], static_cast<std::uint32_t>(loads.shift[first + k])};
    quanta[k] = static_cast<std::int64_t>(shared::carried(weights[k], load));
  }
}

inline void split(std::size_t k, std::span<const std::int64_t> landed, const std::uint64_t* coefficients, std::uint32_t u,
                  std::int64_t* absorbed, std::int64_t* scattered) {
  for (; k < landed.size(); ++k) {
    scattered[k] = part_of(landed[k], coefficients[k], u);
    absorbed[k] += landed[k] - scattered[k];
  }
}

inline void add(std::size_t first, std::span<const std::int64_t> quanta, std::int64_t* sums) {
  for (std::size_t c = first; c < quanta.size(); ++c) sums[c] += quanta[c];
}

inline void subtract(std::size_t first, std::span<const std::int64_t> quanta, std::int64_t* sums) {
  for (std::size_t c = first; c < quanta.size(); ++c) sums[c] -= quanta[c];
}

inline void scale(std::size_t first, std::span<const std::int64_t> quanta, std::span<const double> a, double b,
                  std::span<const double> c, std::span<double> products) {
  for (std::size_t k = first; k < quanta.size(); ++k) products[k] = static_cast<double>(quanta[k]) * a[k] * b * c[k];
}

inline void add_share(std::size_t first, double share, std::span<const double> a, std::span<const double* const> by,
                      std::span<double* const> sums) {
  for (std::size_t c = first; c < a.size(); ++c) {
    const double part = share * a[c];
    sums[0][c] += part;
    for (std::size_t k = 0; k < by.size(); ++k) sums[k + 1][c] += by[k][c] * part;
  }
}

inline void add_scaled(std::size_t first, double factor, std::span<const double> a, std::span<double> sums) {
  for (std::size_t c = first; c < a.size(); ++c) sums[c] += factor * a[c];
}

}  // namespace singly

// Returns the sums of both parts of a row of quanta that landed, each column scaled. Here and below, the row's first column has
// the number `first` in all arrays that are not rows.
inline OfBothParts sum_scaled(std::span<const std::int64_t> landed, const ScatteredParts& parts, const FactorColumns& by,
                              std::size_t first) {
  if (landed.size() >= least_in_vectors) return in_vectors().sum_scaled(landed, parts, by, first);
  return singly::sum_scaled(0, landed, parts, by, first);
}

// Returns the largest of them.
inline OfBothParts largest_scaled(std::span<const std::int64_t> landed, const ScatteredParts& parts, const FactorColumns& by,
                                  std::size_t first) {
  if (landed.size() >= least_in_vectors) return in_vectors().largest_scaled(landed, parts, by, first);
  return singly::largest_scaled(0, landed, parts, by, first);
}

// Sets the row `weights` to the weight of each column in a packet, and adds it to `sums`.
inline void weigh(std::span<const std::int64_t> landed, const SentPart& sent, const FactorColumns& by, std::size_t first,
                  const shared::Sharing& sharing, std::uint32_t* weights, std::uint64_t* sums) {
  if (landed.size() >= least_in_vectors) return in_vectors().weigh(landed, sent, by, first, sharing, weights, sums);
  singly::weigh(0, landed, sent, by, first, sharing, weights, sums);
}

// Sets the row `quanta` to what a packet of these weights carries.
inline void carry(std::span<const std::uint32_t> weights, const FactorColumns& loads, std::size_t first, std::int64_t* quanta) {
  if (weights.size() >= least_in_vectors) return in_vectors().carry(weights, loads, first, quanta);
  singly::carry(0, weights, loads, first, quanta);
}

// Splits a row with its coefficients: adds to a row of what is absorbed, and sets a row to what is scattered.
inline void split(std::span<const std::int64_t> landed, const std::uint64_t* coefficients, std::uint32_t u,
                  std::int64_t* absorbed, std::int64_t* scattered) {
  if (landed.size() >= least_in_vectors) return in_vectors().split(landed, coefficients, u, absorbed, scattered);
  singly::split(0, landed, coefficients, u, absorbed, scattered);
}

// Adds quanta to as many sums.
inline void add(std::span<const std::int64_t> quanta, std::int64_t* sums) {
  if (quanta.size() >= least_in_vectors) return in_vectors().add(quanta, sums);
  singly::add(0, quanta, sums);
}

// Subtracts quanta from as many sums.
inline void subtract(std::span<const std::int64_t> quanta, std::int64_t* sums) {
  if (quanta.size() >= least_in_vectors) return in_vectors().subtract(quanta, sums);
  singly::subtract(0, quanta, sums);
}

// Sets the products of quanta * a * b * c, multiplied in this order.
inline void scale(std::span<const std::int64_t> quanta, std::span<const double> a, double b, std::span<const double> c,
                  std::span<double> products) {
  if (quanta.size() >= least_in_vectors) return in_vectors().scale(quanta, a, b, c, products);
  singly::scale(0, quanta, a, b, c, products);
}

// Adds share * a to the first row of sums, and its product with each row of `by` to the row of sums after it.
inline void add_share(double share, std::span<const double> a, std::span<const double* const> by,
                      std::span<double* const> sums) {
  if (a.size() >= least_in_vectors) return in_vectors().add_share(share, a, by, sums);
  singly::add_share(0, share, a, by, sums);
}

// Adds factor * a to the sums.
inline void add_scaled(double factor, std::span<const double> a, std::span<double> sums) {
  if (a.size() >= least_in_vectors) return in_vectors().add_scaled(factor, a, sums);
  singly::add_scaled(0, factor, a, sums);
}

}  // namespace columns
}  // namespace sunfleck
