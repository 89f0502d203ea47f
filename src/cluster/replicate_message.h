#pragma once
// Orders and replicates as bytes, for processes of the same program on machines of the same kind.

#include "transport/replicate.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace sunfleck {

// Which replicate a message is about.
struct ReplicateKey {
  std::uint64_t series = 0;  // orders of one series are dropped together
  std::uint64_t number = 0;
};

struct OrderMessage {
  ReplicateKey key;
  std::uint64_t stage = 0;  // which light: a day's step
  ReplicateOrder order;
};

// A rank that is ready to help.
struct ReadyMessage {
  std::uint64_t slots = 1;  // replicates it takes at a time
  std::string host;
  std::string scene;  // what it was given, in words; the same for all
};

// Why a rank cannot go on.
struct FailedMessage {
  int kind = 1;  // as ErrorKind
  std::string host, text;
};

[[nodiscard]] std::vector<std::byte> pack(const ReplicateKey& key);
[[nodiscard]] std::vector<std::byte> pack(const OrderMessage& order);
[[nodiscard]] std::vector<std::byte> pack(const ReadyMessage& ready);
[[nodiscard]] std::vector<std::byte> pack(const FailedMessage& failed);
[[nodiscard]] std::vector<std::byte> pack(const ReplicateKey& key, const Replicate& replicate);

// They throw Error (failure) for bytes that are no such message.
[[nodiscard]] ReplicateKey unpack_key(std::span<const std::byte> bytes);  // of a replicate, too
[[nodiscard]] OrderMessage unpack_order(std::span<const std::byte> bytes);
[[nodiscard]] ReadyMessage unpack_ready(std::span<const std::byte> bytes);
[[nodiscard]] FailedMessage unpack_failed(std::span<const std::byte> bytes);
// `blank` tells the sizes; its `sums` stay as they are.
[[nodiscard]] Replicate unpack_replicate(std::span<const std::byte> bytes, const Replicate& blank);

}  // namespace sunfleck
