#pragma once
// The flux of packets through a stack of horizontal planes: those of the layers, or the receivers.

#include "physics/transport/model/columns.h"

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace sunfleck {

// The planes cut space into places, numbered from the bottom: place 0 lies below the lowest plane, place k above k planes.
class PlaneFlux {
 public:
  PlaneFlux(std::size_t planes, std::size_t bands) : bands_(bands), down_((planes + 1) * bands), up_(down_), moved_(down_) {}

  // Adds the quanta, [band], that a straight path carries from one place to another.
  void pass(std::size_t from, std::size_t to, std::span<const std::int64_t> quanta);

  // Adds quanta of a band that are shot from a place although they waited elsewhere; negative where they waited.
  void move(std::size_t place, std::size_t band, std::int64_t quanta) { moved_[place * bands_ + band] += quanta; }
  // Add the quanta of all bands that are shot from a place, and take off those that waited there.
  void move(std::size_t place, std::span<const std::int64_t> quanta) { columns::add(quanta, &moved_[place * bands_]); }
  void leave(std::size_t place, std::span<const std::int64_t> quanta) { columns::subtract(quanta, &moved_[place * bands_]); }

  // Completes the flux through the planes. Sampling moves flux between places: flux that waits at one is shot from another,
  // with a mean of zero. To keep the books of the planes in between exact to the quantum, half of the net flux moved through
  // a plane is added to its downward flux and half is subtracted from its upward flux. At the ground all of it is subtracted
  // from the upward flux, because the downward flux there is what lands on the soil.
  void close(const std::function<bool(std::size_t plane)>& at_ground);

  // The flux through the planes once they are closed. [plane * bands + band]
  [[nodiscard]] const std::vector<std::int64_t>& down() const { return down_; }
  [[nodiscard]] const std::vector<std::int64_t>& up() const { return up_; }

 private:
  std::size_t bands_;
  std::vector<std::int64_t> down_, up_;  // [place * bands + band]; before close() the differences to the plane below
  std::vector<std::int64_t> moved_;      // [place * bands + band]
};

}  // namespace sunfleck
