// Runs ranks as threads of one process: they exchange the same letters as the processes of a job, without MPI.

#include "base/error.h"
#include "physics/transport/indirect/replicate_maker.h"
#include "simulate/cluster/rank_helpers.h"
#include "simulate/cluster/rank_worker.h"
#include "simulate/cluster/replicate_message.h"
#include "support/error_text.h"
#include "support/light_mix.h"
#include "support/result_numbers.h"

#include <gtest/gtest.h>

#include <atomic>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>

namespace sunfleck {
namespace {

using namespace std::chrono_literals;

// Letters on their way, [to].
class Post {
 public:
  explicit Post(int ranks) : boxes_(static_cast<std::size_t>(ranks)) {}

  void bring(int to, Letter letter) {
    const std::lock_guard lock(mutex_);
    boxes_.at(static_cast<std::size_t>(to)).push_back(std::move(letter));
  }
  std::optional<Letter> fetch(int to) {
    const std::lock_guard lock(mutex_);
    std::deque<Letter>& box = boxes_.at(static_cast<std::size_t>(to));
    if (box.empty()) return std::nullopt;
    Letter letter = std::move(box.front());
    box.pop_front();
    return letter;
  }
  [[nodiscard]] int ranks() const { return static_cast<int>(boxes_.size()); }

 private:
  std::mutex mutex_;
  std::vector<std::deque<Letter>> boxes_;
};

class LocalMailbox final : public Mailbox {
 public:
  LocalMailbox(Post& post, int rank) : post_(post), rank_(rank) {}
  [[nodiscard]] int ranks() const override { return post_.ranks(); }
  void post(int to, LetterKind kind, std::vector<std::byte> content) override {
    post_.bring(to, {rank_, kind, std::move(content)});
  }
  [[nodiscard]] std::optional<Letter> take() override { return post_.fetch(rank_); }
  [[nodiscard]] bool all_posted() override { return true; }

 private:
  Post& post_;
  int rank_;
};

class RanksTest : public ::testing::Test {
 protected:
  using Make = std::function<std::optional<ReplicateSet>(ReplicateMaker&, const ReplicateOrder&, const Conversion&,
                                                         const StopQuestion&)>;

  // Starts a worker with this rank; `make` may replace its way of making replicates.
  void start(int rank, const Make& make, const StopQuestion& interrupted = {}) {
    threads_.emplace_back([this, rank, make, interrupted] {
      LocalMailbox mailbox(post_, rank);
      CpuTracer tracer(prepared_.bvh, test::tracer_scene(model_));
      ReplicateMaker maker(model_, prepared_.layout, tracer);
      RankService service;
      service.slots = 2;
      service.host = "here";
      service.scene = "the scene";
      service.set_stage = [this](std::uint64_t stage) { stages_ |= std::uint64_t{1} << stage; };
      service.make = [&](const ReplicateOrder& order, const StopQuestion& stop) {
        ++made_;
        const Conversion conversion = maker.conversion(maker.incidence(order.beam_rays, order.aimed));
        return make(maker, order, conversion, stop);
      };
      service.interrupted = interrupted;
      EXPECT_TRUE(serve(mailbox, service));
    });
  }
  void start_all(const Make& make = usual_) {
    for (int rank = 1; rank < post_.ranks(); ++rank) start(rank, make);
    helpers_ = std::make_unique<RankHelpers>(lead_, 60s);
    helpers_->wait_until_ready("the scene");
  }

  RadiationResult solve_alone() { return solve(model_, prepared_.layout, tracer_, settings_, {}); }
  RadiationResult solve_with_helpers(const Monitor& monitor = {}) {
    return solve(model_, prepared_.layout, tracer_, settings_, monitor, helpers_.get());
  }
  // Asks for so many replicates that only a signal ends the run, and for no pilots.
  void make_endless() {
    settings_.passes = 60000;
    settings_.grid_m = 1e-3;
    settings_.packets = 4000.0;
  }
  void end() {
    EXPECT_TRUE(helpers_->wait_until_gone());
    for (std::thread& thread : threads_) thread.join();
    threads_.clear();
  }
  ~RanksTest() override {
    if (!threads_.empty()) end();
  }

  static constexpr auto usual_ = [](ReplicateMaker& maker, const ReplicateOrder& order, const Conversion& conversion,
                                    const StopQuestion& stop) {
    return maker.make(order, {&conversion, 1}, stop);
  };

  RadiationModel model_ = test::light_mix();
  test::Prepared prepared_{model_};
  CpuTracer tracer_{prepared_.bvh, test::tracer_scene(model_)};
  SolveSettings settings_ = test::to_a_wide_bound();
  Post post_{3};
  LocalMailbox lead_{post_, 0};
  std::unique_ptr<RankHelpers> helpers_;
  std::vector<std::thread> threads_;
  std::atomic<int> made_ = 0;
  std::atomic<std::uint64_t> stages_ = 0;
};

TEST_F(RanksTest, ChangeNoNumber) {
  const auto alone = test::all_numbers(solve_alone());
  start_all();
  EXPECT_EQ(helpers_->slots(), 4U);
  for (const int at_once : {1, 2}) {
    settings_.replicates_at_once = at_once;
    EXPECT_TRUE(test::all_numbers(solve_with_helpers()) == alone);
    EXPECT_EQ(helpers_->slots(), 2U * static_cast<std::size_t>(at_once))
        << "no helper makes more at once than the memory allows";
  }
  EXPECT_GT(made_, 20) << "the helpers did their part";
}

TEST_F(RanksTest, ChangeNoNumberOfFixedWorkNorOfSeveralStages) {
  settings_.passes = 11;
  settings_.grid_m = 0.02;
  const auto alone = test::all_numbers(solve_alone());
  start_all();
  for (const std::uint64_t stage : {0, 3, 5}) {
    helpers_->set_stage(stage);
    EXPECT_TRUE(test::all_numbers(solve_with_helpers()) == alone);
  }
  EXPECT_EQ(stages_, 0b101001U);
}

TEST_F(RanksTest, MayBeSlowAndOutOfTurn) {
  const auto alone = test::all_numbers(solve_alone());
  start_all([](ReplicateMaker& maker, const ReplicateOrder& order, const Conversion& conversion, const StopQuestion& stop) {
    std::this_thread::sleep_for(std::chrono::milliseconds(order.number % 3 * 10));
    return maker.make(order, {&conversion, 1}, stop);
  });
  EXPECT_TRUE(test::all_numbers(solve_with_helpers()) == alone);
}

// Replicates begun beyond the run's end are not waited for.
TEST_F(RanksTest, DropWhatIsNotNeeded) {
  const std::size_t needed = solve_alone().direct.replicates;
  start_all([needed](ReplicateMaker& maker, const ReplicateOrder& order, const Conversion& conversion,
                     const StopQuestion& stop) -> std::optional<ReplicateSet> {
    if (order.number < most_replicates && order.number >= needed) {  // excludes the pilot's replicates
      while (!stop()) std::this_thread::sleep_for(1ms);
      return std::nullopt;
    }
    return maker.make(order, {&conversion, 1}, stop);
  });
  EXPECT_EQ(solve_with_helpers().direct.replicates, needed);
  EXPECT_EQ(solve_with_helpers().direct.replicates, needed);
}

TEST_F(RanksTest, StopWhenAskedTo) {
  start_all();
  make_endless();
  std::atomic<int> reports = 0;
  Monitor monitor;
  monitor.report = [&](const Progress&) { ++reports; };
  monitor.interrupted = [&] { return reports > 2; };
  EXPECT_EQ(solve_with_helpers(monitor).stop, StopReason::interrupted);
}

TEST_F(RanksTest, TellOfASignal) {
  std::atomic<bool> signal = false;
  start(1, usual_, [&] { return signal.load(); });
  start(2, usual_);
  helpers_ = std::make_unique<RankHelpers>(lead_, 60s);
  helpers_->wait_until_ready("the scene");
  make_endless();
  Monitor monitor;
  monitor.report = [&](const Progress&) { signal = true; };
  monitor.interrupted = [&] { return helpers_->interrupted(); };
  EXPECT_EQ(solve_with_helpers(monitor).stop, StopReason::interrupted);
  EXPECT_TRUE(helpers_->interrupted());
}

TEST_F(RanksTest, ThatFailEndTheRun) {
  start_all([](ReplicateMaker&, const ReplicateOrder&, const Conversion&, const StopQuestion&) -> std::optional<ReplicateSet> {
    throw_device("its card", "gone", "get another");
  });
  const std::string message = refusal_of([this] { static_cast<void>(solve_with_helpers()); }, ErrorKind::device);
  EXPECT_NE(message.find("on here: its card (gone); get another"), std::string::npos) << message;
  EXPECT_EQ(message.find("rank "), 0U);
}

TEST_F(RanksTest, ThatCannotBeginEndTheRun) {
  start(1, usual_);
  threads_.emplace_back([this] {
    LocalMailbox mailbox(post_, 2);
    EXPECT_TRUE(report_failure(mailbox, "there", 2, "a.toml (missing); give another"));
  });
  helpers_ = std::make_unique<RankHelpers>(lead_, 60s);
  EXPECT_EQ(refusal_of([this] { helpers_->wait_until_ready("the scene"); }), "rank 2 on there: a.toml (missing); give another");
}

TEST_F(RanksTest, WithAnotherSceneAreRefused) {
  start(1, usual_);
  start(2, usual_);
  helpers_ = std::make_unique<RankHelpers>(lead_, 60s);
  EXPECT_NE(refusal_of([this] {
              helpers_->wait_until_ready("another");
            }).find("rank 1 on here (it was given the scene, rank 0 has another); "),
            std::string::npos);
}

TEST_F(RanksTest, ThatFallSilentAreLost) {
  for (const int rank : {1, 2}) {
    LocalMailbox(post_, rank).post(0, LetterKind::ready, pack(ReadyMessage{1, "nowhere", "the scene"}));
  }
  helpers_ = std::make_unique<RankHelpers>(lead_, 100ms);
  helpers_->wait_until_ready("the scene");
  expect_refusal([this] { static_cast<void>(solve_with_helpers()); }, " on nowhere (nothing heard from it for 0",
                 ErrorKind::failure);
  EXPECT_FALSE(helpers_->wait_until_gone());
}

TEST_F(RanksTest, ThatLeaveEarlyAreMissed) {
  LocalMailbox(post_, 1).post(0, LetterKind::ready, pack(ReadyMessage{1, "x", "the scene"}));
  LocalMailbox(post_, 2).post(0, LetterKind::ready, pack(ReadyMessage{1, "y", "the scene"}));
  helpers_ = std::make_unique<RankHelpers>(lead_, 60s);
  helpers_->wait_until_ready("the scene");
  for (const int rank : {1, 2}) LocalMailbox(post_, rank).post(0, LetterKind::gone, {});
  EXPECT_NE(refusal_of([this] { static_cast<void>(solve_with_helpers()); }, ErrorKind::failure).find("ended early"),
            std::string::npos);
}

TEST_F(RanksTest, LeaveARankZeroThatFellSilent) {
  LocalMailbox mailbox(post_, 1);
  RankService service;
  service.longest_silence = 50ms;
  EXPECT_FALSE(serve(mailbox, service));
}

}  // namespace
}  // namespace sunfleck
