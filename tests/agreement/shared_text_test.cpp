// Tests that the shared text gives the same bits on the device as in C++, for a million inputs.

#include "agreement/shared_text.h"
#include "agreement/same_words.h"
#include "devices/gpu/buffer.h"
#include "devices/gpu/compute.h"
#include "shared_text.spirv.h"
#include "support/bvh_check.h"
#include "support/device.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <vector>

namespace sunfleck {
namespace {

using testing_bvh::Random;
using testing_bvh::uniform;

// All members are 32-bit words or vectors of them.
static_assert(sizeof(shared::TextInput) == 27 * 4);
static_assert(sizeof(shared::TextOutput) == 83 * 4);
static_assert(sizeof(shared::TextPush) == 16);

constexpr std::uint32_t batch = 1U << 17U;
constexpr int batches = 8;

// Returns a point; half of the points lie on a coarse lattice, where zeros, ties, edges and corners are frequent.
glm::vec3 some_point(Random& random, bool on_lattice) {
  if (!on_lattice) return testing_bvh::point(random, 2.0);
  const auto coordinate = [&] { return static_cast<float>(static_cast<int>(random() % 17U) - 8) * 0.25F; };
  const float x = coordinate();
  const float y = coordinate();
  return {x, y, coordinate()};
}

// Returns a number with any sign, any exponent of 2^-100..2^100 and any fraction.
float some_divisor(Random& random) {
  const std::uint32_t exponent = 27U + static_cast<std::uint32_t>(random() % 200U);
  const auto sign_and_fraction = static_cast<std::uint32_t>(random()) & 0x807fffffU;
  return std::bit_cast<float>(sign_and_fraction | exponent << 23U);
}

// Returns a word; one in four is next to where a quarter of the turn or the unit interval begins or ends, or in the middle, so
// that some directions are opposite to the normal.
std::uint32_t some_word(Random& random) {
  constexpr std::array<std::uint32_t, 8> ends = {0,           0xffU,       0x100U,      0x3fffffffU,
                                                 0x40000000U, 0x80000000U, 0xe0000000U, 0xffffffffU};
  const auto word = static_cast<std::uint32_t>(random());
  return random() % 4 == 0 ? ends[word % ends.size()] : word;
}

// Makes some triangles degenerate: corners that coincide, corners on a line, slivers.
void flatten_some(Random& random, shared::TextInput& given) {
  const glm::vec3 along = given.b - given.a;
  switch (random() % 128) {
    case 0:
      given.b = given.a;
      break;
    case 1:
      given.c = given.a;
      break;
    case 2:
      given.c = given.a + along * 0.5F;
      break;
    case 3:
      given.c = given.b + testing_bvh::point(random, 1e-6);
      break;
    case 4:
      given.c = given.a + along * static_cast<float>(uniform(random));
      break;
    default:
      break;
  }
}

// Returns a coordinate up to a thousand metres away; some are at a border of the period or just beside it.
float some_far_coordinate(Random& random, bool on_lattice) {
  if (random() % 16 == 0) return random() % 2 == 0 ? -0.0F : -1e-9F;
  const auto far = static_cast<float>(uniform(random, -1000.0, 1000.0));
  return on_lattice ? std::floor(far) : far;
}

shared::TextInput some_input(Random& random) {
  const bool on_lattice = random() % 2 == 0;
  shared::TextInput given;
  given.origin = some_point(random, on_lattice);
  given.a = some_point(random, on_lattice);
  given.b = some_point(random, on_lattice);
  given.c = some_point(random, on_lattice);
  flatten_some(random, given);
  const auto weight_a = static_cast<float>(uniform(random));
  const auto weight_b = static_cast<float>(uniform(random, -0.1, 1.0));
  const glm::vec3 target = weight_a * given.a + weight_b * given.b + (1.0F - weight_a - weight_b) * given.c;
  given.direction = on_lattice ? some_point(random, true) : target - given.origin;
  if (given.direction == glm::vec3(0.0F)) given.direction.y = -1.0F;
  if (random() % 8 == 0) given.direction[static_cast<int>(random() % 3U)] = -0.0F;
  if (random() % 8 == 0) given.direction[static_cast<int>(random() % 3U)] *= 1e-12F;
  if (given.direction == glm::vec3(0.0F)) given.direction.z = 1.0F;
  given.period = {static_cast<float>(uniform(random, 0.5, 3.0)), on_lattice ? 2.0F : 1.7F};
  given.overlap = given.period * 0x1p-19F;
  given.offset = {static_cast<float>(uniform(random)), static_cast<float>(uniform(random))};
  given.divisor = some_divisor(random);
  given.number = static_cast<std::uint32_t>(random());
  given.drawn.x = some_word(random);
  given.drawn.y = some_word(random);
  given.size = std::ldexp(static_cast<float>(uniform(random, 1.0, 2.0)), static_cast<int>(random() % 81U) - 40);
  given.far = some_far_coordinate(random, on_lattice);
  return given;
}

shared::BeamBlock some_beam(std::uint32_t columns, std::uint32_t rows) {
  shared::BeamBlock beam{};
  beam.corner = {-0.3F, 2.7F, 0.1F};
  beam.edge_u = {1.8F, 0.1F, 0.03F};
  beam.edge_v = {-0.2F, 0.3F, 2.4F};
  beam.columns = columns;
  beam.rows = rows;
  beam.per_column = 1.0F / static_cast<float>(columns);
  beam.per_row = 1.0F / static_cast<float>(rows);
  beam.key = {0x12345678U, 0x9abcdef0U};
  beam.ground.plot_lo = {-0.5F, -0.25F};
  beam.ground.plot_hi = {1.5F, 1.0F};
  beam.ground.cells_x = 40;
  beam.ground.cells_z = 7;
  beam.ground.cells_per_metre = {20.0F, 5.6F};
  beam.ground.y = -0.75F;
  beam.ground.depth = 1e-5F;
  beam.layer_base_y = -0.5F;
  beam.layers_per_metre = 11.3F;
  beam.layers = 20;
  return beam;
}

shared::ViewBlock some_view(const shared::GroundMap& ground, std::uint32_t kind) {
  shared::ViewBlock view{};
  view.position = {3.0F, 2.0F, 1.0F};
  view.forward = {-0.8F, -0.5F, 0.3F};
  view.right = {0.1F, -0.02F, 0.3F};
  view.up = {0.12F, 0.25F, -0.1F};
  view.width = 641;
  view.height = 479;
  view.samples = 5;
  view.elements = 3;
  view.kind = kind;
  view.ground = ground;
  view.start = 1.7F;
  return view;
}

template <class T>
GpuBuffer storage_of(const GpuContext& context, std::span<const T> data) {
  GpuBuffer buffer = create_buffer(context, BufferUse::storage, data.size_bytes(), "test data");
  upload(context, buffer, std::as_bytes(data));
  return buffer;
}

using SharedText = DeviceTest;

TEST_F(SharedText, GivesTheSameBitsOnTheDevice) {
  const ShaderCode code{"shared_text", shared_text_spirv, std::vector<BufferUse>(4, BufferUse::storage),
                        sizeof(shared::TextPush), shared::group_size};
  ComputePipeline pipeline(context(), code, {});
  Random random(1);
  std::vector<shared::TextInput> inputs(batch);
  std::vector<shared::TextOutput> outputs(batch);
  const GpuBuffer results = create_buffer(context(), BufferUse::storage, batch * sizeof(shared::TextOutput), "outputs");
  WordComparison words;
  std::size_t met = 0;
  std::size_t areas = 0;
  std::size_t kept_normal = 0;
  for (int k = 0; k < batches; ++k) {
    const shared::BeamBlock beam = some_beam(1000U + 37U * static_cast<std::uint32_t>(k), 999);
    const shared::ViewBlock view = some_view(beam.ground, static_cast<std::uint32_t>(k) % 2);
    for (shared::TextInput& given : inputs) given = some_input(random);
    const GpuBuffer beam_buffer = storage_of(context(), std::span(&beam, 1));
    const GpuBuffer view_buffer = storage_of(context(), std::span(&view, 1));
    const GpuBuffer given = storage_of(context(), std::span<const shared::TextInput>(inputs));
    const GpuBuffer* const buffers[] = {&beam_buffer, &view_buffer, &given, &results};
    const shared::TextPush push{{}, batch};
    pipeline.run(batch, bytes_of(push), buffers);
    download(context(), results, std::as_writable_bytes(std::span(outputs)));
    for (std::size_t i = 0; i < batch; ++i) {
      const shared::TextOutput expected = shared::all_of_the_text(beam, view, inputs[i]);
      met += expected.met_lower >= 2 ? 1 : 0;
      areas += expected.normal != glm::vec3(0.0F, 1.0F, 0.0F) ? 1 : 0;
      kept_normal += expected.scattered == expected.normal ? 1 : 0;
      words.add(expected, outputs[i], k, i);
    }
  }
  EXPECT_EQ(words.differences(), 0U);
  constexpr std::size_t all = std::size_t{batch} * batches;
  EXPECT_GT(met, all / 5);  // ensures that weights and distances were compared
  // The degenerate cases occurred, and did not prevail.
  EXPECT_GT(areas, all / 2);
  EXPECT_LT(areas, all - all / 100);
  EXPECT_GT(kept_normal, 0U);
}

}  // namespace
}  // namespace sunfleck
