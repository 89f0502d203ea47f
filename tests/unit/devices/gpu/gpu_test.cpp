#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include "base/error.h"
#include "devices/gpu/buffer.h"
#include "devices/gpu/compute.h"
#include "devices/gpu/context.h"
#include "devices/gpu/handles.h"
#include "devices/gpu/submission.h"
#include "gpu_test.spirv.h"
#include "support/device.h"
#include "support/error_text.h"

namespace sunfleck {
namespace {

struct Push {
  std::uint32_t count;
  std::uint32_t addend;
};

enum class Mode : std::uint32_t { add, fetch, write_past_end };

ComputePipeline make_pipeline(const GpuContext& context, Mode mode, std::uint32_t factor = 1) {
  const ShaderCode code{"gpu_test", gpu_test_spirv, {BufferUse::storage, BufferUse::uniform_texel}, sizeof(Push), 64};
  return {context, code, {static_cast<std::uint32_t>(mode), factor}};
}

void run(ComputePipeline& pipeline, std::uint64_t threads, const Push& push, const GpuBuffer& words, const GpuBuffer& texels) {
  const GpuBuffer* buffers[] = {&words, &texels};
  pipeline.run(threads, bytes_of(push), buffers);
}

GpuBuffer make_buffer(const GpuContext& context, BufferUse use, std::span<const std::uint32_t> words) {
  return create_filled_buffer(context, use, std::as_bytes(words), "test data");
}

void fill(const GpuContext& context, const GpuBuffer& buffer, std::uint32_t word) {
  Submission submission(context);
  submission.fill(buffer, word);
  submission.finish();
}

std::vector<std::uint32_t> read_words(const GpuContext& context, const GpuBuffer& buffer) {
  std::vector<std::uint32_t> words(buffer.bytes / 4);
  download(context, buffer, std::as_writable_bytes(std::span(words)));
  return words;
}

std::vector<std::uint32_t> noise(std::size_t count) {
  std::vector<std::uint32_t> words(count);
  std::uint32_t state = 1;
  for (auto& word : words) word = state = state * 747796405u + 2891336453u;
  return words;
}

// Expects `call` to throw an error with this one line and kind.
std::string device_error(const std::function<void()>& call) {
  std::string line = refusal_of(call, ErrorKind::device);
  EXPECT_EQ(line.find('\n'), std::string::npos);
  return line;
}

void open_device(DeviceSelector::Kind kind, int index, const std::string& name) {
  const GpuContext context({kind, index, name}, Validation::off);
}

using GpuTest = DeviceTest;

TEST_F(GpuTest, BuffersGiveBackWhatWasUploaded) {
  for (const auto use : {BufferUse::storage, BufferUse::uniform_texel}) {
    for (const std::size_t count :
         {std::size_t{0}, std::size_t{1}, std::size_t{3}, std::size_t{1027}, Staging::bytes / 2 + 5}) {
      const auto words = noise(count);
      const auto buffer = make_buffer(context(), use, words);
      EXPECT_TRUE(read_words(context(), buffer) == words) << count;
    }
  }
}

TEST_F(GpuTest, UploadAndDownloadReachAPartOfABuffer) {
  auto words = noise(100);
  const auto buffer = make_buffer(context(), BufferUse::storage, words);
  const std::uint32_t part[] = {7, 8, 9};
  upload(context(), buffer, std::as_bytes(std::span(part)), 97 * 4);
  std::copy(std::begin(part), std::end(part), words.begin() + 97);
  EXPECT_EQ(read_words(context(), buffer), words);
  std::uint32_t two[2] = {};
  download(context(), buffer, std::as_writable_bytes(std::span(two)), 96 * 4);
  EXPECT_EQ(two[0], words[96]);
  EXPECT_EQ(two[1], 7u);
  EXPECT_THROW(upload(context(), buffer, std::as_bytes(std::span(part)), 98 * 4), std::logic_error);
  EXPECT_THROW(download(context(), buffer, std::as_writable_bytes(std::span(two)), 101 * 4), std::logic_error);
}

TEST_F(GpuTest, FillSetsEveryWord) {
  for (const std::size_t count : {0, 1, 5, 1001}) {
    const auto buffer = make_buffer(context(), BufferUse::storage, noise(count));
    fill(context(), buffer, 0xDEADBEEFu);
    EXPECT_EQ(read_words(context(), buffer), std::vector<std::uint32_t>(count, 0xDEADBEEFu));
  }
}

TEST_F(GpuTest, ShadersRunForEveryThreadAndNoOther) {
  const auto texels = create_buffer(context(), BufferUse::uniform_texel, 0, "nothing");
  auto pipeline = make_pipeline(context(), Mode::add);
  for (const std::uint32_t threads : {0u, 1u, 63u, 64u, 65u, 1000u, 100'003u}) {
    auto words = noise(threads + 64);
    const auto buffer = make_buffer(context(), BufferUse::storage, words);
    run(pipeline, threads, {threads, 42}, buffer, texels);
    run(pipeline, threads, {threads, 1000}, buffer, texels);  // sees what the first run wrote
    for (std::uint32_t i = 0; i < threads; ++i) words[i] += 1042;
    EXPECT_TRUE(read_words(context(), buffer) == words) << threads;
  }
}

TEST_F(GpuTest, CopiesFillsAndDispatchesSeeEachOtherInOneSubmission) {
  constexpr std::uint32_t count = 1000;
  const auto texels = create_buffer(context(), BufferUse::uniform_texel, 0, "nothing");
  const auto buffer = create_buffer(context(), BufferUse::storage, count * 4, "words");
  auto pipeline = make_pipeline(context(), Mode::add);
  const auto words = noise(count / 2);
  const Push push{count, 42};
  const GpuBuffer* buffers[] = {&buffer, &texels};
  std::vector<std::uint32_t> before(count), after(count);
  const DeviceTraffic start = context().traffic();
  Submission submission(context());
  submission.fill(buffer, 7);
  submission.upload(buffer, std::as_bytes(std::span(words)));
  submission.download(buffer, std::as_writable_bytes(std::span(before)));
  submission.run(pipeline, count, bytes_of(push), buffers);
  submission.download(buffer, std::as_writable_bytes(std::span(after)));
  submission.finish();
  EXPECT_EQ(context().traffic().submissions - start.submissions, 1U);
  EXPECT_EQ(context().traffic().uploaded_bytes - start.uploaded_bytes, words.size() * 4);
  EXPECT_EQ(context().traffic().downloaded_bytes - start.downloaded_bytes, 2U * 4 * count);
  std::vector<std::uint32_t> expected = words;
  expected.resize(count, 7);
  EXPECT_EQ(before, expected);
  for (std::uint32_t& word : expected) word += 42;
  EXPECT_EQ(after, expected);
}

TEST_F(GpuTest, APipelineRunsAgainInASubmissionWithTheSameBuffers) {
  constexpr std::uint32_t count = 1000;
  const auto texels = create_buffer(context(), BufferUse::uniform_texel, 0, "nothing");
  const auto words = noise(count);
  const auto buffer = make_buffer(context(), BufferUse::storage, words);
  auto pipeline = make_pipeline(context(), Mode::add);
  const GpuBuffer* buffers[] = {&buffer, &texels};
  std::vector<std::uint32_t> sums(count);
  const std::uint64_t start = context().traffic().submissions;
  Submission submission(context());
  for (const std::uint32_t number : {1U, 20U, 300U}) {
    const Push push{count, number};
    submission.run(pipeline, count, bytes_of(push), buffers);
  }
  submission.download(buffer, std::as_writable_bytes(std::span(sums)));
  submission.finish();
  EXPECT_EQ(context().traffic().submissions - start, 1U);
  for (std::uint32_t i = 0; i < count; ++i) EXPECT_EQ(sums[i], words[i] + 321);
}

TEST_F(GpuTest, EarlierCommandsSayHowManyGroupsRun) {
  constexpr std::uint32_t count = 1000;
  const auto texels = create_buffer(context(), BufferUse::uniform_texel, 0, "nothing");
  constexpr std::array<std::uint32_t, 4> two_groups{9, 2, 1, 1};
  auto pipeline = make_pipeline(context(), Mode::add);
  for (const std::uint32_t more : {0U, 3U}) {
    const auto groups = make_buffer(context(), BufferUse::storage, two_groups);
    const auto words = noise(count);
    const auto buffer = make_buffer(context(), BufferUse::storage, words);
    const GpuBuffer* number[] = {&groups, &texels};
    const GpuBuffer* buffers[] = {&buffer, &texels};
    auto counter = make_pipeline(context(), Mode::add);
    const Push add{2, more}, push{count, 42};
    Submission submission(context());
    submission.run(counter, 2, bytes_of(add), number);
    submission.run(pipeline, groups, 4, bytes_of(push), buffers);
    submission.finish();
    const std::uint32_t threads = (2 + more) * 64;
    const auto sums = read_words(context(), buffer);
    for (std::uint32_t i = 0; i < count; ++i) EXPECT_EQ(sums[i], words[i] + (i < threads ? 42 : 0)) << i;
  }
}

TEST_F(GpuTest, AFullStagingMemoryEndsASubmissionEarlyAndOtherBuffersOfAPipelineDoNot) {
  const auto words = noise(Staging::bytes / 4 + 3);
  const auto many = create_buffer(context(), BufferUse::storage, words.size() * 4, "many words");
  const auto one = create_buffer(context(), BufferUse::storage, 4, "one word");
  const auto texels = create_buffer(context(), BufferUse::uniform_texel, 0, "nothing");
  auto pipeline = make_pipeline(context(), Mode::add);
  const Push push{1, 1};
  std::vector<std::uint32_t> all(words.size());
  std::uint32_t sum = 0;
  const std::uint64_t start = context().traffic().submissions;
  Submission submission(context());
  submission.upload(many, std::as_bytes(std::span(words)));
  submission.fill(one, 0);
  for (const GpuBuffer* buffer : {&one, &many, &one}) {
    const GpuBuffer* buffers[] = {buffer, &texels};
    submission.run(pipeline, 1, bytes_of(push), buffers);
  }
  submission.download(one, writable_bytes_of(sum));
  submission.download(many, std::as_writable_bytes(std::span(all)));
  submission.finish();
  EXPECT_EQ(context().traffic().submissions - start, 3U);
  EXPECT_EQ(sum, 2U);
  EXPECT_EQ(all.front(), words.front() + 1);
  EXPECT_TRUE(std::equal(words.begin() + 1, words.end(), all.begin() + 1));
}

// Each of several dispatches side by side sees what came before them, and what comes after sees all of them.
TEST_F(GpuTest, CommandsSideBySideWaitForThoseBeforeAndBeforeThoseAfter) {
  constexpr std::uint32_t count = 1000;
  constexpr std::size_t sides = 5;
  const auto texels = create_buffer(context(), BufferUse::uniform_texel, 0, "nothing");
  const auto words = noise(count);
  auto pipeline = make_pipeline(context(), Mode::add);
  std::vector<GpuBuffer> buffers;
  for (std::size_t k = 0; k < sides; ++k) buffers.push_back(make_buffer(context(), BufferUse::storage, words));
  std::vector<std::vector<std::uint32_t>> sums(sides, std::vector<std::uint32_t>(count));
  const std::uint64_t start = context().traffic().submissions;
  Submission submission(context());
  for (const std::uint32_t number : {1U, 20U, 300U}) {
    const Submission::SideBySide side_by_side(submission);
    for (std::uint32_t k = 0; k < sides; ++k) {
      const Push push{count, (k + 1) * number};
      const GpuBuffer* bound[] = {&buffers[k], &texels};
      submission.run(pipeline, count, bytes_of(push), bound);
    }
  }
  for (std::size_t k = 0; k < sides; ++k) submission.download(buffers[k], std::as_writable_bytes(std::span(sums[k])));
  submission.finish();
  EXPECT_EQ(context().traffic().submissions - start, 1U);
  for (std::uint32_t k = 0; k < sides; ++k) {
    for (std::uint32_t i = 0; i < count; ++i) ASSERT_EQ(sums[k][i], words[i] + (k + 1) * 321);
  }
}

TEST_F(GpuTest, ASubmissionThatIsNotFinishedLeavesNothingBehind) {
  const auto buffer = make_buffer(context(), BufferUse::storage, noise(10));
  std::vector<std::uint32_t> untouched(10, 1);
  {
    Submission dropped(context());
    dropped.fill(buffer, 5);
    dropped.download(buffer, std::as_writable_bytes(std::span(untouched)));
  }
  EXPECT_EQ(untouched, std::vector<std::uint32_t>(10, 1));
  EXPECT_EQ(read_words(context(), buffer), noise(10));
}

TEST_F(GpuTest, SpecialisationConstantsReachTheShader) {
  const auto texels = create_buffer(context(), BufferUse::uniform_texel, 0, "nothing");
  const auto buffer = create_buffer(context(), BufferUse::storage, 10 * 4, "words");
  fill(context(), buffer, 5);
  auto pipeline = make_pipeline(context(), Mode::add, 3);
  run(pipeline, 10, {10, 7}, buffer, texels);
  EXPECT_EQ(read_words(context(), buffer), std::vector<std::uint32_t>(10, 5 + 3 * 7));
}

TEST_F(GpuTest, TexelFetchesKeepEveryBit) {
  // Read as floats, these are zeros, denormals, infinities, quiet and signalling NaNs of both signs, and the largest and
  // smallest numbers.
  std::vector<std::uint32_t> words = {0x00000000, 0x80000000, 0x00000001, 0x80000001, 0x007FFFFF, 0x807FFFFF,
                                      0x00400000, 0x7F800000, 0xFF800000, 0x7F800001, 0xFF800001, 0x7FBFFFFF,
                                      0x7FC00000, 0xFFC00000, 0x7FFFFFFF, 0xFFFFFFFF, 0x00800000, 0x7F7FFFFF};
  const auto more = noise(4096 - words.size());
  words.insert(words.end(), more.begin(), more.end());
  const auto texels = make_buffer(context(), BufferUse::uniform_texel, words);
  const auto buffer = create_buffer(context(), BufferUse::storage, words.size() * 4, "words");
  auto pipeline = make_pipeline(context(), Mode::fetch);
  run(pipeline, 1024, {1024, 0}, buffer, texels);
  EXPECT_EQ(read_words(context(), buffer), words);
}

TEST_F(GpuTest, RunRefusesWhatDoesNotFitTheShader) {
  const auto texels = create_buffer(context(), BufferUse::uniform_texel, 0, "nothing");
  const auto buffer = create_buffer(context(), BufferUse::storage, 64, "words");
  auto pipeline = make_pipeline(context(), Mode::add);
  EXPECT_EQ(pipeline.max_threads() % 64, 0u);
  EXPECT_GE(pipeline.max_threads(), 65535u * 64u);
  EXPECT_LE(pipeline.max_threads(), std::uint64_t{1} << 32);
  EXPECT_THROW(run(pipeline, pipeline.max_threads() + 1, {1, 1}, buffer, texels), std::logic_error);
  EXPECT_THROW(run(pipeline, 1, {1, 1}, texels, buffer), std::logic_error);
  const Push push{1, 1};
  const GpuBuffer* buffers[] = {&buffer, &texels};
  EXPECT_THROW(pipeline.run(1, {}, buffers), std::logic_error);
  EXPECT_THROW(pipeline.run(1, bytes_of(push), std::span(buffers).first(1)), std::logic_error);
}

TEST_F(GpuTest, OneRunReachesTheLastThreadOfTheLargestDispatch) {
  auto pipeline = make_pipeline(context(), Mode::add);
  const std::uint32_t threads = static_cast<std::uint32_t>(std::min<std::uint64_t>(pipeline.max_threads(), 65535u * 64u));
  const auto texels = create_buffer(context(), BufferUse::uniform_texel, 0, "nothing");
  const auto buffer = create_buffer(context(), BufferUse::storage, std::size_t{threads} * 4, "words");
  fill(context(), buffer, 0);
  run(pipeline, threads, {threads, 1}, buffer, texels);
  const auto words = read_words(context(), buffer);
  EXPECT_EQ(std::count(words.begin(), words.end(), 1u), threads);
}

TEST_F(GpuTest, BuffersInOnePieceOfMemoryDoNotOverlap) {
  const std::vector<std::size_t> bytes{4, 0, 400, 4096, 12};
  std::vector<GpuBuffer> buffers = create_storage_buffers(context(), bytes, "several");
  ASSERT_EQ(buffers.size(), bytes.size());
  std::vector<std::vector<std::uint32_t>> words;
  for (std::size_t k = 0; k < bytes.size(); ++k) {
    EXPECT_EQ(buffers[k].bytes, bytes[k]);
    words.push_back(noise(bytes[k] / 4));
    for (std::uint32_t& word : words.back()) word += static_cast<std::uint32_t>(k);
    upload(context(), buffers[k], std::as_bytes(std::span(words[k])));
  }
  buffers.erase(buffers.begin() + 3);  // the others keep the memory
  words.erase(words.begin() + 3);
  for (std::size_t k = 0; k < buffers.size(); ++k) {
    std::vector<std::uint32_t> found(words[k].size());
    download(context(), buffers[k], std::as_writable_bytes(std::span(found)));
    EXPECT_EQ(found, words[k]) << k;
  }
  EXPECT_TRUE(create_storage_buffers(context(), {}, "none").empty());
  const std::vector<std::size_t> too_large{4, context().limits().max_storage_buffer_bytes + 1};
  EXPECT_THROW((void)create_storage_buffers(context(), too_large, "too large"), Error);
}

TEST_F(GpuTest, BuffersAboveTheLimitsAreRefusedByName) {
  const auto storage = [&] {
    static_cast<void>(create_buffer(context(), BufferUse::storage, context().limits().max_storage_buffer_bytes + 1, "big"));
  };
  const auto texel = [&] {
    const auto bytes = (context().limits().max_texel_buffer_elements + 1) * 16;
    static_cast<void>(create_buffer(context(), BufferUse::uniform_texel, bytes, "big"));
  };
  const std::string storage_line = device_error(storage);
  EXPECT_NE(storage_line.find("big: "), std::string::npos) << storage_line;
  EXPECT_NE(storage_line.find("maxStorageBufferRange"), std::string::npos) << storage_line;
  EXPECT_NE(device_error(texel).find("maxTexelBufferElements"), std::string::npos);
}

TEST_F(GpuTest, DevicesAreFoundByNumberNameAndKind) {
  const auto devices = list_devices();
  for (std::size_t i = 0; i < devices.size(); ++i) {
    if (!devices[i].unusable.empty()) continue;
    const GpuContext by_number({DeviceSelector::Kind::index, static_cast<int>(i), ""}, Validation::off);
    EXPECT_EQ(by_number.description().name, devices[i].name);
    std::string part = devices[i].name.substr(0, 4);
    std::transform(part.begin(), part.end(), part.begin(), [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    const GpuContext by_name({DeviceSelector::Kind::name, 0, part}, Validation::off);
    EXPECT_EQ(by_name.description().name.substr(0, 4), devices[i].name.substr(0, 4));
    if (devices[i].name.find("llvmpipe") != std::string::npos) {
      EXPECT_TRUE(GpuContext({DeviceSelector::Kind::name, 0, "Lavapipe"}, Validation::off).description().software);
    }
  }
  const GpuContext any({}, Validation::off);
  const bool hardware =
      std::any_of(devices.begin(), devices.end(), [](const auto& d) { return !d.software && d.unusable.empty(); });
  EXPECT_EQ(any.description().software, !hardware);
}

TEST_F(GpuTest, SelectorsThatNothingFitsListTheDevices) {
  const auto devices = list_devices();
  const auto count = static_cast<int>(devices.size());
  for (const std::string& line : {device_error([&] { open_device(DeviceSelector::Kind::index, count, ""); }),
                                  device_error([&] { open_device(DeviceSelector::Kind::index, -1, ""); }),
                                  device_error([&] { open_device(DeviceSelector::Kind::name, 0, "no such device"); })}) {
    for (const auto& device : devices) EXPECT_NE(line.find(device.name), std::string::npos) << line;
  }
  const bool all_software = std::all_of(devices.begin(), devices.end(), [](const auto& device) { return device.software; });
  if (all_software) device_error([&] { open_device(DeviceSelector::Kind::hardware, 0, ""); });
}

TEST(Turns, GoRoundTheBest) {
  const std::vector<std::optional<int>> values{4, 0, std::nullopt, 1, 0, 0};
  std::vector<std::size_t> taken;
  for (int turn = 0; turn < 7; ++turn) taken.push_back(smallest_in_turn(values, turn).value());
  EXPECT_EQ(taken, (std::vector<std::size_t>{1, 4, 5, 1, 4, 5, 1}));
  EXPECT_EQ(smallest_in_turn(std::vector<std::optional<int>>{std::nullopt, 7}, 3), 1U);
  EXPECT_EQ(smallest_in_turn(std::vector<std::optional<int>>{std::nullopt}, 0), std::nullopt);
  EXPECT_EQ(smallest_in_turn({}, 2), std::nullopt);
}

TEST_F(GpuTest, ValidationTellsOfMisuse) {
  if (!validation_installed()) GTEST_SKIP() << "no validation layer on this machine";
  const GpuContext own({}, Validation::on);
  static_cast<void>(own.handles().device.createBuffer({{}, 0, vk::BufferUsageFlagBits::eStorageBuffer}));
  ASSERT_FALSE(own.validation_messages().empty());
  EXPECT_NE(own.validation_messages().front().find("VUID-VkBufferCreateInfo-size"), std::string::npos);
}

TEST_F(GpuTest, ThoroughValidationSeesWritesPastTheEnd) {
  if (!validation_installed()) GTEST_SKIP() << "no validation layer on this machine";
  const GpuContext own({}, Validation::thorough);
  const auto texels = create_buffer(own, BufferUse::uniform_texel, 0, "nothing");
  const auto buffer = create_buffer(own, BufferUse::storage, 64 * 4, "words");
  auto inside = make_pipeline(own, Mode::add);
  run(inside, 64, {64, 1}, buffer, texels);
  EXPECT_EQ(own.validation_messages(), std::vector<std::string>{});
  auto outside = make_pipeline(own, Mode::write_past_end);
  run(outside, 1, {1, 64}, buffer, texels);
  EXPECT_FALSE(own.validation_messages().empty());
}

// The loader reads the variable whenever an instance is created, so a driver list without entries acts like a machine without
// Vulkan.
TEST(GpuWithoutDriver, IsAnEmptyListAndADeviceError) {
  const char* variables[] = {"VK_ICD_FILENAMES", "VK_DRIVER_FILES"};
  std::vector<std::pair<const char*, std::string>> before;
  for (const char* variable : variables) {
    const char* value = std::getenv(variable);
    before.emplace_back(variable, value == nullptr ? "" : value);
    setenv(variable, "/no/such/driver.json", 1);
  }
  EXPECT_TRUE(list_devices().empty());
  const std::string line = device_error([] { open_device(DeviceSelector::Kind::any, 0, ""); });
  EXPECT_NE(line.find("Vulkan device"), std::string::npos);
  for (const auto& [variable, value] : before) value.empty() ? unsetenv(variable) : setenv(variable, value.c_str(), 1);
}

TEST(SoftwareThreads, AreSetForTheDriver) {
  set_software_threads(3);
  EXPECT_STREQ(std::getenv("LP_NUM_THREADS"), "3");
  set_software_threads(0);
  EXPECT_EQ(std::getenv("LP_NUM_THREADS"), nullptr);
}

}  // namespace
}  // namespace sunfleck
