#include "physics/transport/indirect/scattering.h"

#include <algorithm>

namespace sunfleck {
namespace {

std::vector<FaceOptics> soil_face_of(const RadiationModel& model) {
  std::vector<FaceOptics> face(model.bands.size());
  for (std::size_t b = 0; model.soil && b < face.size(); ++b) face[b].reflectance = model.soil->reflectance[b];
  return face;
}

}  // namespace

Scattering::Scattering(const RadiationModel& model, std::size_t lights)
    : lights_(lights),
      soil_face_(soil_face_of(model)),
      of_soil_(soil_face_, lights),
      uniform_(model.bands.size() * lights),
      reflected_(uniform_.size()),
      transmitted_(uniform_.size()),
      vegetation_(uniform_.size()),
      structure_(uniform_.size()),
      soil_(uniform_.size()) {
  for (const SurfaceOptics& optics : model.optics) {
    of_side_.emplace_back(optics.upper, lights);
    of_side_.emplace_back(optics.lower, lights);
  }
}

void Scattering::on_element(std::size_t optics, std::size_t side, Role role, std::span<const std::int64_t> quanta,
                            RandomStream& random) {
  std::vector<std::int64_t>& absorbed = role == Role::soil ? soil_ : is_vegetation(role) ? vegetation_ : structure_;
  scatter(of_side_[2 * optics + side], quanta, random, absorbed);
}

void Scattering::on_soil(std::span<const std::int64_t> quanta, RandomStream& random) {
  scatter(of_soil_, quanta, random, soil_);
}

void Scattering::scatter(const FaceColumns& face, std::span<const std::int64_t> quanta, RandomStream& random,
                         std::vector<std::int64_t>& absorbed) {
  for (std::size_t first = 0; first < quanta.size(); first += lights_) {
    const auto of_band = quanta.subspan(first, lights_);
    if (std::all_of(of_band.begin(), of_band.end(), [](std::int64_t own) { return own == 0; })) continue;
    std::fill_n(uniform_.begin() + static_cast<std::ptrdiff_t>(first), lights_, random.unit());
  }
  columns::split(face, {quanta, uniform_, absorbed, reflected_, transmitted_});
}

void Scattering::add_to(std::vector<FluxLedger>& ledgers) const {
  for (std::size_t c = 0; c < ledgers.size(); ++c) {
    ledgers[c].absorbed_vegetation += vegetation_[c];
    ledgers[c].absorbed_structure += structure_[c];
    ledgers[c].absorbed_soil += soil_[c];
  }
}

}  // namespace sunfleck
