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

  template <class Self, class Archive>
  static void visit(Self& self, Archive& archive) {
    archive(self.series, self.number);
  }
};

struct OrderMessage {
  ReplicateKey key;
  std::uint64_t stage = 0;  // selects the lights: the block of a day
  ReplicateOrder order;

  template <class Self, class Archive>
  static void visit(Self& self, Archive& archive) {
    archive(self.key, self.stage, self.order);
  }
};

// Announces a rank that is ready to help.
struct ReadyMessage {
  std::uint64_t slots = 1;  // number of replicates that it makes at a time
  std::string host;
  std::string scene;  // description of its scene, which must be the same for all ranks

  template <class Self, class Archive>
  static void visit(Self& self, Archive& archive) {
    archive(self.slots, self.host, self.scene);
  }
};

// The error that ended the work of a rank.
struct FailedMessage {
  int kind = 1;  // as ErrorKind
  std::string host, text;

  template <class Self, class Archive>
  static void visit(Self& self, Archive& archive) {
    archive(self.kind, self.host, self.text);
  }
};

// Packs one of these structs.
template <class Message>
[[nodiscard]] std::vector<std::byte> pack(const Message& message);
[[nodiscard]] std::vector<std::byte> pack(const ReplicateKey& key, const ReplicateSet& replicates);

// These functions throw Error (failure) for bytes that are not such a message.
template <class Message>
[[nodiscard]] Message unpack(std::span<const std::byte> bytes);
[[nodiscard]] ReplicateKey unpack_key(std::span<const std::byte> bytes);  // of a replicate, too
// `blank` gives the sizes of the arrays; what follows from the counters (Replicate::direct) is left as it is there.
[[nodiscard]] ReplicateSet unpack_replicates(std::span<const std::byte> bytes, const ReplicateSet& blank);

}  // namespace sunfleck
