#include "simulate/cluster/launch.h"

#include "simulate/cluster/job.h"
#include "simulate/cluster/no_job.h"
#include "support/error_text.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <map>
#include <string>

namespace sunfleck {
namespace {

using Variables = std::map<std::string, std::string>;

std::optional<Launch> launch(const Variables& variables) {
  return launch_by_mpi([&](const char* name) {
    const auto found = variables.find(name);
    return found == variables.end() ? nullptr : found->second.c_str();
  });
}

TEST(LaunchTest, KnowsTheLaunchersOfMpi) {
  for (const Variables& variables :
       {Variables{{"OMPI_COMM_WORLD_RANK", "2"}, {"OMPI_COMM_WORLD_SIZE", "3"}, {"PMIX_RANK", "0"}},
        Variables{{"PMI_RANK", "2"}, {"PMI_SIZE", "3"}}, Variables{{"PMIX_RANK", "2"}, {"SLURM_STEP_NUM_TASKS", "3"}}}) {
    const std::optional<Launch> found = launch(variables);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->rank, 2);
    EXPECT_EQ(found->ranks, 3);
    EXPECT_FALSE(found->alone());
  }
  const std::optional<Launch> unknown = launch({{"PMIX_RANK", "0"}});
  ASSERT_TRUE(unknown);
  EXPECT_FALSE(unknown->ranks);
  EXPECT_FALSE(unknown->alone());
  EXPECT_TRUE(launch({{"OMPI_COMM_WORLD_RANK", "0"}, {"OMPI_COMM_WORLD_SIZE", "1"}})->alone());
}

TEST(LaunchTest, TakesNothingElseForMpi) {
  EXPECT_FALSE(launch({}));
  EXPECT_FALSE(launch({{"SLURM_PROCID", "1"}, {"SLURM_NTASKS", "4"}, {"SLURM_STEP_NUM_TASKS", "4"}}));
  EXPECT_FALSE(launch({{"PMI_RANK", "1"}})) << "of how many?";
  for (const char* rank : {"", "x", "1x", "-1", "3", "99999999999"}) {
    EXPECT_FALSE(launch({{"OMPI_COMM_WORLD_RANK", rank}, {"OMPI_COMM_WORLD_SIZE", "3"}})) << rank;
  }
  EXPECT_FALSE(launch({{"OMPI_COMM_WORLD_RANK", "0"}, {"OMPI_COMM_WORLD_SIZE", "0"}}));
  EXPECT_FALSE(launch({{"OMPI_COMM_WORLD_RANK", "0"}, {"OMPI_COMM_WORLD_SIZE", "2"}, {"SUNFLECK_MPI", "off"}}));
  for (const char* no : {"OFF", "no", "False", "0"})
    EXPECT_FALSE(launch({{"OMPI_COMM_WORLD_RANK", "0"}, {"OMPI_COMM_WORLD_SIZE", "2"}, {"SUNFLECK_MPI", no}})) << no;
  EXPECT_TRUE(launch({{"OMPI_COMM_WORLD_RANK", "0"}, {"OMPI_COMM_WORLD_SIZE", "2"}, {"SUNFLECK_MPI", "on"}}));
}

// Tests the code of a program that was built without MPI.
class NoJobTest : public ::testing::Test {
 protected:
  NoJobTest() {
    for (const char* name : names_) ::unsetenv(name);
  }
  ~NoJobTest() override {
    for (const char* name : names_) ::unsetenv(name);
  }

 private:
  static constexpr const char* names_[] = {"OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_SIZE", "PMI_RANK", "PMI_SIZE", "PMIX_RANK",
                                           "SLURM_STEP_NUM_TASKS", "SUNFLECK_MPI"};
};

TEST_F(NoJobTest, IsJoinedByAProcessOnItsOwn) {
  EXPECT_FALSE(launch_by_mpi());
  EXPECT_FALSE(is_worker_rank());
  ::setenv("OMPI_COMM_WORLD_RANK", "0", 1);
  ::setenv("OMPI_COMM_WORLD_SIZE", "1", 1);
  ASSERT_TRUE(launch_by_mpi());
  EXPECT_EQ(join_job(), nullptr);
}

TEST_F(NoJobTest, RefusesToBeOneOfSeveral) {
  ::setenv("OMPI_COMM_WORLD_SIZE", "2", 1);
  for (const char* rank : {"0", "1"}) {
    ::setenv("OMPI_COMM_WORLD_RANK", rank, 1);
    EXPECT_EQ(is_worker_rank(), rank[0] == '1');
    ASSERT_TRUE(launch_by_mpi());
    expect_refusal([] { static_cast<void>(join_no_job(*launch_by_mpi())); },
                   "2 processes started by MPI (this program was built without MPI); ");
  }
}

}  // namespace
}  // namespace sunfleck
