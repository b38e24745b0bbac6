#include "bench/campaign/execute.hpp"

#include <gmock/gmock.h>
#include <sys/resource.h>

#include <csignal>
#include <cstdlib>

#include "bench/campaign/evaluate.hpp"
#include "bench/campaign/merge.hpp"
#include "bench/drive/flight.hpp"
#include "tests/unit/bench/campaign/runs.hpp"

namespace canhil::campaign {
namespace {

using testing::HasSubstr;

const std::atomic<bool> never = false;

Options options_for(const std::filesystem::path& file, unsigned threads, Shard shard = {}) {
  Options options;
  options.file = file;
  options.threads = threads;
  options.shard = shard;
  return options;
}

TEST(Execute, StoresWhatRunInProcessGives) {
  const auto campaign = parse(two_variants);
  const auto file = scratch("whole.sqlite");
  const auto done = execute(*campaign, options_for(file, 2), never);
  ASSERT_TRUE(done) << done.error().message;
  EXPECT_EQ(*done, Execution::complete);
  const auto store = Store::open(file);
  ASSERT_TRUE(store);
  const auto runs = store->load(1);
  ASSERT_EQ(runs->size(), 4U);
  const scenario::Scenario& scenario = campaign->variants[1].scenario;
  const auto truth = drive::make_truth(scenario);
  const auto flown = drive::run_in_process(scenario, *truth, 2);
  EXPECT_EQ(encode((*runs)[2].samples),
            encode(samples_of(flown->seen, flown->per_run_truth, *truth, estimators::transfer_alignment)));
  EXPECT_EQ((*runs)[2].run, 2U);
}

TEST(Execute, ResumesWhatWasInterrupted) {
  const auto campaign = parse(two_variants);
  const auto whole = scratch("undisturbed.sqlite"), file = scratch("resumed.sqlite");
  ASSERT_TRUE(execute(*campaign, options_for(whole, 1), never));

  Options options = options_for(file, 1);
  const std::atomic<bool> at_once = true;
  EXPECT_EQ(execute(*campaign, options, at_once), Execution::interrupted);
  EXPECT_THAT(execute(*campaign, options, never).error().message, HasSubstr("exists already"));
  options.shard = {.index = 1, .count = 2};
  options.resume = true;
  EXPECT_EQ(execute(*campaign, options, never), Execution::complete);
  options.shard = {};
  std::size_t done = 0, stored = 0;
  options.progress = [&](const Progress& progress) {
    done = progress.done;
    stored = progress.stored;
  };
  EXPECT_EQ(execute(*campaign, options, never), Execution::complete);
  EXPECT_EQ(stored, 4U);
  EXPECT_EQ(done, 4U);

  const auto a = scratch("a.sqlite"), b = scratch("b.sqlite");
  ASSERT_TRUE(merge(a, std::vector{whole}));
  ASSERT_TRUE(merge(b, std::vector{file}));
  EXPECT_EQ(content(a), content(b));
}

TEST(Execute, ResultsOfAnotherCampaignAreLeftAlone) {
  const auto file = scratch("other.sqlite");
  ASSERT_TRUE(execute(*parse(two_variants), options_for(file, 2), never));
  const std::string before = content(file);
  Options options = options_for(file, 2);
  options.resume = true;
  const auto refused = execute(*parse(two_variants + "\n"), options, never);
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message, HasSubstr("is of another campaign"));
  EXPECT_EQ(content(file), before);
}

TEST(Execute, ARunThatCannotBeConfiguredEndsItWithOneLine) {
  const auto campaign = parse(two_variants + "[sweep]\n\"target.parameters.h2_case\" = [7]\n");
  ASSERT_TRUE(campaign) << campaign.error().message;
  const auto refused = execute(*campaign, options_for(scratch("refused.sqlite"), 2), never);
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message, HasSubstr("c.toml: variant '"));  // either thread may report first
  EXPECT_THAT(refused.error().message, HasSubstr(" target.parameters.h2_case=7': "));
  EXPECT_THAT(refused.error().message, HasSubstr("out_of_range"));
}

TEST(Execute, AScenarioOfWhichNoRunCanBeFlownEndsItWithOneLine) {
  const auto campaign = parse(two_variants + "[sweep]\n\"target.initial_sigma.tilt_deg\" = [0.00001]\n");
  ASSERT_TRUE(campaign) << campaign.error().message;
  EXPECT_THAT(execute(*campaign, options_for(scratch("sigma.sqlite"), 2), never).error().message,
              HasSubstr("does not fit into TargetInitSigma.tilt_sigma"));
}

TEST(Execute, ARunThatCannotBeFlownIsOneFailedRun) {
  // In some runs, the random initial velocity exceeds the range of its message. This range ends at 1048 m/s
  // down.
  auto campaign = parse(two_variants +
                        "[[metric]]\nkind = 'divergence'\nquantity = 'attitude.heading'\nbeyond_mrad = "
                        "9000\nat_most = 0\n[sweep]\n\"initial_error.velocity_sigma_mps\" = [900.0]\n");
  ASSERT_TRUE(campaign) << campaign.error().message;
  campaign->runs = 8;
  const auto file = scratch("fast.sqlite");
  const auto done = execute(*campaign, options_for(file, 2), never);
  ASSERT_TRUE(done) << done.error().message;
  EXPECT_EQ(*done, Execution::complete);
  const auto evaluation = evaluate(*campaign, *Store::open(file));
  ASSERT_TRUE(evaluation) << evaluation.error().message;
  const Endings& endings = evaluation->endings.at(0);
  EXPECT_EQ(endings.runs, 8U);
  EXPECT_GT(endings.completed, 0U);
  EXPECT_LT(endings.completed, 8U);
  EXPECT_THAT(endings.first_fault,
              testing::MatchesRegex("run .: initial value -?[0-9.]+ m/s does not fit.*"));
  EXPECT_EQ(evaluation->outcome(), checks::Outcome::fail);
}

/// Until the end of its scope, an object of this class limits the size of the files that this process writes,
/// as a full disk would.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{.rlim_cur = bytes, .rlim_max = before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
    handler_ = std::signal(SIGXFSZ, SIG_IGN);
  }
  ~FileSizeLimit() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;

 private:
  rlimit before_{};
  void (*handler_)(int) = nullptr;
};

TEST(Execute, AFullDiskKeepsWhatWasCommittedAndResumes) {
  const auto campaign = parse(two_variants);
  const auto whole = scratch("not_full.sqlite"), file = scratch("full.sqlite");
  ASSERT_TRUE(execute(*campaign, options_for(whole, 1), never));
  Options options = options_for(file, 1);
  options.resume = true;
  options.shard = {.index = 0, .count = 2};
  ASSERT_TRUE(execute(*campaign, options, never));  // half of the runs
  options.shard = {};
  {
    const FileSizeLimit full(std::filesystem::file_size(file) + 1);
    const auto refused = execute(*campaign, options, never);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().message,
              file.string() +
                  ": cannot be read or written: disk I/O error (File too large); 4 of 8 runs are "
                  "kept, to be resumed");
  }
  const auto kept = Store::open(file);
  ASSERT_TRUE(kept) << kept.error().message;
  EXPECT_EQ(kept->keys()->size(), 4U);
  ASSERT_TRUE(execute(*campaign, options, never));
  const auto a = scratch("full_a.sqlite"), b = scratch("full_b.sqlite");
  ASSERT_TRUE(merge(a, std::vector{whole}));
  ASSERT_TRUE(merge(b, std::vector{file}));
  EXPECT_EQ(content(a), content(b));
}

TEST(Execute, AFileThatCouldNotBeBegunIsNotInTheWayOfTheNextTry) {
  const auto campaign = parse(two_variants);
  const auto file = scratch("begun.sqlite");
  {
    const FileSizeLimit full(1000);
    EXPECT_THAT(execute(*campaign, options_for(file, 1), never).error().message, HasSubstr("File too large"));
  }
  EXPECT_FALSE(std::filesystem::exists(file));
  EXPECT_TRUE(execute(*campaign, options_for(file, 1), never));
}

TEST(Execute, OneWriterAFile) {
  const auto campaign = parse(two_variants);
  const auto file = scratch("locked.sqlite");
  const auto first = Store::create(file, identity_of(*campaign), campaign->sources);
  ASSERT_TRUE(first);
  EXPECT_THAT(Store::resume(file, identity_of(*campaign), campaign->sources).error().message,
              HasSubstr("is in use by another program"));
}

TEST(Shard, IsReadStrictly) {
  EXPECT_EQ(parse_shard("2/7")->index, 2U);
  EXPECT_EQ(parse_shard("2/7")->count, 7U);
  for (const std::string wrong : {"7/7", "1", "-1/3", "1/", "/2", "a/b", "1/2/3", "0/0", ""}) {
    EXPECT_THAT(parse_shard(wrong).error().message, HasSubstr("expected i/N")) << wrong;
  }
}

class SlurmEnvironment : public testing::Test {
 protected:
  static void set(const char* id, const char* count, const char* first, const char* step) {
    const auto put = [](const char* name, const char* value) {
      if (value == nullptr) {
        unsetenv(name);
      } else {
        setenv(name, value, 1);
      }
    };
    put("SLURM_ARRAY_TASK_ID", id);
    put("SLURM_ARRAY_TASK_COUNT", count);
    put("SLURM_ARRAY_TASK_MIN", first);
    put("SLURM_ARRAY_TASK_STEP", step);
  }
  void TearDown() override { set(nullptr, nullptr, nullptr, nullptr); }
};

TEST_F(SlurmEnvironment, GivesThePlaceInTheArray) {
  set(nullptr, nullptr, nullptr, nullptr);
  EXPECT_EQ(shard_of_environment()->count, 1U);
  set("2", "4", nullptr, nullptr);
  EXPECT_EQ(shard_of_environment()->index, 2U);
  EXPECT_EQ(shard_of_environment()->count, 4U);
  set("4", "4", "1", "1");  // --array=1-4
  EXPECT_EQ(shard_of_environment()->index, 3U);
  set("15", "4", "0", "5");  // --array=0-15:5
  EXPECT_EQ(shard_of_environment()->index, 3U);
}

TEST_F(SlurmEnvironment, ThatIsIncompleteIsRefused) {
  set("2", nullptr, nullptr, nullptr);
  EXPECT_THAT(shard_of_environment().error().message, HasSubstr("SLURM_ARRAY_TASK_COUNT"));
  set("x", "4", nullptr, nullptr);
  EXPECT_THAT(shard_of_environment().error().message, HasSubstr("SLURM_ARRAY_TASK_ID='x'"));
  set("7", "3", "1", "1");  // --array=1,3,7
  EXPECT_THAT(shard_of_environment().error().message, HasSubstr("expected an array without gaps"));
}

}  // namespace
}  // namespace canhil::campaign
