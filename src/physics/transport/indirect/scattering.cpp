#include "physics/transport/indirect/scattering.h"

namespace sunfleck {

Scattering::Scattering(const RadiationModel& model, std::size_t lights)
    : vegetation_(model.bands.size() * lights), structure_(vegetation_.size()), soil_(vegetation_.size()) {
  for (const SurfaceOptics& optics : model.optics) {
    faces_.emplace_back(optics.upper, lights);
    faces_.emplace_back(optics.lower, lights);
  }
  std::vector<FaceOptics> face(model.bands.size());
  for (std::size_t b = 0; model.soil && b < face.size(); ++b) face[b].reflectance = model.soil->reflectance[b];
  faces_.emplace_back(face, lights);
  for (FaceOptics& band : face) band.reflectance = 1.0;
  faces_.emplace_back(face, lights);
}

std::vector<std::int64_t>& Scattering::absorbed(Role role) {
  return role == Role::soil ? soil_ : is_vegetation(role) ? vegetation_ : structure_;
}

void Scattering::add_to(std::vector<FluxLedger>& ledgers) const {
  for (std::size_t c = 0; c < ledgers.size(); ++c) {
    ledgers[c].absorbed_vegetation += vegetation_[c];
    ledgers[c].absorbed_structure += structure_[c];
    ledgers[c].absorbed_soil += soil_[c];
  }
}

}  // namespace sunfleck
