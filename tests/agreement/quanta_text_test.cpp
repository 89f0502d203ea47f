// Tests that the arithmetic of quanta gives the same words on the device as in C++, for a million inputs.

#include "agreement/quanta_text.h"
#include "agreement/same_words.h"
#include "devices/gpu/buffer.h"
#include "devices/gpu/compute.h"
#include "quanta_text.spirv.h"
#include "support/device.h"
#include "support/wide_numbers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>
#include <span>
#include <vector>

namespace sunfleck {
namespace {

using test::some_number;
using test::some_number_up_to;
using test::Wide;

// All members are 32-bit words or vectors of them.
static_assert(sizeof(shared::QuantaInput) == 36 * 4);
static_assert(sizeof(shared::QuantaOutput) == 25 * 4);

constexpr std::uint32_t quanta_batch = 1U << 17U;
constexpr int quanta_batches = 8;

// Returns the largest number that a scale takes to less than 2^64.
std::uint64_t largest_to_scale(const shared::Scale& scale) {
  if (scale.mantissa == 0) return test::all_ones;
  const Wide end = (Wide{1} << (64U + scale.shift)) - 1;
  return static_cast<std::uint64_t>(std::min<Wide>(end / scale.mantissa, test::all_ones));
}

// Returns the arguments of every function, within what it asks of them.
shared::QuantaInput some_quanta_input(std::mt19937_64& random) {
  using shared::apart;
  shared::QuantaInput given;
  given.any_a = apart(some_number(random));
  given.any_b = apart(some_number(random));
  given.offset = apart(some_number(random));
  const std::uint64_t divisor = std::max<std::uint64_t>(1, some_number_up_to(random, test::two_to_63));
  given.divisor = apart(divisor);
  given.rest = apart(some_number_up_to(random, divisor - 1));
  given.coefficient = apart(some_number_up_to(random, test::two_to_32));
  const auto places = static_cast<std::uint32_t>(std::max<std::uint64_t>(1, some_number_up_to(random, test::two_to_32 - 1)));
  given.parts_each = apart(test::two_to_32 * shared::element_parts / places);
  given.number = static_cast<std::uint32_t>(some_number_up_to(random, places - 1));
  given.denominator = apart(some_number_up_to(random, test::two_to_63));
  given.scale = {test::some_word(random), static_cast<std::uint32_t>(random() % 33U)};
  given.scaled_quanta = apart(some_number_up_to(random, largest_to_scale(given.scale)));
  const std::uint64_t expectation = std::max<std::uint64_t>(1, some_number(random));
  given.spare_bits = random() % 2 == 0 ? 0 : 10;
  given.expectation = apart(expectation);
  const Wide largest = std::min<Wide>(Wide{expectation} << given.spare_bits, test::all_ones);
  given.expected = apart(some_number_up_to(random, static_cast<std::uint64_t>(largest)));
  given.weights = apart(some_number_up_to(random, test::two_to_63));
  given.word = test::some_word(random);
  // Points within the sphere, near it, and so far away that least_aim_bits decide.
  std::uniform_real_distribution<float> part(-1.0F, 1.0F);
  given.stand = {{part(random), part(random), part(random)},
                 std::ldexp(1.0F + part(random) / 2.0F, static_cast<int>(random() % 16U) - 12)};
  given.point = {part(random), part(random), part(random)};
  return given;
}

using QuantaText = DeviceTest;

TEST_F(QuantaText, GivesTheSameWordsOnTheDevice) {
  if (!context().limits().int64) GTEST_SKIP() << "the device has no 64-bit integers";
  const ShaderCode code{"quanta_text", quanta_text_spirv, std::vector<BufferUse>(2, BufferUse::storage),
                        sizeof(shared::QuantaPush), shared::group_size};
  ComputePipeline pipeline(context(), code, {});
  std::mt19937_64 random(1);
  std::vector<shared::QuantaInput> inputs(quanta_batch);
  std::vector<shared::QuantaOutput> outputs(quanta_batch);
  const GpuBuffer given = create_buffer(context(), BufferUse::storage, quanta_batch * sizeof(shared::QuantaInput), "inputs");
  const GpuBuffer results =
      create_buffer(context(), BufferUse::storage, quanta_batch * sizeof(shared::QuantaOutput), "outputs");
  WordComparison words;
  std::size_t loaded = 0;
  std::size_t least_aimed = 0, aimed = 0;
  std::set<std::uint32_t> scale_shifts, load_shifts;
  for (int k = 0; k < quanta_batches; ++k) {
    for (shared::QuantaInput& input : inputs) input = some_quanta_input(random);
    upload(context(), given, std::as_bytes(std::span(inputs)));
    const GpuBuffer* const buffers[] = {&given, &results};
    const shared::QuantaPush push{quanta_batch};
    pipeline.run(quanta_batch, bytes_of(push), buffers);
    download(context(), results, std::as_writable_bytes(std::span(outputs)));
    for (std::size_t i = 0; i < quanta_batch; ++i) {
      const shared::QuantaOutput expected = shared::all_of_the_quanta(inputs[i]);
      loaded += shared::joined(expected.carried_quanta) != 0 ? 1 : 0;
      scale_shifts.insert(expected.scale.shift);
      load_shifts.insert(expected.load_shift);
      least_aimed += shared::joined(expected.aimed) == test::two_to_32 >> shared::least_aim_bits ? 1 : 0;
      aimed += shared::joined(expected.aimed) < test::two_to_32 ? 1 : 0;
      words.add(expected, outputs[i], k, i);
    }
  }
  EXPECT_EQ(words.differences(), 0U);
  // Quanta were carried, and every shift occurred.
  EXPECT_GT(loaded, std::size_t{quanta_batch} * quanta_batches / 5);
  EXPECT_EQ(scale_shifts.size(), 33U);
  EXPECT_EQ(load_shifts.size(), 16U);
  EXPECT_GT(least_aimed, 0U);
  EXPECT_GT(aimed, 2 * least_aimed);
  EXPECT_LT(aimed, std::size_t{quanta_batch} * quanta_batches);
}

}  // namespace
}  // namespace sunfleck
