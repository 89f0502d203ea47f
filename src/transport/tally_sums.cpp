// Conversion of a tally's sums to plain numbers and back.

#include "transport/tally.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace sunfleck {
namespace {

// Appends the numbers of the sums that it visits.
class Writer {
 public:
  explicit Writer(TallySums& sums) : sums_(sums) {}

  template <class T>
  requires std::is_integral_v<T>
  void visit(const T& value) { sums_.integers.push_back(static_cast<std::int64_t>(value)); }
  void visit(double value) { sums_.reals.push_back(value); }
  void visit(const ReplicateMean& mean) {
    visit(mean.count());
    visit(mean.mean());
    visit(mean.squares());
  }
  template <class T>
  void visit(const std::vector<T>& values) {
    for (const T& value : values) visit(value);
  }
  template <class T>
  void visit_late(const std::vector<T>& values, std::size_t size) {
    visit(values);
    if (values.empty()) sums_.integers.resize(sums_.integers.size() + size);
  }

 private:
  TallySums& sums_;
};

// Reads the numbers back in the same order; missing numbers are read as 0.
class Reader {
 public:
  explicit Reader(const TallySums& sums) : sums_(sums) {}

  // Returns true if exactly the available numbers were read.
  [[nodiscard]] bool fits() const { return integer_ == sums_.integers.size() && real_ == sums_.reals.size(); }

  template <class T>
  requires std::is_integral_v<T>
  void visit(T& value) {
    value = integer_ < sums_.integers.size() ? static_cast<T>(sums_.integers[integer_]) : T{};
    ++integer_;
  }
  void visit(double& value) {
    value = real_ < sums_.reals.size() ? sums_.reals[real_] : 0.0;
    ++real_;
  }
  void visit(ReplicateMean& mean) {
    std::size_t count = 0;
    double value = 0.0;
    double squares = 0.0;
    visit(count);
    visit(value);
    visit(squares);
    mean = ReplicateMean(count, value, squares);
  }
  template <class T>
  void visit(std::vector<T>& values) {
    for (T& value : values) visit(value);
  }
  template <class T>
  void visit_late(std::vector<T>& values, std::size_t size) {
    values.resize(size);
    visit(values);
  }

 private:
  const TallySums& sums_;
  std::size_t integer_ = 0, real_ = 0;
};

}  // namespace

template <class Self, class Archive>
void Tally::visit_sums(Self& self, Archive& archive) {
  const std::size_t bands = self.bands_.size();
  const bool packets = scatters(self.model_) || self.model_.has_sky();
  const auto visit_all = [&](auto&... sums) { (archive.visit(sums), ...); };
  visit_all(self.replicates_, self.lost_, self.sky_rays_, self.packets_, self.rounds_, self.landed_, self.first_vegetation_,
            self.first_ground_, self.met_, self.ground_ratio_, self.sunlit_);
  for (auto& ledger : self.ledgers_) {
    visit_all(ledger.incident, ledger.absorbed_vegetation, ledger.absorbed_soil, ledger.reflected, ledger.transmitted,
              ledger.unshot);
  }
  for (auto& band : self.bands_) {
    visit_all(band.vegetation, band.soil, band.reflected, band.transmitted, band.indirect_vegetation, band.indirect_soil);
  }
  for (auto& organ : self.organs_) {
    visit_all(organ.landed, organ.sunlit, organ.direct, organ.indirect, organ.absorbed, organ.indirect_absorbed);
  }
  for (auto& layer : self.layers_) visit_all(layer.ratio, layer.sunlit, layer.down, layer.up, layer.absorbed);
  for (auto& element : self.elements_) visit_all(element.upper, element.lower);
  const std::size_t sides = packets ? 2 * self.elements_.size() * bands : 0;
  const std::size_t cells = packets ? self.soil_cells_.size() * bands : 0;
  archive.visit_late(self.side_landed_, sides);
  archive.visit_late(self.cell_landed_, cells);
  archive.visit_late(self.side_sky_, self.model_.has_sky() ? sides : 0);
  archive.visit_late(self.cell_sky_, self.model_.has_sky() ? cells : 0);
  visit_all(self.soil_cells_, self.element_hits_);
  for (auto* spreads : {&self.direct_spread_, &self.absorbed_spread_, &self.indirect_spread_, &self.side_spread_}) {
    for (auto& spread : *spreads) visit_all(spread.sum, spread.squares);
  }
  if (self.planes_) PlaneTally::visit_sums(*self.planes_, archive);
}

TallySums Tally::sums() const {
  TallySums sums;
  Writer writer(sums);
  visit_sums(*this, writer);
  return sums;
}

bool Tally::restore(const TallySums& sums) {
  Reader reader(sums);
  visit_sums(*this, reader);
  return reader.fits();
}

}  // namespace sunfleck
