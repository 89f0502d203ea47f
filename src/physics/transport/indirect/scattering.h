#pragma once
// How packets are scattered: what they carry is split by the faces on which they land.

#include "base/random.h"
#include "physics/transport/model/columns.h"
#include "physics/transport/model/model.h"
#include "physics/transport/model/result.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace sunfleck {

// Splits the quanta of one landing after the other, [column], and sums up what surfaces absorb. The lights share one random number for
// each band.
class Scattering {
 public:
  Scattering(const RadiationModel& model, std::size_t lights);

  // Split what landed on a side of an element, and on the soil plane.
  void on_element(std::size_t optics, std::size_t side, Role role, std::span<const std::int64_t> quanta, RandomStream& random);
  void on_soil(std::span<const std::int64_t> quanta, RandomStream& random);

  // Return the parts of the last landing. [column]
  [[nodiscard]] const std::vector<std::int64_t>& reflected() const { return reflected_; }
  [[nodiscard]] const std::vector<std::int64_t>& transmitted() const { return transmitted_; }

  // Return what surfaces have absorbed. [column]
  [[nodiscard]] const std::vector<std::int64_t>& vegetation() const { return vegetation_; }
  [[nodiscard]] const std::vector<std::int64_t>& soil() const { return soil_; }
  // Adds it to the ledgers, [column].
  void add_to(std::vector<FluxLedger>& ledgers) const;

  // Returns the optics of the soil plane, black without soil. [band]
  [[nodiscard]] const std::vector<FaceOptics>& soil_face() const { return soil_face_; }

 private:
  void scatter(const FaceColumns& face, std::span<const std::int64_t> quanta, RandomStream& random,
               std::vector<std::int64_t>& absorbed);

  std::size_t lights_;
  std::vector<FaceOptics> soil_face_;
  FaceColumns of_soil_;
  std::vector<FaceColumns> of_side_;                         // [2 * optics + side]
  std::vector<double> uniform_;                              // [column], random numbers of the current landing
  std::vector<std::int64_t> reflected_, transmitted_;        // [column]
  std::vector<std::int64_t> vegetation_, structure_, soil_;  // [column], absorbed
};

}  // namespace sunfleck
