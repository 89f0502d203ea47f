#include "simulate/cluster/replicate_message.h"

#include "base/error.h"

#include <bit>
#include <cstring>
#include <type_traits>
#include <utility>

namespace sunfleck {
namespace {

static_assert(std::endian::native == std::endian::little);

// Appends values as they lie in memory. Structs are taken apart by their own `visit`, because their padding must not be sent.
class Writer {
 public:
  template <class... T>
  void operator()(const T&... values) {
    (write(values), ...);
  }

  [[nodiscard]] std::vector<std::byte> bytes() && { return std::move(bytes_); }

 private:
  template <class T>
  void write(const T& value) {
    if constexpr (std::is_arithmetic_v<T>) {
      append(&value, sizeof value);
    } else if constexpr (requires { value.data(); }) {
      static_assert(std::is_trivially_copyable_v<std::remove_cvref_t<decltype(*value.data())>>);
      write(std::uint64_t{value.size()});
      append(value.data(), value.size() * sizeof *value.data());
    } else {
      T::visit(value, *this);
    }
  }
  void append(const void* data, std::size_t size) {
    const auto* begin = static_cast<const std::byte*>(data);
    bytes_.insert(bytes_.end(), begin, begin + size);
  }

  std::vector<std::byte> bytes_;
};

// Fills values from such bytes. An array must have the length of the one that was written; a text and a list of numbers of a
// light may have any length.
class Reader {
 public:
  explicit Reader(std::span<const std::byte> bytes) : bytes_(bytes) {}

  template <class... T>
  void operator()(T&... values) {
    (read(values), ...);
  }

  void expect_end() const { expect(bytes_.empty()); }

  static void expect(bool good) {
    if (good) return;
    throw_failure("a message between ranks", "it has a different format from this program's",
                  "start the same program on all machines");
  }

 private:
  template <class T>
  void read(T& value) {
    if constexpr (std::is_arithmetic_v<T>) {
      copy(&value, sizeof value);
    } else if constexpr (requires { value.data(); }) {
      std::uint64_t count = 0;
      read(count);
      if constexpr (std::is_same_v<T, std::string> || std::is_same_v<T, std::vector<double>>) {
        expect(count <= bytes_.size() / sizeof *value.data());
        value.resize(count);
      }
      expect(count == value.size());
      copy(value.data(), value.size() * sizeof *value.data());
    } else {
      T::visit(value, *this);
    }
  }
  void copy(void* to, std::size_t size) {
    expect(size <= bytes_.size());
    if (size > 0) std::memcpy(to, bytes_.data(), size);
    bytes_ = bytes_.subspan(size);
  }

  std::span<const std::byte> bytes_;
};

}  // namespace

template <class Message>
std::vector<std::byte> pack(const Message& message) {
  Writer writer;
  writer(message);
  return std::move(writer).bytes();
}

template <class Message>
Message unpack(std::span<const std::byte> bytes) {
  Reader reader(bytes);
  Message message;
  reader(message);
  reader.expect_end();
  return message;
}

template std::vector<std::byte> pack(const ReplicateKey&);
template std::vector<std::byte> pack(const OrderMessage&);
template std::vector<std::byte> pack(const ReadyMessage&);
template std::vector<std::byte> pack(const FailedMessage&);
template OrderMessage unpack(std::span<const std::byte>);
template ReadyMessage unpack(std::span<const std::byte>);
template FailedMessage unpack(std::span<const std::byte>);

std::vector<std::byte> pack(const ReplicateKey& key, const ReplicateSet& replicates) {
  Writer writer;
  writer(key, static_cast<std::uint8_t>(replicates.front().packets ? 1 : 0));
  for (const Replicate& replicate : replicates) writer(replicate);
  return std::move(writer).bytes();
}

ReplicateKey unpack_key(std::span<const std::byte> bytes) {
  ReplicateKey key;
  Reader{bytes}(key);
  return key;
}

ReplicateSet unpack_replicates(std::span<const std::byte> bytes, const ReplicateSet& blank) {
  Reader reader(bytes);
  ReplicateKey key;
  std::uint8_t packets = 0;
  reader(key, packets);
  Reader::expect(packets == (blank.front().packets ? 1 : 0));
  ReplicateSet replicates = blank;
  for (Replicate& replicate : replicates) reader(replicate);
  reader.expect_end();
  return replicates;
}

}  // namespace sunfleck
