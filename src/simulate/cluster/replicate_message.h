#pragma once
// Orders and replicates packed into bytes, for processes of the same program on machines of the same kind.

#include "physics/transport/indirect/replicate.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace sunfleck {

// Identifies the replicate that a message is about.
struct ReplicateKey {
  std::uint64_t series = 0;  // orders of one series are dropped together
  std::uint64_t number = 0;
};

struct OrderMessage {
  ReplicateKey key;
  std::uint64_t stage = 0;  // selects the light: the step of a day
  ReplicateOrder order;
};

// Announces a rank that is ready to help.
struct ReadyMessage {
  std::uint64_t slots = 1;  // number of replicates that it makes at a time
  std::string host;
  std::string scene;  // description of its scene, which must be the same for all ranks
};

// The error that ended the work of a rank.
struct FailedMessage {
  int kind = 1;  // as ErrorKind
  std::string host, text;
};

[[nodiscard]] std::vector<std::byte> pack(const ReplicateKey& key);
[[nodiscard]] std::vector<std::byte> pack(const OrderMessage& order);
[[nodiscard]] std::vector<std::byte> pack(const ReadyMessage& ready);
[[nodiscard]] std::vector<std::byte> pack(const FailedMessage& failed);
[[nodiscard]] std::vector<std::byte> pack(const ReplicateKey& key, const Replicate& replicate);

// These functions throw Error (failure) for bytes that are not such a message.
[[nodiscard]] ReplicateKey unpack_key(std::span<const std::byte> bytes);  // reads the key of a replicate, too
[[nodiscard]] OrderMessage unpack_order(std::span<const std::byte> bytes);
[[nodiscard]] ReadyMessage unpack_ready(std::span<const std::byte> bytes);
[[nodiscard]] FailedMessage unpack_failed(std::span<const std::byte> bytes);
// `blank` gives the sizes of the arrays; its `sums` are left as they are.
[[nodiscard]] Replicate unpack_replicate(std::span<const std::byte> bytes, const Replicate& blank);

}  // namespace sunfleck
