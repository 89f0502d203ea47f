#include "files/results/stores/run_store.h"

#include "base/error.h"
#include "base/file.h"
#include "base/sealed_file.h"
#include "support/error_text.h"
#include "support/solve_states.h"
#include "support/temp_folder.h"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

namespace sunfleck {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

const ordered_json run_settings{{"scene_digest", "0123"}, {"seed", 1}, {"grid_m", nullptr}};

SolveState some_state() {
  SolveState state;
  state.work = {1e6 / 7.0, 4096.0};
  state.ray_shares = {1.0, 1.0 / 3.0};
  state.next_check = 16;
  state.sums.integers = {13, std::numeric_limits<std::int64_t>::min(), -1, 0, std::numeric_limits<std::int64_t>::max()};
  state.sums.reals = {1.0 / 3.0, -0.0, std::numeric_limits<double>::quiet_NaN(), 1e-300};
  return state;
}

StateShape shape_of(const SolveState& state) {
  return {state.ray_shares.size(), state.sums.integers.size(), state.sums.reals.size(), 1.0};
}

class RunStoreTest : public ::testing::Test {
 protected:
  // Returns the message that rejects the state, or an empty text if it is accepted.
  [[nodiscard]] std::string refusal(const ordered_json& now = run_settings) const {
    return message_of([&] { static_cast<void>(RunStore(folder_.path(), now).read(shape_)); }).value_or("");
  }
  [[nodiscard]] std::string bytes() const { return read_file(folder_ / run_state_file); }

  const SolveState state_ = some_state();
  const StateShape shape_ = shape_of(state_);
  TempFolder folder_;
  RunStore store_{folder_.path(), run_settings};
};

TEST_F(RunStoreTest, GivesBackWhatWasWritten) {
  EXPECT_FALSE(store_.read(shape_));
  store_.write(test::view_of(state_));
  const std::optional<SolveState> read = store_.read(shape_);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->work.rays, state_.work.rays);
  EXPECT_EQ(read->work.packets, state_.work.packets);
  EXPECT_EQ(read->ray_shares, state_.ray_shares);
  EXPECT_EQ(read->next_check, 16U);
  EXPECT_EQ(read->sums.integers, state_.sums.integers);
  ASSERT_EQ(read->sums.reals.size(), state_.sums.reals.size());
  EXPECT_EQ(std::memcmp(read->sums.reals.data(), state_.sums.reals.data(), sizeof(double) * state_.sums.reals.size()), 0);
  store_.remove();
  EXPECT_FALSE(store_.read(shape_));
  store_.remove();
}

TEST_F(RunStoreTest, ReadsNoStateThatIsDamaged) {
  store_.write(test::view_of(state_));
  const std::string good = bytes();
  for (std::size_t length = 0; length < good.size(); ++length) {
    folder_.write(run_state_file, good.substr(0, length));
    EXPECT_NE(refusal().find("it is damaged"), std::string::npos) << length << " bytes of " << good.size();
  }
  for (std::size_t at = 0; at < good.size(); ++at) {
    std::string bad = good;
    bad[at] = static_cast<char>(bad[at] ^ (1 << (at % 8)));
    folder_.write(run_state_file, bad);
    EXPECT_NE(refusal().find("it is damaged"), std::string::npos) << "byte " << at;
  }
  for (const std::string& bad : {std::string(100000, '\x81'), std::string("SUNSTEP3") + good.substr(8)}) {
    folder_.write(run_state_file, bad);
    EXPECT_NE(refusal().find("it is damaged"), std::string::npos);
  }
  folder_.write(run_state_file, good);
  EXPECT_EQ(refusal(), "");
}

TEST_F(RunStoreTest, ReadsNoStateOfAnotherVersion) {
  store_.write(test::view_of(state_));
  folder_.write(run_state_file, "SUNRUNS1" + bytes().substr(8));
  const std::string message = refusal();
  expect_three_parts(message);
  EXPECT_NE(message.find("another version of the program wrote it"), std::string::npos) << message;
}

// The checksum is right, but this program writes other maps.
TEST_F(RunStoreTest, ReadsNoStateOfAnotherForm) {
  store_.write(test::view_of(state_));
  const json good = *unsealed("SUNRUNSA", bytes());
  const auto expect_refused = [&](const json& content) {
    std::ostringstream bytes;
    seal(bytes, "SUNRUNSA", content);
    folder_.write(run_state_file, bytes.str());
    EXPECT_NE(refusal().find("it is damaged"), std::string::npos)
        << content.dump(-1, ' ', true, json::error_handler_t::replace);
  };
  for (const auto& [key, value] : good.items()) {
    json bad = good;
    bad.erase(key);
    expect_refused(bad);
    for (const json& other : {json(-1), json(1e300), json("text"), json::array(), json(nullptr), json(1ULL << 63U),
                              json::binary({1, 2, 3}), json({{"a", 1}})}) {
      if ((key == "rays" || key == "packets") && other.is_number()) continue;
      if (key == "ray_shares" && other.is_array()) continue;
      bad = good;
      bad[key] = other;
      expect_refused(bad);
    }
  }
  expect_refused(json::array());
  expect_refused(json(1));
}

// Ten million times the file's content is neither reserved nor read.
TEST_F(RunStoreTest, ReadsNoStateOfAnotherSize) {
  store_.write(test::view_of(state_));
  StateShape other = shape_;
  other.integers = 6;
  EXPECT_THROW(static_cast<void>(store_.read(other)), Error);
  other = shape_;
  other.reals = 3;
  EXPECT_THROW(static_cast<void>(store_.read(other)), Error);
}

TEST_F(RunStoreTest, NamesTheFirstSettingThatDiffers) {
  store_.write(test::view_of(state_));
  ordered_json other = run_settings;
  other["seed"] = 2;
  EXPECT_NE(refusal(other).find("that run has other settings: seed was 1, now 2"), std::string::npos) << refusal(other);
  other = run_settings;
  other["grid_m"] = 0.01;
  EXPECT_NE(refusal(other).find("grid_m was null, now 0.01"), std::string::npos);
  other = run_settings;
  other.erase("scene_digest");
  EXPECT_NE(refusal(other).find("the scene, or a file that it names, has changed since that run"), std::string::npos);
}

TEST_F(RunStoreTest, FailsInOneLineWhereNothingCanBeWritten) {
  const RunStore nowhere(folder_ / "absent", run_settings);
  EXPECT_THROW(nowhere.write(test::view_of(state_)), Error);
}

}  // namespace
}  // namespace sunfleck
