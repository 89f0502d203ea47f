#include "physics/transport/indirect/replicate.h"

namespace sunfleck {

IndirectSums::IndirectSums(const RadiationModel& model, const CounterLayout& layout, const Surfaces& surfaces)
    : bands(model.bands.size()),
      surface_landed(surfaces.of.size() * 2 * bands),
      layer_landed(static_cast<std::size_t>(layout.layers.count) * model.optics.size() * 2 * bands),
      side_landed(model.canopy.size() * 2, bands),
      element_hits(model.canopy.size()),
      cell_landed(std::size_t{layout.cells()} * bands),
      down((static_cast<std::size_t>(layout.layers.count) + 1) * bands),
      up(down.size()),
      ledger(bands) {}

}  // namespace sunfleck
