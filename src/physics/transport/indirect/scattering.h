#pragma once
// The faces on which light lands, and the sums of what they absorb.

#include "physics/transport/indirect/emission.h"
#include "physics/transport/model/columns.h"
#include "physics/transport/model/model.h"
#include "physics/transport/model/result.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sunfleck {

// Returns the number of the face of an element.
[[nodiscard]] inline std::uint32_t face_of(std::size_t optics, std::size_t side) {
  return static_cast<std::uint32_t>(2 * optics + side);
}
// Returns that of the soil plane, which is black without soil.
[[nodiscard]] inline std::uint32_t soil_face(const RadiationModel& model) {
  return static_cast<std::uint32_t>(2 * model.optics.size());
}
// Returns that of lamps, whose places send all that waits there.
[[nodiscard]] inline std::uint32_t lamp_face(const RadiationModel& model) {
  return soil_face(model) + 1;
}

// The coefficients of all faces, and the sums of one pass.
class Scattering {
 public:
  Scattering(const RadiationModel& model, std::size_t lights);

  [[nodiscard]] const FaceColumns& face(std::uint32_t number) const { return faces_[number]; }
  [[nodiscard]] const std::vector<FaceColumns>& faces() const { return faces_; }

  // Returns what a place sends out from its two sides: the one on which the light landed reflects.
  [[nodiscard]] ScatteredParts scattered(const EmissionPoint& place) const {
    const FaceColumns& face = faces_[place.face];
    return {face.reflected.data(), face.transmits ? face.scattered.data() : nullptr, place.u};
  }
  // Returns what it sends out from a side, 0 or 1.
  [[nodiscard]] SentPart sent(const EmissionPoint& place, std::size_t side) const {
    const FaceColumns& face = faces_[place.face];
    if (place.surface % 2 == side) return {nullptr, face.reflected.data(), place.u};
    return {face.reflected.data(), face.scattered.data(), place.u};
  }

  // Returns the sums of what surfaces of a role have absorbed. [column]
  [[nodiscard]] std::vector<std::int64_t>& absorbed(Role role);
  [[nodiscard]] const std::vector<std::int64_t>& vegetation() const { return vegetation_; }
  [[nodiscard]] const std::vector<std::int64_t>& soil() const { return soil_; }
  // Adds all of them to the ledgers, [column].
  void add_to(std::vector<FluxLedger>& ledgers) const;

 private:
  std::vector<FaceColumns> faces_;                           // [2 * optics + side], then the soil plane and lamps
  std::vector<std::int64_t> vegetation_, structure_, soil_;  // [column], absorbed
};

}  // namespace sunfleck
