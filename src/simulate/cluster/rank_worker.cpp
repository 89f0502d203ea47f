#include "simulate/cluster/rank_worker.h"

#include "base/error.h"
#include "base/pause.h"
#include "simulate/cluster/replicate_message.h"

#include <algorithm>
#include <atomic>
#include <deque>
#include <exception>
#include <future>
#include <list>
#include <memory>

namespace sunfleck {
namespace {

using namespace std::chrono_literals;

using Clock = std::chrono::steady_clock;

class Worker {
 public:
  Worker(Mailbox& mailbox, const RankService& service) : mailbox_(mailbox), service_(service) {}
  ~Worker() {
    for (const Making& making : making_) *making.dropped = true;
  }
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  bool serve() {
    mailbox_.post(0, LetterKind::ready, pack(ReadyMessage{service_.slots, service_.host, service_.scene}));
    return work();
  }

  bool report(const FailedMessage& failed) {
    broken_ = true;
    mailbox_.post(0, LetterKind::failed, pack(failed));
    return work();
  }

 private:
  struct Making {
    ReplicateKey key;
    std::shared_ptr<std::atomic<bool>> dropped;
    std::future<std::optional<ReplicateSet>> result;
  };

  bool work() {
    Pause pause;
    while (!ended_ || !making_.empty() || !mailbox_.all_posted()) {
      const bool busy = hear() + begin_orders() + answer() > 0;
      tell_of_itself();
      if (silence_ > service_.longest_silence && !ended_) return false;
      if (busy) {
        pause.restart();
      } else {
        pause.take();
      }
    }
    mailbox_.post(0, LetterKind::gone, {});
    while (!mailbox_.all_posted()) pause.take();
    return true;
  }

  // Reads all letters that have arrived and returns their number.
  int hear() {
    const Clock::time_point now = Clock::now();
    silence_ += std::min<Clock::duration>(now - heard_, longest_step);
    heard_ = now;
    int letters = 0;
    for (; std::optional<Letter> letter = mailbox_.take(); ++letters) {
      silence_ = {};
      if (letter->kind == LetterKind::order) orders_.push_back(unpack<OrderMessage>(letter->content));
      if (letter->kind == LetterKind::drop) drop();
      if (letter->kind == LetterKind::end) {
        ended_ = true;
        drop();
      }
    }
    return letters;
  }

  void drop() {
    for (const OrderMessage& order : orders_) mailbox_.post(0, LetterKind::dropped, pack(order.key));
    orders_.clear();
    for (const Making& making : making_) *making.dropped = true;
  }

  int begin_orders() {
    int begun = 0;
    while (!orders_.empty() && !broken_ && making_.size() < service_.slots) {
      const OrderMessage& message = orders_.front();
      if (message.stage != stage_) {
        if (!making_.empty()) return begun;
        if (!guarded([&] { service_.set_stage(message.stage); })) return begun;
        stage_ = message.stage;
      }
      auto dropped = std::make_shared<std::atomic<bool>>(false);
      const auto make = [this, order = message.order, dropped] {
        return service_.make(order, [dropped] { return bool{*dropped}; });
      };
      if (!guarded([&] { making_.push_back({message.key, dropped, std::async(std::launch::async, make)}); })) return begun;
      orders_.pop_front();
      ++begun;
    }
    return begun;
  }

  int answer() {
    int answered = 0;
    for (auto making = making_.begin(); making != making_.end();) {
      if (making->result.wait_for(0s) != std::future_status::ready) {
        ++making;
        continue;
      }
      std::optional<ReplicateSet> made;
      guarded([&] { made = making->result.get(); });
      if (made && !*making->dropped) {
        mailbox_.post(0, LetterKind::made, pack(making->key, *made));
      } else {
        mailbox_.post(0, LetterKind::dropped, pack(making->key));
      }
      making = making_.erase(making);
      ++answered;
    }
    return answered;
  }

  void tell_of_itself() {
    if (!told_interrupted_ && service_.interrupted && service_.interrupted()) {
      told_interrupted_ = true;
      mailbox_.post(0, LetterKind::interrupted, {});
    }
    if (Clock::now() - told_ < alive_pause) return;
    told_ = Clock::now();
    mailbox_.post(0, LetterKind::alive, {});
  }

  // Runs the task. If it fails, reports that to rank 0 and returns false.
  template <class Task>
  bool guarded(const Task& task) {
    try {
      task();
      return true;
    } catch (const Error& error) {
      fail(static_cast<int>(error.kind()), error.what());
    } catch (const std::exception& error) {
      fail(static_cast<int>(ErrorKind::failure), error.what());
    }
    return false;
  }

  void fail(int kind, const std::string& text) {
    if (!broken_) mailbox_.post(0, LetterKind::failed, pack(FailedMessage{kind, service_.host, text}));
    broken_ = true;
  }

  Mailbox& mailbox_;
  const RankService& service_;
  std::deque<OrderMessage> orders_;
  std::list<Making> making_;
  std::optional<std::uint64_t> stage_;
  bool ended_ = false, broken_ = false, told_interrupted_ = false;
  Clock::time_point heard_ = Clock::now(), told_ = heard_;
  Clock::duration silence_{};
};

}  // namespace

bool serve(Mailbox& mailbox, const RankService& service) {
  return Worker(mailbox, service).serve();
}

bool report_failure(Mailbox& mailbox, const std::string& host, int kind, const std::string& text) {
  const RankService none{.host = host};
  return Worker(mailbox, none).report({kind, host, text});
}

}  // namespace sunfleck
