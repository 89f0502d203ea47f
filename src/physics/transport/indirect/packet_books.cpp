#include "physics/transport/indirect/packet_books.h"

#include "base/prefetch.h"

#include <oneapi/tbb/parallel_invoke.h>

#include <algorithm>

namespace sunfleck {

PacketBooks::PacketBooks(const IndirectScene& scene, bool counts_hits)
    : scene_(scene),
      columns_(scene.lights.size() * scene.model.bands.size()),
      booked_{0, columns_},
      sums_(scene.model, scene.layout, scene.surfaces, scene.lights.size()),
      scattering_(scene.model, scene.lights.size()),
      layers_(static_cast<std::size_t>(scene.layout.layers.count) + 1, columns_),
      receivers_(scene.receivers != nullptr ? scene.receivers->size() : 0, columns_),
      scattered_(columns_) {
  if (counts_hits) sums_.element_hits.resize(scene.model.canopy.size());
  if (scene.receivers != nullptr) sums_.receivers = PlaneSums(*scene.receivers, scene.model, columns_);
}

void PacketBooks::book(const ArrivalBatch& batch, WaitingFlux& next) {
  constexpr std::size_t least_shared = 1024;
  const auto sides = [&] { book_sides(batch); };
  const auto places = [&] { scatter(batch, next); };
  const auto surfaces = [&] { book_surfaces(batch); };
  const auto planes = [&] {
    book_layers(batch);
    book_receivers(batch);
  };
  if (batch.size() >= least_shared) return tbb::parallel_invoke(sides, places, surfaces, planes);
  sides();
  places();
  surfaces();
  planes();
}

void PacketBooks::book_sides(const ArrivalBatch& batch) {
  const bool counts_hits = !sums_.element_hits.empty();
  for (std::size_t k = 0; k < batch.size(); ++k) {
    if (k + prefetch_ahead < batch.size()) {
      const std::uint32_t surface = batch.arrivals[k + prefetch_ahead].place.surface;
      if (surface < shared::landed_on_ground) {
        sums_.side_landed.prefetch(surface);
        if (counts_hits) prefetch(sums_.element_hits[surface / 2]);
      }
    }
    const EmissionPoint& place = batch.arrivals[k].place;
    if (place.surface < shared::landed_on_ground) {
      if (counts_hits) ++sums_.element_hits[place.surface / 2];
      sums_.side_landed.add(place.surface, quanta_of(batch, k), booked_.first);
    } else if (place.surface == shared::landed_on_ground) {
      sums_.cell_landed.add(place.order - ground_order, quanta_of(batch, k), booked_.first);
    }
  }
}

void PacketBooks::book_surfaces(const ArrivalBatch& batch) {
  for (std::size_t k = 0; k < batch.size(); ++k) {
    const Arrival& arrival = batch.arrivals[k];
    const EmissionPoint& place = arrival.place;
    if (place.surface > shared::landed_on_ground) end(arrival, quanta_of(batch, k));
    if (place.surface >= shared::landed_on_ground) continue;
    const Surface& surface = scene_.surfaces.of[arrival.surface];
    const std::uint32_t side = place.surface % 2;
    add_to(sums_.surface_landed, arrival.surface * 2 + side, quanta_of(batch, k));
    if (surface.soil()) continue;
    const std::size_t layer = static_cast<std::size_t>(place.level);
    add_to(sums_.layer_landed, (layer * scene_.model.optics.size() + surface.optics) * 2 + side, quanta_of(batch, k));
  }
}

// Books what leaves the canopy or is given up.
void PacketBooks::end(const Arrival& arrival, std::span<const std::int64_t> quanta) {
  if (arrival.beside_plot) return;
  for (std::size_t c = 0; c < quanta.size(); ++c) {
    FluxLedger& ledger = sums_.ledger[booked_.first + c];
    if (arrival.place.surface == shared::left_upwards) ledger.reflected += quanta[c];
    if (arrival.place.surface == shared::left_downwards) ledger.transmitted += quanta[c];
    if (arrival.place.surface == shared::lost_on_its_way) ledger.unshot += quanta[c];
  }
  if (arrival.place.surface == shared::lost_on_its_way) ++sums_.lost;
}

// Books what packets take along from their levels, and what passes the planes of the layers.
void PacketBooks::book_layers(const ArrivalBatch& batch) {
  for (std::size_t k = 0; k < batch.size(); ++k) {
    const Arrival& arrival = batch.arrivals[k];
    const std::span<const std::int64_t> quanta = quanta_of(batch, k);
    if (arrival.waited_level != Arrival::from_above) {
      columns::add(quanta, layers_.taken_from(level_index(arrival.waited_level)) + booked_.first);
    }
    if (arrival.beside_plot || arrival.place.surface == shared::lost_on_its_way) continue;
    layers_.pass(level_index(arrival.from_level), level_index(arrival.place.level), quanta, booked_.first);
  }
}

// Does the same at the receivers.
void PacketBooks::book_receivers(const ArrivalBatch& batch) {
  for (std::size_t k = 0; scene_.receivers != nullptr && k < batch.size(); ++k) {
    const Arrival& arrival = batch.arrivals[k];
    const std::span<const std::int64_t> quanta = quanta_of(batch, k);
    if (arrival.waited_level != Arrival::from_above) {
      columns::add(quanta, receivers_.taken_from(arrival.waited_zone) + booked_.first);
    }
    if (arrival.place.surface == shared::lost_on_its_way) continue;
    receivers_.pass(arrival.from_zone, arrival.to_zone, quanta, booked_.first);
    for (std::size_t p = arrival.to_zone; p < arrival.from_zone; ++p) {
      const std::uint32_t cell = scene_.receivers->cell_at(p, batch.packets[k].origin, batch.packets[k].direction);
      if (cell != shared::no_cell) add_to(sums_.receivers.down, cell, quanta);
    }
  }
}

// Splits what landed, and lets wait what is scattered.
void PacketBooks::scatter(const ArrivalBatch& batch, WaitingFlux& next) {
  const std::span<std::int64_t> scattered = std::span(scattered_).first(booked_.count);
  for (std::size_t k = 0; k < batch.size(); ++k) {
    const Arrival& arrival = batch.arrivals[k];
    const EmissionPoint& place = arrival.place;
    if (place.surface > shared::landed_on_ground) continue;
    const Role role = place.surface == shared::landed_on_ground ? Role::soil : scene_.surfaces.of[arrival.surface].role;
    columns::split(quanta_of(batch, k), scattering_.face(place.face).scattered.data() + booked_.first, place.u,
                   scattering_.absorbed(role).data() + booked_.first, scattered.data());
    if (std::all_of(scattered.begin(), scattered.end(), [](std::int64_t q) { return q == 0; })) continue;
    columns::add(scattered, layers_.waiting(level_index(place.level)) + booked_.first);
    if (scene_.receivers != nullptr) columns::add(scattered, receivers_.waiting(arrival.to_zone) + booked_.first);
    next.add(place, quanta_of(batch, k));
  }
}

// Adds a place's quanta to its sums, [place * columns + column].
void PacketBooks::add_to(std::vector<std::int64_t>& sums, std::size_t place, std::span<const std::int64_t> quanta) const {
  columns::add(quanta, &sums[place * columns_ + booked_.first]);
}

std::vector<std::uint64_t> PacketBooks::for_rounds(const shared::PassBlock& block) const {
  std::vector<std::uint64_t> totals(shared::all_words(block));
  const auto put = [&](std::uint32_t row, const std::vector<std::int64_t>& values) {
    std::copy(values.begin(), values.end(), totals.begin() + static_cast<std::ptrdiff_t>(row * columns_));
  };
  put(shared::sum_vegetation, scattering_.vegetation());
  put(shared::sum_soil, scattering_.soil());
  put(shared::place_row(shared::stack_of_layers(block), shared::place_waiting, 0), layers_.waiting_everywhere());
  if (scene_.receivers == nullptr) return totals;
  put(shared::place_row(shared::stack_of_receivers(block), shared::place_waiting, 0), receivers_.waiting_everywhere());
  return totals;
}

void PacketBooks::add_rounds(const shared::PassBlock& block, const RoundsSums& found) {
  const auto row = [&](std::uint32_t number) { return std::span(found.totals).subspan(number * columns_, columns_); };
  const auto add_planes = [&](PlaneFlux& planes, const shared::PlaneStack& stack) {
    planes.add_rounds(found.at_places(block, stack, shared::place_waiting), found.at_places(block, stack, shared::place_down),
                      found.at_places(block, stack, shared::place_up), found.moved(block, stack));
  };
  add_planes(layers_, shared::stack_of_layers(block));
  if (scene_.receivers != nullptr) {
    add_planes(receivers_, shared::stack_of_receivers(block));
    columns::add(found.plane_cells, sums_.receivers.down.data());
  }
  for (std::size_t c = 0; c < columns_; ++c) {
    scattering_.absorbed(Role::leaf)[c] = static_cast<std::int64_t>(row(shared::sum_vegetation)[c]);
    scattering_.absorbed(Role::structure)[c] += static_cast<std::int64_t>(row(shared::sum_structure)[c]);
    scattering_.absorbed(Role::soil)[c] = static_cast<std::int64_t>(row(shared::sum_soil)[c]);
    FluxLedger& ledger = sums_.ledger[c];
    ledger.reflected += static_cast<std::int64_t>(row(shared::sum_reflected)[c]);
    ledger.transmitted += static_cast<std::int64_t>(row(shared::sum_transmitted)[c]);
    ledger.unshot += static_cast<std::int64_t>(row(shared::sum_lost)[c] + found.columns[c].unshot);
  }
  sums_.side_landed.add_all(found.side_landed);
  sums_.cell_landed.add_all(found.cell_landed);
  columns::add(found.surface_landed, sums_.surface_landed.data());
  const std::size_t first_layer = shared::layer_row(block, 0, 0, 0) * columns_;
  for (std::size_t k = 0; k < sums_.layer_landed.size(); ++k) {
    sums_.layer_landed[k] += static_cast<std::int64_t>(found.totals[first_layer + k]);
  }
  for (std::size_t e = 0; e < sums_.element_hits.size(); ++e) sums_.element_hits[e] += found.element_hits[e];
  sums_.lost += found.totals[shared::small_rows(block) * columns_ + 1];
  sums_.packets += found.packets;
  sums_.rounds += found.rounds;
  sums_.first_places = found.first_places;
  sums_.most_places = std::max(sums_.most_places, found.most_places);
}

void PacketBooks::retire(std::size_t column) {
  sums_.ledger[column].unshot += layers_.drop_waiting(column);
  if (scene_.receivers != nullptr) receivers_.drop_waiting(column);
}

void PacketBooks::begin_round() {
  waited_ = layers_.count_waiting();
  if (scene_.receivers != nullptr) receivers_.count_waiting();
}

void PacketBooks::end_round() {
  const std::vector<std::int64_t> taken_along = layers_.count_taken();
  if (scene_.receivers != nullptr) receivers_.count_taken();
  for (std::size_t c = 0; c < columns_; ++c) {
    layers_.keep(c, waited_[c] - taken_along[c]);
    if (scene_.receivers != nullptr) receivers_.keep(c, waited_[c] - taken_along[c]);
  }
}

void PacketBooks::close() {
  for (std::size_t c = 0; c < columns_; ++c) retire(c);
  scattering_.add_to(sums_.ledger);
  sums_.side_landed.put_in_order();
  sums_.cell_landed.put_in_order();
  layers_.close([](std::size_t plane) { return plane == 0; });
  sums_.down = layers_.down();
  sums_.up = layers_.up();
  if (scene_.receivers == nullptr) return;
  receivers_.close([this](std::size_t plane) { return scene_.receivers->at_ground(plane); });
  sums_.receivers.through_down = receivers_.down();
  sums_.receivers.through_up = receivers_.up();
}

}  // namespace sunfleck
