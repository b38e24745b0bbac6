// Damaged results are rejected; the store returns exactly what was written.
#include "bench/campaign/store.hpp"

#include <gmock/gmock.h>

#include <random>

#include "bench/campaign/evaluate.hpp"
#include "bench/campaign/merge.hpp"
#include "bench/campaign/shards.hpp"
#include "bench/campaign_report/report.hpp"
#include "tests/unit/bench/campaign/runs.hpp"

namespace canhil::campaign {
namespace {

using testing::AnyOf;
using testing::HasSubstr;

const std::string asked = two_variants + R"([[metric]]
kind = "rms_curve"
quantity = "attitude.heading"
[[metric]]
kind = "divergence"
quantity = "attitude.heading"
beyond_mrad = 5
at_most = 0
)";

/// Results of all runs; some of them ended early.
std::filesystem::path results(const std::string& name) {
  const Campaign campaign = *parse(asked);
  auto file = scratch(name);
  auto store = Store::create(file, identity_of(campaign), campaign.sources);
  for (std::size_t variant = 0; variant < 2; ++variant) {
    std::vector<Finished> runs;
    for (std::uint64_t run = 0; run < 4; ++run) {
      runs.push_back({variant, run_with(run, std::vector<double>(30, 1e-3 * static_cast<double>(run + 1)))});
      if (run == 2) runs.back().series.ending = {drive::Ending::Kind::target_fault, 9, "input_silent"};
    }
    EXPECT_TRUE(store->add(runs));
  }
  store->close();
  return file;
}

/// The output of `hil-bench campaign report`, from the file alone.
Result<std::string> report_on(const std::filesystem::path& file) {
  const auto store = Store::open(file);
  if (!store) return tl::unexpected(store.error());
  const auto campaign = campaign_of(*store);
  if (!campaign) return tl::unexpected(campaign.error());
  return evaluate(*campaign, *store).map([&](const Evaluation& evaluation) {
    return text({.campaign = *campaign, .evaluation = evaluation}) +
           json({.campaign = *campaign, .evaluation = evaluation});
  });
}

void write(const std::filesystem::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary) << bytes;
}

class Damaged : public testing::Test {
 protected:
  /// The error of a damaged file; "" if the report is unchanged. A different report fails the test.
  std::string complaint_of(const std::string& bytes) {
    write(copy_, bytes);
    const auto report = report_on(copy_);
    if (!report) {
      EXPECT_THAT(report.error().message, AnyOf(HasSubstr("damaged.sqlite: "), HasSubstr("of 4 runs")));
      EXPECT_EQ(report.error().message.find('\n'), std::string::npos) << report.error().message;
      return report.error().message;
    }
    EXPECT_EQ(*report, whole_) << "another report from damaged results";
    return "";
  }
  /// The error after a change that leaves a valid database.
  std::string complaint_after(const std::string& sql) {
    write(copy_, bytes_);
    SQLite::Database(copy_, SQLite::OPEN_READWRITE).exec(sql);
    const auto report = report_on(copy_);
    return report ? "" : report.error().message;
  }

  std::filesystem::path copy_ = scratch("damaged.sqlite");
  std::filesystem::path sound_ = results("sound.sqlite");
  std::string bytes_ = content(sound_);
  std::string whole_ = *report_on(sound_);
};

TEST_F(Damaged, NotAtAllGivesTheReport) {
  EXPECT_EQ(complaint_of(bytes_), "");
  EXPECT_THAT(whole_, HasSubstr("3 of 4 runs completed; run 2: input_silent"));
}

TEST_F(Damaged, CutOffIsRefusedWhereverItIs) {
  for (std::size_t size = bytes_.size() - 1; size > 100; size -= std::min<std::size_t>(size, 307))
    EXPECT_NE(complaint_of(bytes_.substr(0, size)), "") << size;
  EXPECT_THAT(complaint_of(bytes_.substr(0, bytes_.size() - 100)),
              HasSubstr("of its pages: the file is cut off"));
  EXPECT_THAT(complaint_of(bytes_ + "x"), HasSubstr("of its pages: the file is damaged"));
}

TEST_F(Damaged, IsRefusedOrGivesTheSameReport) {
  std::mt19937_64 random(20260601);
  const auto below = [&](std::size_t most) { return static_cast<std::size_t>(random() % most); };
  std::size_t refused = 0;
  constexpr std::size_t copies = 600;
  for (std::size_t i = 0; i < copies; ++i) {
    std::string bytes = bytes_;
    const std::size_t place = below(bytes.size());
    const std::size_t length = std::min(bytes.size() - place, 1 + below(64));
    switch (i % 4) {
      case 0:  // one flipped bit
        bytes[place] = static_cast<char>(bytes[place] ^ (1 << below(8)));
        break;
      case 1:  // random bytes
        for (std::size_t k = 0; k < length; ++k) bytes[place + k] = static_cast<char>(random());
        break;
      case 2:  // zeros, as from a disk that lost the block
        std::fill_n(bytes.begin() + static_cast<std::ptrdiff_t>(place), length, '\0');
        break;
      default:  // bytes from another place in the file
        std::copy_n(bytes_.begin() + static_cast<std::ptrdiff_t>(below(bytes.size() - length)), length,
                    bytes.begin() + static_cast<std::ptrdiff_t>(place));
    }
    if (!complaint_of(bytes).empty()) ++refused;
  }
  EXPECT_GT(refused, copies / 4) << "the damage hit nothing";
}

// A page copied over another page puts valid rows where other rows should be.
TEST_F(Damaged, WithAPageInThePlaceOfAnotherIsRefusedOrGivesTheSameReport) {
  constexpr std::size_t page = 4096;
  const std::size_t pages = bytes_.size() / page;
  for (std::size_t to = 0; to < pages; ++to) {
    for (std::size_t from = 0; from < pages; ++from) {
      std::string bytes = bytes_;
      bytes.replace(to * page, page, bytes_.substr(from * page, page));
      complaint_of(bytes);
    }
  }
}

TEST_F(Damaged, RowsAreRefusedByWhatIsWrong) {
  EXPECT_THAT(complaint_after("update run set run = -5 where id = 2"),
              HasSubstr("row 2 is of run -5 of variant 0, expected the results of a run"));
  EXPECT_THAT(complaint_after("update run set variant = 9e18 where id = 2"), HasSubstr("row 2 is of run 2"));
  EXPECT_THAT(complaint_after("update run set id = 77 where id = 7"), HasSubstr("3 of 4 runs"));
  EXPECT_THAT(complaint_after("update run set ending = 99 where id = 2"), HasSubstr("row 2 has ending 99"));
  EXPECT_THAT(complaint_after("update run set ending = 0 where id = 2"),
              HasSubstr("row 2 has another hash than its content"));
  EXPECT_THAT(complaint_after("update run set columns = 'height' where id = 2"),
              HasSubstr("row 2 has columns that no estimator reports"));
  EXPECT_THAT(complaint_after("update run set samples = substr(samples, 9) where id = 2"),
              HasSubstr("row 2 has another hash"));
  EXPECT_THAT(complaint_after("update run set detail = 'fine' where id = 2"), HasSubstr("another hash"));
  EXPECT_THAT(complaint_after("delete from run where id = 2"), HasSubstr("has 3 of 4 runs"));
  EXPECT_THAT(complaint_after("update identity set runs = 3"), HasSubstr("another hash"));
  EXPECT_THAT(complaint_after("update source set content = replace(content, 'at_most = 0', 'at_most = 4')"),
              HasSubstr("what it says of its campaign has another hash"));
  EXPECT_THAT(complaint_after("update source set name = 'other.toml' where kind = 'campaign'"),
              HasSubstr("another hash"));
  EXPECT_THAT(complaint_after("pragma application_id = 0x43484333"),
              HasSubstr("is of format 3, expected 7: it must be flown again"));
}

TEST_F(Damaged, IsRefusedByMergeAndResumeToo) {
  complaint_after("update run set run = -5 where id = 2");
  const auto merged = merge(scratch("merged.sqlite"), std::vector{copy_});
  ASSERT_FALSE(merged);
  EXPECT_THAT(merged.error().message, HasSubstr("row 2 is of run -5"));
  const Campaign campaign = *parse(asked);
  const auto resume = [&] { return Store::resume(copy_, identity_of(campaign), campaign.sources); };
  EXPECT_THAT(resume()->keys().error().message, HasSubstr("row 2 is of run -5"));
  write(copy_, bytes_ + std::string(10, '\0'));
  EXPECT_THAT(resume().error().message, HasSubstr("the file is damaged"));
}

}  // namespace
}  // namespace canhil::campaign
