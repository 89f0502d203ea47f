#include "simulate/cluster/mpi_job.h"

#include "base/error.h"
#include "base/rounding.h"

#include <fmt/format.h>
#include <mpi.h>
#include <sched.h>
#include <unistd.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <limits>
#include <list>
#include <vector>

namespace sunfleck {
namespace {

constexpr const char* resume_cure = "see the messages of the launcher; --resume continues a run or day that had begun";

void check(int code, const char* call) {
  if (code == MPI_SUCCESS) return;
  std::array<char, MPI_MAX_ERROR_STRING> text{};
  int length = 0;
  MPI_Error_string(code, text.data(), &length);
  throw_failure(call, std::string(text.data(), static_cast<std::size_t>(length)), resume_cure);
}

// Sends letters as 64-bit words, of which MPI counts up to 2^31: first the number of bytes, then the bytes.
class MpiMailbox final : public Mailbox {
 public:
  MpiMailbox(MPI_Comm world, int ranks) : world_(world), ranks_(ranks) {}

  [[nodiscard]] int ranks() const override { return ranks_; }

  void post(int to, LetterKind kind, std::vector<std::byte> content) override {
    const std::size_t words = 1 + block_count(content.size(), sizeof(std::uint64_t));
    if (words > static_cast<std::size_t>(std::numeric_limits<int>::max())) {
      throw_failure("a replicate's message", fmt::format("{} bytes are more than MPI sends in one message", content.size()),
                    "run on one machine");
    }
    Outgoing& letter = outgoing_.emplace_back();
    letter.words.resize(words);
    letter.words.front() = content.size();
    if (!content.empty()) std::memcpy(letter.words.data() + 1, content.data(), content.size());
    check(MPI_Isend(letter.words.data(), static_cast<int>(words), MPI_UINT64_T, to, static_cast<int>(kind), world_,
                    &letter.request),
          "MPI_Isend");
  }

  [[nodiscard]] std::optional<Letter> take() override {
    forget_sent();
    int is_there = 0;
    MPI_Message message = MPI_MESSAGE_NULL;
    MPI_Status status;
    check(MPI_Improbe(MPI_ANY_SOURCE, MPI_ANY_TAG, world_, &is_there, &message, &status), "MPI_Improbe");
    if (is_there == 0) return std::nullopt;
    int count = 0;
    check(MPI_Get_count(&status, MPI_UINT64_T, &count), "MPI_Get_count");
    std::vector<std::uint64_t> words(static_cast<std::size_t>(count));
    check(MPI_Mrecv(words.data(), count, MPI_UINT64_T, &message, MPI_STATUS_IGNORE), "MPI_Mrecv");
    if (words.empty() || words.front() > (words.size() - 1) * sizeof(std::uint64_t)) {
      throw_failure("a message between ranks", "it is truncated", resume_cure);
    }
    Letter letter{status.MPI_SOURCE, static_cast<LetterKind>(status.MPI_TAG), std::vector<std::byte>(words.front())};
    if (!letter.content.empty()) std::memcpy(letter.content.data(), words.data() + 1, letter.content.size());
    return letter;
  }

  [[nodiscard]] bool all_posted() override {
    forget_sent();
    return outgoing_.empty();
  }

 private:
  struct Outgoing {
    std::vector<std::uint64_t> words;
    MPI_Request request = MPI_REQUEST_NULL;
  };

  void forget_sent() {
    for (auto letter = outgoing_.begin(); letter != outgoing_.end();) {
      int sent = 0;
      check(MPI_Test(&letter->request, &sent, MPI_STATUS_IGNORE), "MPI_Test");
      letter = sent != 0 ? outgoing_.erase(letter) : std::next(letter);
    }
  }

  MPI_Comm world_;
  int ranks_;
  std::list<Outgoing> outgoing_;
};

std::string host_name() {
  std::array<char, 256> name{};
  if (::gethostname(name.data(), name.size() - 1) != 0) return "an unnamed machine";
  return name.data();
}

cpu_set_t cores_of(pid_t process) {
  cpu_set_t cores;
  CPU_ZERO(&cores);
  if (::sched_getaffinity(process, sizeof cores, &cores) != 0) CPU_ZERO(&cores);
  return cores;
}

// Computes the process's share of the machine's cores: cores that several ranks may use are shared, all others are its own.
void share_cores(MPI_Comm local, Seat& seat) {
  int ranks = 1;
  check(MPI_Comm_size(local, &ranks), "MPI_Comm_size");
  const cpu_set_t own = cores_of(0);
  std::vector<cpu_set_t> all(static_cast<std::size_t>(ranks));
  check(MPI_Allgather(&own, sizeof own, MPI_BYTE, all.data(), sizeof own, MPI_BYTE, local), "MPI_Allgather");
  int sharing = 0;
  cpu_set_t together;
  CPU_ZERO(&together);
  for (cpu_set_t& cores : all) {
    cpu_set_t common;
    CPU_AND(&common, &own, &cores);
    if (CPU_COUNT(&common) > 0) ++sharing;
    CPU_OR(&together, &together, &cores);
  }
  seat.threads = std::max(1, CPU_COUNT(&own) / std::max(1, sharing));
  // The launcher itself may use all cores of the job.
  const cpu_set_t launcher = cores_of(::getppid());
  if (CPU_COUNT(&together) >= CPU_COUNT(&launcher)) return;
  seat.hint = fmt::format("the {} ranks on {} are bound to {} of its {} cores: mpirun --bind-to none lets them use all", ranks,
                          seat.host, CPU_COUNT(&together), CPU_COUNT(&launcher));
}

class MpiJob final : public Job {
 public:
  MpiJob() {
    int threads = MPI_THREAD_SINGLE;
    check(MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &threads), "MPI_Init_thread");
    check(MPI_Comm_dup(MPI_COMM_WORLD, &world_), "MPI_Comm_dup");
    MPI_Comm_set_errhandler(world_, MPI_ERRORS_RETURN);
    check(MPI_Comm_rank(world_, &seat_.rank), "MPI_Comm_rank");
    check(MPI_Comm_size(world_, &seat_.ranks), "MPI_Comm_size");
    if (threads < MPI_THREAD_FUNNELED) {
      throw_failure("MPI", "this library does not support programs with threads", "use another build of it");
    }
    MPI_Comm local = MPI_COMM_NULL;
    check(MPI_Comm_split_type(world_, MPI_COMM_TYPE_SHARED, seat_.rank, MPI_INFO_NULL, &local), "MPI_Comm_split_type");
    check(MPI_Comm_rank(local, &seat_.local_rank), "MPI_Comm_rank");
    seat_.host = host_name();
    share_cores(local, seat_);
    MPI_Comm_free(&local);
    mailbox_ = std::make_unique<MpiMailbox>(world_, seat_.ranks);
  }

  [[nodiscard]] const Seat& seat() const override { return seat_; }
  [[nodiscard]] Mailbox& mailbox() override { return *mailbox_; }
  void finish() override {
    MPI_Comm_free(&world_);
    MPI_Finalize();
  }

 private:
  MPI_Comm world_ = MPI_COMM_NULL;
  Seat seat_;
  std::unique_ptr<MpiMailbox> mailbox_;
};

}  // namespace

std::unique_ptr<Job> join_mpi_job(const Launch& launch) {
  auto job = std::make_unique<MpiJob>();
  if (job->seat().ranks > 1) return job;
  job->finish();
  if (!launch.ranks) return nullptr;
  throw_input(
      fmt::format("{} processes started by MPI", *launch.ranks),
      "this program's MPI library sees only one: another MPI started them",
      "use the mpirun of this program's library (Slurm: srun --mpi=pmix), or set SUNFLECK_MPI=off for independent runs");
}

}  // namespace sunfleck
