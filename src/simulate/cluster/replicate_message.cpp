#include "simulate/cluster/replicate_message.h"

#include "base/error.h"

#include <bit>
#include <cstring>
#include <type_traits>
#include <utility>

namespace sunfleck {
namespace {

static_assert(std::endian::native == std::endian::little);

class Writer {
 public:
  template <class T>
  void value(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    append(&value, sizeof value);
  }
  template <class T>
  void array(const std::vector<T>& values) {
    value(std::uint64_t{values.size()});
    append(values.data(), values.size() * sizeof(T));
  }
  void text(const std::string& text) { array(std::vector<char>(text.begin(), text.end())); }

  [[nodiscard]] std::vector<std::byte> bytes() && { return std::move(bytes_); }

 private:
  void append(const void* data, std::size_t size) {
    const auto* begin = static_cast<const std::byte*>(data);
    bytes_.insert(bytes_.end(), begin, begin + size);
  }

  std::vector<std::byte> bytes_;
};

class Reader {
 public:
  explicit Reader(std::span<const std::byte> bytes) : bytes_(bytes) {}

  template <class T>
  void value(T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    copy(&value, sizeof value);
  }
  // Reads an array that must be as long as `values`.
  template <class T>
  void array(std::vector<T>& values) {
    if (count() != values.size()) refuse();
    copy(values.data(), values.size() * sizeof(T));
  }
  void text(std::string& text) {
    const std::uint64_t size = count();
    if (size > bytes_.size()) refuse();
    text.resize(size);
    copy(text.data(), size);
  }
  void expect_end() const {
    if (!bytes_.empty()) refuse();
  }

  [[noreturn]] static void refuse() {
    throw_failure("a message between ranks", "it has a different format from this program's",
                  "start the same program on all machines");
  }

 private:
  std::uint64_t count() {
    std::uint64_t count = 0;
    value(count);
    return count;
  }
  void copy(void* to, std::size_t size) {
    if (size > bytes_.size()) refuse();
    if (size > 0) std::memcpy(to, bytes_.data(), size);
    bytes_ = bytes_.subspan(size);
  }

  std::span<const std::byte> bytes_;
};

// Visits the parts in one order for writing and reading. Structs are taken apart, because their padding must not be sent.
template <class Archive, class Planes>
void visit_planes(Archive& archive, Planes& sums) {
  archive.array(sums.reached);
  archive.array(sums.crossing);
  archive.array(sums.zone_landings);
  archive.array(sums.down);
  archive.array(sums.through_down);
  archive.array(sums.through_up);
}

template <class Archive, class Sums>
void visit_packets(Archive& archive, Sums& sums) {
  archive.array(sums.surface_landed);
  archive.array(sums.layer_landed);
  archive.array(sums.side_landed);
  archive.array(sums.element_hits);
  archive.array(sums.cell_landed);
  archive.array(sums.side_sky);
  archive.array(sums.cell_sky);
  archive.array(sums.down);
  archive.array(sums.up);
  archive.array(sums.ledger);
  visit_planes(archive, sums.receivers);
  archive.value(sums.sky_rays);
  archive.value(sums.packets);
  archive.value(sums.rounds);
  archive.value(sums.first_candidates);
  archive.value(sums.most_candidates);
  archive.value(sums.lost);
}

template <class Archive, class Key>
void visit_key(Archive& archive, Key& key) {
  archive.value(key.series);
  archive.value(key.number);
}

template <class Archive, class Order>
void visit_order(Archive& archive, Order& message) {
  visit_key(archive, message.key);
  archive.value(message.stage);
  archive.value(message.order.beam_rays);
  archive.value(message.order.grid_rays);
  archive.value(message.order.packets);
  archive.value(message.order.sky_rays);
  archive.value(message.order.bound);
  archive.value(message.order.seed);
  archive.value(message.order.number);
}

template <class Archive, class Ready>
void visit_ready(Archive& archive, Ready& ready) {
  archive.value(ready.slots);
  archive.text(ready.host);
  archive.text(ready.scene);
}

template <class Archive, class Failed>
void visit_failed(Archive& archive, Failed& failed) {
  archive.value(failed.kind);
  archive.text(failed.host);
  archive.text(failed.text);
}

template <class Archive, class Made>
void visit_replicate(Archive& archive, Made& replicate) {
  archive.array(replicate.counters);
  visit_planes(archive, replicate.passed);
  archive.value(replicate.direct_s);
  archive.value(replicate.indirect_s);
  if (replicate.packets) visit_packets(archive, *replicate.packets);
}

}  // namespace

std::vector<std::byte> pack(const ReplicateKey& key) {
  Writer writer;
  visit_key(writer, key);
  return std::move(writer).bytes();
}

std::vector<std::byte> pack(const OrderMessage& order) {
  Writer writer;
  visit_order(writer, order);
  return std::move(writer).bytes();
}

std::vector<std::byte> pack(const ReadyMessage& ready) {
  Writer writer;
  visit_ready(writer, ready);
  return std::move(writer).bytes();
}

std::vector<std::byte> pack(const FailedMessage& failed) {
  Writer writer;
  visit_failed(writer, failed);
  return std::move(writer).bytes();
}

std::vector<std::byte> pack(const ReplicateKey& key, const Replicate& replicate) {
  Writer writer;
  visit_key(writer, key);
  writer.value(static_cast<std::uint8_t>(replicate.packets ? 1 : 0));
  visit_replicate(writer, replicate);
  return std::move(writer).bytes();
}

ReplicateKey unpack_key(std::span<const std::byte> bytes) {
  Reader reader(bytes);
  ReplicateKey key;
  visit_key(reader, key);
  return key;
}

OrderMessage unpack_order(std::span<const std::byte> bytes) {
  Reader reader(bytes);
  OrderMessage order;
  visit_order(reader, order);
  reader.expect_end();
  return order;
}

ReadyMessage unpack_ready(std::span<const std::byte> bytes) {
  Reader reader(bytes);
  ReadyMessage ready;
  visit_ready(reader, ready);
  reader.expect_end();
  return ready;
}

FailedMessage unpack_failed(std::span<const std::byte> bytes) {
  Reader reader(bytes);
  FailedMessage failed;
  visit_failed(reader, failed);
  reader.expect_end();
  return failed;
}

Replicate unpack_replicate(std::span<const std::byte> bytes, const Replicate& blank) {
  Reader reader(bytes);
  ReplicateKey key;
  visit_key(reader, key);
  std::uint8_t packets = 0;
  reader.value(packets);
  if ((packets == 1) != blank.packets.has_value() || packets > 1) Reader::refuse();
  Replicate replicate = blank;
  visit_replicate(reader, replicate);
  reader.expect_end();
  return replicate;
}

}  // namespace sunfleck
