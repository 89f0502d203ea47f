// Tests packed arrays of all lengths around those of their streams.

#include "base/packed_array.h"

#include "base/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <span>

namespace sunfleck {
namespace {

constexpr std::size_t stream = std::size_t{1} << 18U;

// Returns bytes of which half can be foretold.
std::vector<std::uint8_t> some_bytes(std::size_t count) {
  RandomStream random(1, 2);
  std::vector<std::uint8_t> bytes(count);
  for (std::size_t k = 0; k < count; ++k) bytes[k] = static_cast<std::uint8_t>(k % 2 == 0 ? 7U : random.word() & 0xffU);
  return bytes;
}

class PackedArray : public ::testing::TestWithParam<std::size_t> {};

TEST_P(PackedArray, IsReadAsItWasWritten) {
  const std::vector<std::uint8_t> bytes = some_bytes(GetParam());
  const nlohmann::json packed = pack(bytes);
  EXPECT_LE(packed.get_binary().size(), bytes.size() * 3 / 4 + 64);
  EXPECT_EQ(unpack<std::uint8_t>(packed, bytes.size()), bytes);
}

TEST_P(PackedArray, DoesNotDependOnItsPieces) {
  const std::vector<std::uint8_t> bytes = some_bytes(GetParam());
  const NumberPieces<std::uint8_t> pieces = [&](const std::function<void(std::span<const std::uint8_t>)>& take) {
    constexpr std::size_t at_once = 77777;
    for (std::size_t first = 0; first < bytes.size(); first += at_once) {
      take(std::span(bytes).subspan(first, std::min(at_once, bytes.size() - first)));
    }
  };
  EXPECT_EQ(pack(pieces, bytes.size()), pack(bytes));
  EXPECT_EQ(pack(pieces, 1), pack(bytes));
}

TEST_P(PackedArray, OfAnotherLengthIsRefused) {
  const std::vector<std::uint8_t> bytes = some_bytes(GetParam());
  const nlohmann::json packed = pack(bytes);
  EXPECT_THROW(static_cast<void>(unpack<std::uint8_t>(packed, bytes.size() + 1)), std::runtime_error);
  if (!bytes.empty()) {
    EXPECT_THROW(static_cast<void>(unpack<std::uint8_t>(packed, bytes.size() - 1)), std::runtime_error);
  }
}

TEST_P(PackedArray, ThatIsCutOrChangedIsRefused) {
  const std::vector<std::uint8_t> bytes = some_bytes(GetParam());
  const nlohmann::json::binary_t packed = pack(bytes).get_binary();
  for (std::size_t cut = 1; cut < packed.size(); cut = 3 * cut + 1) {
    nlohmann::json::binary_t damaged = packed;
    damaged.resize(packed.size() - cut);
    EXPECT_THROW(static_cast<void>(unpack<std::uint8_t>(nlohmann::json::binary(damaged), bytes.size())), std::runtime_error);
    damaged = packed;
    damaged[packed.size() - cut] ^= 0x10U;
    EXPECT_THROW(static_cast<void>(unpack<std::uint8_t>(nlohmann::json::binary(damaged), bytes.size())), std::runtime_error);
  }
}

// Returns numbers of which the lower half is random, and the upper half always the same.
std::vector<std::uint64_t> some_numbers(std::size_t bytes) {
  RandomStream random(3, 4);
  std::vector<std::uint64_t> numbers(bytes / sizeof(std::uint64_t));
  for (std::uint64_t& number : numbers) number = 0x0123456700000000U + (random.word() >> 32U);
  return numbers;
}

TEST_P(PackedArray, OfWordsIsReadAsItWasWritten) {
  const std::vector<std::uint64_t> numbers = some_numbers(GetParam());
  const nlohmann::json packed = pack(numbers);
  EXPECT_LE(packed.at("planes").get_binary().size(), numbers.size() * 9 / 2 + 128) << "half of the bytes, and a little";
  EXPECT_EQ(unpack<std::uint64_t>(packed, numbers.size()), numbers);
  EXPECT_THROW(static_cast<void>(unpack<std::uint64_t>(packed, numbers.size() + 1)), std::runtime_error);
}

// Their lower bytes are random, and longer than a block of deflate that is stored as it is.
TEST_P(PackedArray, OfFloatsIsReadAsItWasWritten) {
  RandomStream random(5, 6);
  std::vector<float> numbers(GetParam() / sizeof(float));
  for (float& number : numbers) number = std::bit_cast<float>(0x42000000U + static_cast<std::uint32_t>(random.word() >> 48U));
  const nlohmann::json packed = pack(numbers);
  EXPECT_LE(packed.at("planes").get_binary().size(), numbers.size() * 9 / 4 + 128) << "half of the bytes, and a little";
  EXPECT_EQ(unpack<float>(packed, numbers.size()), numbers);
  EXPECT_THROW(static_cast<void>(unpack<float>(packed, numbers.size() + 1)), std::runtime_error);
}

// Deflate leaves some bits without a meaning; a change of such a bit changes no number.
TEST_P(PackedArray, OfWordsThatIsCutOrChangedIsRefused) {
  const std::vector<std::uint64_t> numbers = some_numbers(GetParam());
  const nlohmann::json::binary_t packed = pack(numbers).at("planes").get_binary();
  const auto is_refused = [&](const nlohmann::json::binary_t& planes) {
    nlohmann::json damaged;
    damaged["planes"] = nlohmann::json::binary(planes);
    try {
      EXPECT_EQ(unpack<std::uint64_t>(damaged, numbers.size()), numbers);
    } catch (const std::runtime_error&) {
      return true;
    }
    return false;
  };
  int refused = 0;
  int changed = 0;
  for (std::size_t cut = 1; cut < packed.size(); cut = 3 * cut + 1) {
    nlohmann::json::binary_t damaged = packed;
    damaged[packed.size() - cut] ^= 0x10U;
    ++changed;
    if (is_refused(damaged)) ++refused;
    damaged = packed;
    damaged.resize(packed.size() - cut);
    EXPECT_TRUE(is_refused(damaged)) << cut;
  }
  EXPECT_GE(refused, changed - 1);
}

// Earlier builds did not take words apart, and wrote streams of other lengths, even empty ones.
TEST_P(PackedArray, OfAnEarlierBuildIsRead) {
  constexpr std::size_t at_once = 99991;
  const std::vector<std::uint64_t> numbers = some_numbers(GetParam());
  const auto bytes = std::as_bytes(std::span(numbers));
  nlohmann::json::binary_t streams(std::vector<std::uint8_t>{0x78, 0x01, 0x03, 0x00, 0x00, 0x00, 0x00, 0x01});
  for (std::size_t first = 0; first < bytes.size(); first += at_once) {
    const auto piece = bytes.subspan(first, std::min(at_once, bytes.size() - first));
    const nlohmann::json::binary_t one = deflated([&](const auto& take) { take(piece); }, 1, piece.size());
    streams.insert(streams.end(), one.begin(), one.end());
  }
  EXPECT_EQ(unpack<std::uint64_t>(nlohmann::json::binary(streams), numbers.size()), numbers);
}

TEST(PackedArrays, HoldWhatWasPacked) {
  for (const std::size_t count : {0U, 1U, 1000U, 1000000U}) {
    std::vector<std::uint64_t> values(count);
    for (std::size_t k = 0; k < count; ++k) values[k] = k * k;
    const nlohmann::json packed = pack(values);
    EXPECT_EQ(unpack<std::uint64_t>(packed, count), values);
    EXPECT_THROW(static_cast<void>(unpack<std::uint64_t>(packed, count + 1)), std::runtime_error);
    const std::size_t other = count > 0 ? count - 1 : 7;
    EXPECT_THROW(static_cast<void>(unpack<std::uint64_t>(packed, other)), std::runtime_error);
  }
}

// Each byte is as frequent as any other, but stands in a run.
TEST(PackedArrays, OfRunsBecomeFew) {
  constexpr std::size_t run = 20;
  std::vector<std::uint64_t> numbers(200000);
  for (std::size_t k = 0; k < numbers.size(); ++k) numbers[k] = k / run * 0x9e3779b97f4a7c15U;
  const nlohmann::json packed = pack(numbers);
  EXPECT_LT(packed.at("planes").get_binary().size(), numbers.size() * sizeof(std::uint64_t) / 4);
  EXPECT_EQ(unpack<std::uint64_t>(packed, numbers.size()), numbers);
}

INSTANTIATE_TEST_SUITE_P(Lengths, PackedArray, ::testing::Values(0, 1, 1000, stream - 1, stream, stream + 1, 40 * stream + 5));

}  // namespace
}  // namespace sunfleck
