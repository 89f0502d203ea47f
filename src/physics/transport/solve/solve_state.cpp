#include "physics/transport/solve/solve_state.h"

#include "physics/light/beam_grid.h"
#include "physics/transport/model/surfaces.h"
#include "physics/transport/receivers/planes.h"
#include "physics/transport/solve/run_sums.h"

#include <optional>
#include <type_traits>

namespace sunfleck {
namespace {

// Appends the numbers of the sums that it visits.
class Writer {
 public:
  explicit Writer(PlainSums& sums) : sums_(sums) {}

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
  PlainSums& sums_;
};

// Reads the numbers back in the same order; missing numbers are read as 0.
class Reader {
 public:
  explicit Reader(const PlainSums& sums) : sums_(sums) {}

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
  const PlainSums& sums_;
  std::size_t integer_ = 0, real_ = 0;
};

}  // namespace

PlainSums plain_sums(const RunSums& sums) {
  PlainSums plain;
  Writer writer(plain);
  RunSums::visit(sums, writer);
  return plain;
}

bool restore(RunSums& sums, const PlainSums& plain) {
  Reader reader(plain);
  RunSums::visit(sums, reader);
  return reader.fits();
}

std::size_t SolveState::replicates() const {
  return sums.integers.empty() ? 0 : static_cast<std::size_t>(sums.integers.front());
}

SolveState blank_state(const RadiationModel& model, const CounterLayout& layout, ElementErrors element_errors) {
  const Surfaces surfaces(model);
  std::optional<PlaneReceivers> receivers;
  if (!model.planes.empty()) receivers.emplace(model, layout, surfaces);
  SolveState blank;
  blank.work = {model.has_beam() ? 1.0 : 0.0, 0.0};
  const Conversion conversion(model, layout, surfaces, receivers ? &*receivers : nullptr, {});
  blank.sums = plain_sums(RunSums(conversion, element_errors));
  return blank;
}

bool is_state_of(const SolveState& state, const SolveState& blank) {
  const auto is_in = [](auto value, auto least, auto most) { return value >= least && value <= most; };
  return state.sums.integers.size() == blank.sums.integers.size() && state.sums.reals.size() == blank.sums.reals.size() &&
         is_in(state.replicates(), std::size_t{2}, most_replicates) &&
         is_in(state.work.rays, blank.work.rays, static_cast<double>(max_grid_rays)) &&
         is_in(state.work.packets, 0.0, most_first_packets) && is_in(state.next_check, first_check, most_replicates) &&
         state.good_checks < 2;
}

}  // namespace sunfleck
